#include "engine/simulation/stereo_cameras.h"

#include <algorithm>
#include <future>
#include <utility>

#include "engine/camera/camera_model.h"
#include "engine/world/optics.h"

namespace palace {
namespace {

/// The right camera's pose beside the left one's, in its axes.
RigidTransform PlaceOfRight(const StereoRig& rig) {
  if (!rig.left.model || !rig.right.model) {
    return {Eigen::Matrix3d::Identity(), {rig.baseline_m, 0, 0}};
  }
  const Eigen::Matrix3d R_C0F = RotationOf(*rig.left.model);
  return {R_C0F * RotationOf(*rig.right.model).transpose(),
          R_C0F * (CentreOf(*rig.right.model) - CentreOf(*rig.left.model))};
}

PixelResponse ResponseOf(const CameraFigures& figures, bool right) {
  return {figures.gain * (right ? figures.brightness_gain_right : 1),
          right ? figures.offset_right_grey : figures.offset_left_grey, figures.noise_grey,
          figures.full_well_electrons};
}

int HeightOf(const RigCamera& camera) {
  return camera.model ? HeightOf(*camera.model) : camera.pinhole.height;
}

}  // namespace

StereoCameras::StereoCameras(const VehicleDescription& vehicle, Timestamp start, std::uint64_t seed)
    : figures_(vehicle.sensors.camera),
      X_BC0_(vehicle.rig.X_BC()),
      start_(start),
      clock_rate_(1 + vehicle.clock_drift),
      rows_(std::max(HeightOf(vehicle.rig.left), HeightOf(vehicle.rig.right))),
      left_{vehicle.rig.left,
            {},
            0,
            {ResponseOf(figures_, false), seed, "camera left"},
            RandomStream(seed, "camera left repeats")},
      right_{vehicle.rig.right,
             PlaceOfRight(vehicle.rig),
             figures_.right_late_s,
             {ResponseOf(figures_, true), seed, "camera right"},
             RandomStream(seed, "camera right repeats")},
      drops_(seed, "camera drops") {}

void StereoCameras::SetRig(const StereoRig& rig) {
  X_BC0_ = rig.X_BC();
  left_.camera = rig.left;
  right_.camera = rig.right;
  right_.X_C0C = PlaceOfRight(rig);
  left_.tiles.clear();
  right_.tiles.clear();
}

double StereoCameras::window_s() const {
  return figures_.exposure_s + figures_.line_delay_s * (rows_ - 1);
}

double StereoCameras::age_s() const {
  return figures_.latency_s + window_s() / 2 + std::max(0.0, figures_.right_late_s);
}

Result<ImageF> StereoCameras::Light(const Side& side, const PictureTile& tile, SceneCamera& scene,
                                    const PoseHistory& history, Timestamp middle) const {
  const int samples = figures_.exposure_s > 0 ? figures_.exposure_samples : 1;
  ImageF light(tile.camera.width, tile.camera.height);
  for (int i = 0; i < samples; ++i) {
    const Timestamp time = AddSeconds(middle, figures_.exposure_s * ((i + 0.5) / samples - 0.5));
    const RigidTransform X_WC = history.TrueAt(time) * X_BC0_ * side.X_C0C;
    const Result<ImageU8> drawn = scene.Render(tile.camera, {X_WC.R * tile.R_CT, X_WC.p},
                                               SecondsBetween(start_, time) / clock_rate_);
    if (!drawn) {
      return drawn.error();
    }
    for (std::size_t k = 0; k < light.pixels().size(); ++k) {
      light.pixels()[k] += static_cast<float>(drawn->pixels()[k]);
    }
  }
  for (float& grey : light.pixels()) {
    grey /= static_cast<float>(samples);
  }
  return ThroughLens(tile, std::move(light));
}

Result<ImageF> StereoCameras::Expose(Side& side, SceneCamera& scene, const PoseHistory& history,
                                     Timestamp stamp) const {
  if (side.tiles.empty()) {
    side.tiles = TilesOf(side.camera, figures_.line_delay_s > 0 ? figures_.shutter_bands : 1);
  }
  const PictureTile& end = side.tiles.back();
  ImageF light(end.x + end.width, end.y + end.height);
  for (const PictureTile& tile : side.tiles) {
    const double row = tile.y + (tile.height - 1) / 2.0 - (light.height() - 1) / 2.0;
    const Timestamp middle = AddSeconds(stamp, side.late_s + row * figures_.line_delay_s);
    const Result<ImageF> part = Light(side, tile, scene, history, middle);
    if (!part) {
      return part.error();
    }
    for (int y = 0; y < tile.height; ++y) {
      std::copy_n(part->row(y), tile.width, &light.at(tile.x, tile.y + y));
    }
  }
  return light;
}

ImageU8 StereoCameras::ReadOut(Side& side, ImageF light) const {
  Blur(light, figures_.blur_px);
  Vignette(light, figures_.vignetting);
  ImageU8 picture = side.noise.Apply(light);
  const bool again = side.repeats.Uniform() < figures_.repeated && !side.last.empty();
  if (!again) {
    side.last = std::move(picture);
  }
  return side.last;
}

Result<std::shared_ptr<const StereoFrame>> StereoCameras::Deliver(SceneCamera& scene,
                                                                  const PoseHistory& history,
                                                                  Timestamp now) {
  auto frame = std::make_shared<StereoFrame>();
  frame->time = AddSeconds(now, -age_s());
  Result<ImageF> left = Expose(left_, scene, history, frame->time);
  if (!left) {
    return left.error();
  }
  std::future<ImageU8> left_read =
      std::async(std::launch::async, [&] { return ReadOut(left_, std::move(left).value()); });
  Result<ImageF> right = Expose(right_, scene, history, frame->time);
  if (!right) {
    return right.error();  // the future waits
  }
  frame->right = ReadOut(right_, std::move(right).value());
  frame->left = left_read.get();
  if (drops_.Uniform() < figures_.dropped) {
    return std::shared_ptr<const StereoFrame>();
  }
  return std::shared_ptr<const StereoFrame>(std::move(frame));
}

}  // namespace palace
