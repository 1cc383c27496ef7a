#include "gui/render/view3d_renderer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gui/render/framebuffer.h"
#include "gui/render/frustum_renderer.h"
#include "gui/render/line_batch.h"
#include "gui/render/shader.h"
#include "gui/render/terrain_renderer.h"
#include "gui/render/vehicle_model.h"
#include "shader_text.h"

namespace palace {
namespace {

constexpr int kSamples = 4;
constexpr double kSmallestRotor_px = 48;
constexpr double kMostEnlarged = 2;

/// In times of the model's own: as wide as the vehicle, up to double that while it is under 48 px.
double VehicleSize(const LineBatch& batch, const RigidTransform& X_WB, double rotor_diameter_m,
                   double ui_scale) {
  const double true_size = rotor_diameter_m / (2 * kRotorRadius_m);
  const Eigen::Vector3d hub = batch.PixelFromPoint(X_WB.p);
  if (hub.z() == 0) {
    return true_size;
  }
  double rotor_px = 0;
  for (const Eigen::Vector3d& rim :
       {Eigen::Vector3d(kRotorRadius_m, 0, 0), Eigen::Vector3d(0, kRotorRadius_m, 0)}) {
    const Eigen::Vector3d pixel = batch.PixelFromPoint(X_WB * (true_size * rim));
    rotor_px = std::max(rotor_px, 2 * (pixel - hub).head<2>().norm());
  }
  return true_size *
         std::clamp(kSmallestRotor_px * ui_scale / std::max(rotor_px, 1.0), 1.0, kMostEnlarged);
}

}  // namespace

struct View3dRenderer::Parts {
  ShaderProgram sky;
  GlVertexArray no_vertices;
  TerrainRenderer terrain;
  LinePainter lines;
  VehiclePainter vehicle;
  Framebuffer target;

  void DrawSky() const;
};

void View3dRenderer::Parts::DrawSky() const {
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  sky.Use();
  glBindVertexArray(no_vertices.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

View3dRenderer::View3dRenderer(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
View3dRenderer::~View3dRenderer() = default;

Result<std::unique_ptr<View3dRenderer>> View3dRenderer::Create() {
  auto parts = std::make_unique<Parts>();
  Result<ShaderProgram> sky =
      ShaderProgram::Build("sky", {shader_text::fullscreen_vertex}, {shader_text::sky_fragment});
  if (!sky) {
    return sky.error();
  }
  parts->sky = std::move(sky).value();
  parts->no_vertices = GlVertexArray::Create();
  for (const Status& started :
       {parts->terrain.Start(), parts->lines.Start(), parts->vehicle.Start()}) {
    if (!started) {
      return started.error();
    }
  }
  return std::unique_ptr<View3dRenderer>(new View3dRenderer(std::move(parts)));
}

GLuint View3dRenderer::texture() const { return parts_->target.texture(); }
ImageRgba View3dRenderer::Read() const { return parts_->target.ReadRgba(); }

Result<View3dLabels> View3dRenderer::Render(const View3dInput& input, const OrbitCamera& camera,
                                            int width_px, int height_px) {
  Parts& parts = *parts_;
  if (const Status sized = parts.target.Resize(width_px, height_px, PixelKind::kRgba, kSamples);
      !sized) {
    return sized.error();
  }
  parts.terrain.Update(input.elevation, input.hazards, input.safe_distance_max_m);
  parts.terrain.Drape(input.picture, input.picture_camera, input.picture_X_WC);
  const double ground_m = parts.terrain.ground_height_m().value_or(input.ground_height_m);
  const Eigen::Matrix4d clip_from_world = camera.ClipFromWorld(width_px, height_px);
  LineBatch batch(clip_from_world, width_px, height_px);

  parts.target.Bind();
  glDisable(GL_CULL_FACE);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_STENCIL_TEST);
  glEnable(GL_MULTISAMPLE);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glClear(GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
  parts.DrawSky();

  glEnable(GL_BLEND);
  // Alpha of the texture stays 1: ImGui draws it over the window.
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE);
  const Eigen::Vector3d middle = input.site   ? input.site->p_WS
                                 : input.X_WB ? input.X_WB->p
                                              : Eigen::Vector3d(0, 0, 0);
  AddGroundGrid(batch, {middle.x(), middle.y(), -ground_m}, input.ui_scale);
  parts.lines.Draw(batch);
  batch.Clear();
  glDisable(GL_BLEND);
  parts.terrain.Draw(clip_from_world, input.ui_scale);

  const double size =
      input.X_WB ? VehicleSize(batch, *input.X_WB, input.rotor_diameter_m, input.ui_scale) : 1;
  View3dLabels labels;
  AddFrustum(batch, input, ground_m);
  AddSites(batch, input);
  labels.height_ticks = AddDropLine(batch, input, ground_m, size);
  AddPaths(batch, input);
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  parts.lines.Draw(batch);
  batch.Clear();

  if (input.X_WB) {
    // Always in front: the operator must never lose the vehicle behind the terrain.
    glDisable(GL_BLEND);
    glClear(GL_DEPTH_BUFFER_BIT);
    parts.vehicle.Draw(input.body, clip_from_world, *input.X_WB, size, camera.eye_W());
    AddRotors(batch, input.body, *input.X_WB, size, input.ui_scale);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    parts.lines.Draw(batch);
    labels.vehicle = batch.PixelFromPoint(input.X_WB->p).head<2>().cast<float>();
  }
  glDisable(GL_BLEND);
  if (input.site) {
    labels.site = batch.PixelFromPoint(input.site->p_WS).head<2>().cast<float>();
  }
  parts.target.Resolve();
  return labels;
}

}  // namespace palace
