#include "gui/render/sun_map.h"

#include <limits>

namespace palace {

Status SunMap::Create() {
  depth_ = GlTexture::Create();
  glBindTexture(GL_TEXTURE_2D, depth_.name());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, kSize_px, kSize_px, 0, GL_DEPTH_COMPONENT,
               GL_UNSIGNED_INT, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  target_ = GlFramebuffer::Create();
  glBindFramebuffer(GL_FRAMEBUFFER, target_.name());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.name(), 0);
  glDrawBuffer(GL_NONE);
  glReadBuffer(GL_NONE);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    return UnavailableError("this OpenGL driver refuses our shadow map");
  }
  Begin();
  return Ok();
}

void SunMap::Begin() const {
  glBindFramebuffer(GL_FRAMEBUFFER, target_.name());
  glViewport(0, 0, kSize_px, kSize_px);
  glClear(GL_DEPTH_BUFFER_BIT);
}

Eigen::Matrix4f SunFromWorld(const Eigen::Vector3d& to_sun_W, const Eigen::Vector3d& low_W,
                             const Eigen::Vector3d& high_W) {
  const Eigen::Vector3d right = to_sun_W.unitOrthogonal();
  Eigen::Matrix3d sun_from_world;
  sun_from_world.row(0) = right;
  sun_from_world.row(1) = to_sun_W.cross(right);
  sun_from_world.row(2) = -to_sun_W;  // depth grows away from the sun
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d high = -low;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d p(corner & 1 ? high_W.x() : low_W.x(),
                            corner & 2 ? high_W.y() : low_W.y(),
                            corner & 4 ? high_W.z() : low_W.z());
    low = low.cwiseMin(sun_from_world * p);
    high = high.cwiseMax(sun_from_world * p);
  }
  const Eigen::Vector3d scale = 2 * (high - low).cwiseInverse();
  Eigen::Matrix4d clip = Eigen::Matrix4d::Identity();
  clip.topLeftCorner<3, 3>() = scale.asDiagonal() * sun_from_world;
  clip.topRightCorner<3, 1>() = -scale.cwiseProduct(0.5 * (low + high));
  return clip.cast<float>();
}

}  // namespace palace
