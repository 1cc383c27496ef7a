#include "engine/experiments/flag_field.h"

#include <cmath>

#include "engine/core/random.h"
#include "engine/core/units.h"

namespace palace {
FlagField MakeFlagField(GroundTexture texture, double height_m, double tilt_rad,
                        std::uint64_t seed) {
  RandomStream random(seed, "flag field");
  FlagField field;
  field.world.ground.texture = texture;
  field.world.ground.texture_seed = seed;
  field.view.height_m = height_m;
  field.view.tilt_rad = tilt_rad;
  field.view.field_of_view_rad = Rad(45);
  field.view.frame_interval_s = kFlagInterval_s;
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

Result<std::shared_ptr<const ElevationMap>> FlagsOfField(const FlagField& field, int frames,
                                                         const BakedGround& ground,
                                                         std::uint64_t seed) {
  HoverView view = field.view;
  view.frames = frames;
  const auto seen = LookAtField(field.world, view, StereoSettings{}, seed, &ground);
  if (!seen) {
    return seen.error();
  }
  return MapOfField(*seen, SladSettings{}).elevation();
}

}  // namespace palace
