#include "gui/app/world_views.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "engine/core/time.h"
#include "engine/core/units.h"
#include "gui/render/gl.h"

namespace palace {
namespace {

constexpr double kTexel_m = 0.02;
constexpr int kSmoothSamples = 4;
constexpr double kRestPerWork = 4;
constexpr double kSlow_s = 0.06, kQuick_s = 0.01;  // of one drawing
constexpr int kPlainest = 2;
constexpr double kChaseView_rad = 0.95;
constexpr double kLeastClearance_m = 0.7;  // of the eye above what stands there
constexpr double kMostRadius_m = 45;       // of the ground that a view takes in

PinholeCamera EyeCamera(double vertical_rad, int width, int height) {
  const double f_px = height / (2 * std::tan(vertical_rad / 2));
  return {width, height, f_px, f_px, (width - 1) / 2.0, (height - 1) / 2.0};
}

/// R_WE of an eye that looks along a direction, its right hand level.
Eigen::Matrix3d Looking(const Eigen::Vector3d& along_W) {
  const Eigen::Vector3d forward = along_W.normalized();
  const Eigen::Vector3d right = Eigen::Vector3d::UnitZ().cross(forward).normalized();
  Eigen::Matrix3d R_WE;
  R_WE << right, forward.cross(right), forward;
  return R_WE;
}

RigidTransform ChasePose(const World& world, const RigidTransform& X_WB, double rotor_diameter_m) {
  const double yaw = EulerFromRotation(X_WB.R).yaw_rad;
  const Eigen::Vector3d ahead(std::cos(yaw), std::sin(yaw), 0), down(0, 0, 1);
  const double size = rotor_diameter_m;
  Eigen::Vector3d eye = X_WB.p - 2.6 * size * ahead - 1.6 * size * down;
  const double highest = -SurfaceHeight(world, eye.x(), eye.y()) - kLeastClearance_m;
  eye.z() = std::min(eye.z(), highest);
  return {Looking(X_WB.p + 0.5 * size * (ahead + down) - eye), eye};
}

/// The vehicle and the ground that it sees.
void FrameSeen(const RigidTransform& X_WB, const World& world, const ViewFrustum& frustum,
               OrbitCamera& camera) {
  const Eigen::Vector3d& p = X_WB.p;
  Eigen::Vector3d ground(p.x(), p.y(), -world.ground.Height(p.x(), p.y()));
  double radius_m = 6;
  if (!frustum.outline_W.empty()) {
    Eigen::Vector3d low = frustum.outline_W.front(), high = low;
    for (const Eigen::Vector3d& each : frustum.outline_W) {
      low = low.cwiseMin(each);
      high = high.cwiseMax(each);
    }
    ground = (low + high) / 2;
    radius_m = std::clamp((high - low).head<2>().norm() / 2, 3.0, kMostRadius_m);
  }
  camera.Frame(p, ground, radius_m, EulerFromRotation(X_WB.R).yaw_rad);
}

}  // namespace

WorldEyePose EyePoseOf(WorldEye eye, const World& world, const RigidTransform& X_WB,
                       const ViewFrustum& frustum, double rotor_diameter_m, OrbitCamera& free,
                       int width_px, int height_px) {
  if (eye == WorldEye::kChase) {
    return {EyeCamera(kChaseView_rad, width_px, height_px),
            ChasePose(world, X_WB, rotor_diameter_m)};
  }
  OrbitCamera fixed;
  fixed.SetPreset(eye == WorldEye::kAbove ? View3dPreset::kAbove : View3dPreset::kOblique);
  fixed.Advance(INFINITY);
  OrbitCamera& camera = eye == WorldEye::kOrbit ? free : fixed;
  FrameSeen(X_WB, world, frustum, camera);
  RigidTransform X_WE = camera.X_WE(static_cast<double>(width_px) / height_px);
  const double highest = -SurfaceHeight(world, X_WE.p.x(), X_WE.p.y()) - kLeastClearance_m;
  X_WE.p.z() = std::min(X_WE.p.z(), highest);
  return {EyeCamera(camera.field_of_view_rad(), width_px, height_px), X_WE};
}

GLuint WorldViews::texture(WorldEye eye) const {
  const auto i = static_cast<std::size_t>(eye);
  return i < cameras_.size() ? cameras_[i].name() : targets_[i].texture();
}

/// True once the outside views can be drawn.
bool WorldViews::Prepare(bool wait) {
  if (renderer_) {
    return true;
  }
  std::unique_ptr<RayScene> light;
  if (world_.ground.material) {
    if (!light_.valid()) {
      light_ = std::async(std::launch::async, [world = world_] {
        auto scene = std::make_unique<RayScene>(world, kTexel_m);
        scene->ground().Texels();  // works them out here and not where the window is drawn
        return scene;
      });
      waits_for_ = "Working out the light of this world";
    }
    if (!wait && light_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
      return false;
    }
    light = light_.get();
  }
  Result<std::unique_ptr<WorldViewRenderer>> made = WorldViewRenderer::Create(world_, light.get());
  waits_for_ = made ? std::string() : made.error().message;
  if (made) {
    renderer_ = std::move(*made);
  }
  return made.ok();
}

bool WorldViews::Draw(const EngineSnapshot& snapshot, WorldEye eye, const Rect& rect,
                      const Key& key, double ui_scale, OrbitCamera& free) {
  const auto i = static_cast<std::size_t>(eye);
  if (key == drawn_[i] || rect.w < 16 || rect.h < 16) {
    return false;
  }
  const RigidTransform& X_WB = snapshot.sensors->truth->X_WB;
  const double rotor_m = snapshot.session->settings.slad.lander.rotor_diameter_m;
  const WorldEyePose pose =
      EyePoseOf(eye, world_, X_WB, frustum_, rotor_m, free, key.width, key.height);
  const WorldView view{.eye = pose.eye,
                       .X_WE = pose.X_WE,
                       .time_s = SecondsBetween(snapshot.session->source.start, snapshot.time),
                       .X_WB = X_WB,
                       .body = body_,
                       .rotor_diameter_m = rotor_m,
                       .frustum = &frustum_,
                       .ui_scale = ui_scale};
  if (const Status drawn = renderer_->Render(view, targets_[i], key.samples); !drawn) {
    waits_for_ = drawn.error().message;
    return false;
  }
  drawn_[i] = key;
  return true;
}

void WorldViews::Update(const EngineSnapshot& snapshot, const SimulateLayout& layout,
                        const Style& style, const SimulateState& state, OrbitCamera& free,
                        std::uint64_t moves, bool all) {
  const SensorsPart& sensors = *snapshot.sensors;
  if (sensors.frame && sensors.frame != frame_) {
    frame_ = sensors.frame;
    cameras_[0].Upload(frame_->left, TextureFilter::kLinear);
    cameras_[1].Upload(frame_->right, TextureFilter::kLinear);
  }
  if (!sensors.truth || !sensors.rig || (!all && MonotonicSeconds() < rested_at_s_) ||
      !Prepare(all)) {
    return;
  }
  const double began_s = MonotonicSeconds();
  if (frustum_of_ != snapshot.sequence) {
    frustum_of_ = snapshot.sequence;
    frustum_ = CastFrustum(world_.ground, sensors.rig->left.pinhole,
                           sensors.truth->X_WB * sensors.rig->X_BC());
  }
  bool drew = false;
  const auto draw = [&](std::size_t place, int samples, int part) {
    const WorldEye eye = state.eyes[place];
    if (eye == WorldEye::kLeft || eye == WorldEye::kRight) {
      return;
    }
    const Rect rect = PanelContent(layout.eyes[place], style);
    const Key key{snapshot.sequence, eye == WorldEye::kOrbit ? moves : 0,
                  static_cast<int>(rect.w) / part, static_cast<int>(rect.h) / part, samples};
    drew = Draw(snapshot, eye, rect, key, static_cast<double>(style.scale), free) || drew;
  };
  const int plainness = all ? 0 : plainness_;
  draw(0, plainness > 0 ? 1 : kSmoothSamples, plainness == kPlainest ? 2 : 1);
  for (std::size_t place = 1; place < state.eyes.size(); ++place) {
    if (all || place == turn_) {
      draw(place, all ? kSmoothSamples : 1, 1);
    }
  }
  turn_ = turn_ % (state.eyes.size() - 1) + 1;
  if (drew && !all) {
    glFinish();  // what a processor draws is drawn now, and its time known
    const double now_s = MonotonicSeconds(), took_s = now_s - began_s;
    rested_at_s_ = now_s + kRestPerWork * took_s;
    plainness_ = std::clamp(plainness_ + (took_s > kSlow_s) - (took_s < kQuick_s), 0, kPlainest);
  }
}

}  // namespace palace
