#include "gui/render/lit_resolve.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "gui/render/camera_clip.h"
#include "shader_text.h"

namespace palace {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Of a pixel's footprint, what one of its samples stands for.
constexpr double kShare = 0.35;
constexpr int kTile_px = 64;
/// No footprint is longer than at this sine of incidence (lit_resolve_fragment.glsl).
constexpr double kGrazing = 0.05;
/// Left for what rounding and places between a tile's corners add to the footprints at these.
constexpr double kMargin = 0.9;

Eigen::Vector3f Single(const Vector3d& v) { return v.cast<float>(); }

/// W, 1 m along the optical axis, of (x, y, 1): GL's window has the first pixel's middle at 0.5.
Matrix3d RayOfWindow(const PinholeCamera& camera, const RigidTransform& X_WC) {
  Matrix3d ray;
  ray << 1 / camera.fx_px, 0, -(camera.cx_px + 0.5) / camera.fx_px,  //
      0, 1 / camera.fy_px, -(camera.cy_px + 0.5) / camera.fy_px,     //
      0, 0, 1;
  return X_WC.R * ray;
}

}  // namespace

Status LitResolve::Build(std::initializer_list<std::string_view> light_pieces, const Light& light) {
  light_ = light;
  no_corners_ = GlVertexArray::Create();
  std::string text;
  for (const std::string_view piece : light_pieces) {
    text += piece;
  }
  for (std::size_t k = 0; k < programs_.size(); ++k) {
    const std::string_view enlarged =
        k == 0 ? "const bool enlarged = false;\n" : "const bool enlarged = true;\n";
    Result<ShaderProgram> built =
        ShaderProgram::Build("lit resolve", {shader_text::fullscreen_vertex},
                             {text, enlarged, shader_text::lit_resolve_fragment});
    if (!built) {
      return built.error();
    }
    programs_[k] = std::move(built).value();
  }
  return Ok();
}

bool LitResolve::Enlarged(const Matrix3d& ray_of_window, const Eigen::AlignedBox2d& part,
                          const Vector3d& p_W) const {
  const double above_m = light_.up_W.dot(p_W - light_.lowest_W);
  for (int corner = 0; corner < 4; ++corner) {
    const Vector3d at =
        part.corner(static_cast<Eigen::AlignedBox2d::CornerType>(corner)).homogeneous();
    const Vector3d ray = ray_of_window * at;
    const double down = -light_.up_W.dot(ray);
    if (down <= kGrazing * light_.up_W.norm() * ray.norm()) {
      return false;
    }
    const double farthest_m = above_m / down;
    for (int axis = 0; axis < 2; ++axis) {
      const Vector3d step = ray_of_window.col(axis);
      const Vector3d along = step + ray * (light_.up_W.dot(step) / down);
      if (farthest_m * kShare * along.head<2>().norm() > kMargin * light_.texel_m) {
        return false;
      }
    }
  }
  return true;
}

void LitResolve::Draw(const Framebuffer& drawn, const PinholeCamera& camera,
                      const RigidTransform& X_WC) const {
  const Matrix3d ray_of_window = RayOfWindow(camera, X_WC);
  drawn.BeginResolve();
  const std::array<std::pair<const char*, GLuint>, 2> samples = {
      {{"greys", drawn.colour_samples()}, {"depths", drawn.depth_samples()}}};
  for (const ShaderProgram& program : programs_) {
    program.Use();
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const int unit = 3 + static_cast<int>(i);
      glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
      glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, samples[i].second);
      program.Set(samples[i].first, unit);
    }
    program.Set("ray_of_window", Eigen::Matrix3f(ray_of_window.cast<float>()));
    program.Set("camera_W", Single(X_WC.p));
    program.Set("up", Single(light_.up_W));
    program.Set("near_far_m",
                Eigen::Vector2f(static_cast<float>(kNear_m), static_cast<float>(kFar_m)));
    program.Set("sample_texels", static_cast<float>(kShare / light_.texel_m));
    for (std::size_t i = 0; i < drawn.sample_at().size(); ++i) {
      program.Set(("sample_at[" + std::to_string(i) + "]").c_str(), drawn.sample_at()[i]);
    }
  }
  glActiveTexture(GL_TEXTURE0);
  glBindVertexArray(no_corners_.name());
  glEnable(GL_SCISSOR_TEST);
  for (int y = 0; y < drawn.height(); y += kTile_px) {
    for (int x = 0; x < drawn.width(); x += kTile_px) {
      const Eigen::AlignedBox2d part(Eigen::Vector2d(x, y),
                                     Eigen::Vector2d(x + kTile_px, y + kTile_px));
      programs_[Enlarged(ray_of_window, part, X_WC.p) ? 1 : 0].Use();
      glScissor(x, y, kTile_px, kTile_px);
      glDrawArrays(GL_TRIANGLES, 0, 3);
    }
  }
  glDisable(GL_SCISSOR_TEST);
}

}  // namespace palace
