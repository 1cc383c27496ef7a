#include "engine/experiments/flag_field.h"

#include <cmath>
#include <utility>

#include "engine/camera/pinhole.h"
#include "engine/core/random.h"
#include "engine/core/units.h"
#include "engine/slad/slad.h"
#include "engine/stereo/stereo.h"

namespace palace {
namespace {

constexpr double kInterval_s = 0.2;

std::vector<RigidTransform> PosesOf(const FlagField& field, int frames, std::uint64_t seed) {
  HoverView view = field.view;
  view.frames = frames;
  return HoverPoses(view, seed);
}

RigidTransform RightOf(const RigidTransform& X_WC, double baseline_m) {
  return {X_WC.R, X_WC.p + baseline_m * X_WC.R.col(0)};
}

/// As navigation reports it: off by the view's errors.
RigidTransform Believed(const RigidTransform& X_WC, const HoverView& view, RandomStream& random) {
  const double angle_rad = view.attitude_error_rad;
  const EulerAngles off{angle_rad * random.Normal(), angle_rad * random.Normal(),
                        angle_rad * random.Normal()};
  const double north = random.Normal(), east = random.Normal(), down = random.Normal();
  return {X_WC.R * RotationFromEuler(off),
          X_WC.p + view.position_error_m * Eigen::Vector3d(north, east, down)};
}

}  // namespace

FlagField MakeFlagField(GroundTexture texture, double height_m, double tilt_rad,
                        std::uint64_t seed) {
  RandomStream random(seed, "flag field");
  FlagField field;
  field.world.ground.texture = texture;
  field.world.ground.texture_seed = seed;
  field.view.height_m = height_m;
  field.view.tilt_rad = tilt_rad;
  field.view.field_of_view_rad = Rad(45);
  field.middle_north_m = tilt_rad < -Rad(89) ? 0.0 : height_m / std::tan(-tilt_rad);
  const double reach_m = 0.3 * height_m;
  const auto place = [&] { return random.Uniform(-reach_m, reach_m); };
  for (int k = 0; k < 5; ++k) {
    const double north_m = field.middle_north_m + place(), east_m = place();
    for (const Solid& part : MakeTrafficCone(north_m, east_m, 0.71)) {
      field.world.solids.push_back(part);
    }
    const double box_north_m = field.middle_north_m + place(), box_east_m = place();
    const double length_m = random.Uniform(0.2, 1.5), width_m = random.Uniform(0.2, 1.5);
    field.world.solids.push_back(
        MakeBox(box_north_m, box_east_m, length_m, width_m, random.Uniform(0.1, 1.0)));
  }
  return field;
}

BakedGround BakeFlagField(const FlagField& field, int frames, std::uint64_t seed) {
  return BakeForHover(field.world, field.view, PosesOf(field, frames, seed));
}

Result<std::shared_ptr<const ElevationMap>> FlagsOfField(const FlagField& field, int frames,
                                                         const BakedGround& ground,
                                                         std::uint64_t seed) {
  const HoverView& view = field.view;
  const PinholeCamera camera =
      PinholeFromFov(view.width_px, view.height_px, view.field_of_view_rad);
  RandomStream navigation(seed, "pose errors"), sensor(seed, "sensor seeds");
  const std::vector<RigidTransform> poses = PosesOf(field, frames, seed);
  StereoMatcher matcher;
  Slad slad;
  const StereoSettings settings;
  for (int k = 0; k < frames; ++k) {
    const World world = WorldAt(field.world, k * kInterval_s);
    const RigidTransform& X_WC = poses[static_cast<std::size_t>(k)];
    const auto look = [&](const RigidTransform& X) {
      return std::make_shared<const ImageU8>(
          Expose(DrawGrey(world, camera, X, ground), {view.noise_grey}, sensor.NextBits()));
    };
    SladInput input;
    input.view.left = look(X_WC);
    input.view.right = look(RightOf(X_WC, view.baseline_m));
    const ViewPose believed{Believed(X_WC, view, navigation)};
    input.p_WB = believed.X_WC.p;
    auto stereo = matcher.Match(
        *input.view.left, *input.view.right, camera, view.baseline_m,
        PredictWindow(camera, view.baseline_m, believed.X_WC, 0, kTallestObject_m, settings),
        settings, AddSeconds({}, k * kInterval_s));
    if (!stereo) {
      return stereo.error();
    }
    stereo->range.pose = believed;
    input.view.range = std::make_shared<const RangeMap>(std::move(stereo->range));
    slad.Add(input, SladSettings{});
  }
  return slad.elevation();
}

}  // namespace palace
