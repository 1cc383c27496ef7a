#include "gui/render/world_view_renderer.h"

#include <utility>

#include "gui/render/camera_clip.h"
#include "gui/render/line_batch.h"
#include "gui/render/lit_scene_renderer.h"
#include "gui/render/scene_renderer.h"
#include "gui/render/vehicle_model.h"

namespace palace {

struct WorldViewRenderer::Parts {
  std::unique_ptr<LitSceneRenderer> lit;  ///< one of the two
  std::unique_ptr<SceneRenderer> plain;
  VehiclePainter vehicle;
  LinePainter lines;
};

WorldViewRenderer::WorldViewRenderer(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
WorldViewRenderer::~WorldViewRenderer() = default;

Result<std::unique_ptr<WorldViewRenderer>> WorldViewRenderer::Create(const World& world,
                                                                     const RayScene* light) {
  auto parts = std::make_unique<Parts>();
  if (light != nullptr) {
    Result<std::unique_ptr<LitSceneRenderer>> lit = LitSceneRenderer::Create(*light);
    if (!lit) {
      return lit.error();
    }
    parts->lit = std::move(*lit);
  } else {
    Result<std::unique_ptr<SceneRenderer>> plain = SceneRenderer::Create(world);
    if (!plain) {
      return plain.error();
    }
    parts->plain = std::move(*plain);
  }
  for (const Status& started : {parts->vehicle.Start(), parts->lines.Start()}) {
    if (!started) {
      return started.error();
    }
  }
  return std::unique_ptr<WorldViewRenderer>(new WorldViewRenderer(std::move(parts)));
}

Status WorldViewRenderer::Render(const WorldView& view, Framebuffer& target, int samples) {
  const PinholeCamera& eye = view.eye;
  if (const Status sized = target.Resize(eye.width, eye.height, PixelKind::kRgba, samples);
      !sized) {
    return sized;
  }
  if (parts_->lit) {
    parts_->lit->DrawInto(target, eye, view.X_WE, view.time_s);
  } else {
    parts_->plain->DrawInto(target, eye, view.X_WE);
  }
  Eigen::Matrix4d eye_from_world = Eigen::Matrix4d::Identity();
  eye_from_world.topLeftCorner<3, 3>() = view.X_WE.R.transpose();
  eye_from_world.topRightCorner<3, 1>() = -(view.X_WE.R.transpose() * view.X_WE.p);
  const Eigen::Matrix4d clip_from_world = ClipFromCamera(eye) * eye_from_world;
  LineBatch batch(clip_from_world, eye.width, eye.height);
  const double size = view.rotor_diameter_m / (2 * kRotorRadius_m);
  if (view.X_WB) {
    parts_->vehicle.Draw(view.body, clip_from_world, *view.X_WB, size, view.X_WE.p);
  }
  if (view.frustum != nullptr) {
    AddSeenGround(batch, *view.frustum, view.X_WE.p, view.ui_scale);
    AddFrustumBody(batch, *view.frustum, view.ui_scale);
  }
  if (view.X_WB) {
    AddRotors(batch, view.body, *view.X_WB, size, view.ui_scale);
  }
  // Hidden by what stands before it, hiding nothing. Alpha stays 1: ImGui draws it over the window.
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE);
  glDepthMask(GL_FALSE);
  parts_->lines.Draw(batch);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  target.Resolve();
  return Ok();
}

}  // namespace palace
