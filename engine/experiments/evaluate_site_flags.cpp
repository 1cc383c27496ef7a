#include "engine/experiments/evaluate_site_flags.h"

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "engine/core/random.h"
#include "engine/core/units.h"
#include "engine/experiments/flag_field.h"

namespace palace {
namespace {

constexpr int kStillFrames = 4;
constexpr int kMovingFrames = 7;
constexpr double kWalk_mps = 0.5;

/// What one look flagged, and how it compares with what is there.
struct Outcome {
  double share = std::nan("");  ///< of the cells that should carry the flag
  int cells = 0;
  int thin = 0, bare = 0, motion = 0, shadow = 0;
};

using Belongs = std::function<bool(double north_m, double east_m)>;

Outcome Compare(const ElevationMap& map, unsigned flag, const Belongs& belongs) {
  Outcome outcome;
  int wanted = 0, found = 0;
  for (int r = 0; r < map.geometry.rows; ++r) {
    for (int c = 0; c < map.geometry.cols; ++c) {
      const unsigned flags = map.flags.at(r, c);
      ++outcome.cells;
      outcome.thin += (flags & kFlagThinStructure) != 0;
      outcome.bare += (flags & kFlagNoTexture) != 0;
      outcome.motion += (flags & kFlagMotion) != 0;
      outcome.shadow += (flags & kFlagShadow) != 0;
      if (belongs && belongs(map.geometry.NorthOfRow(r), map.geometry.EastOfCol(c))) {
        ++wanted;
        found += (flags & flag) != 0;
      }
    }
  }
  outcome.share = wanted > 0 ? double(found) / wanted : std::nan("");
  return outcome;
}

struct TrialPlan {
  GroundTexture texture;
  double height_ft;
  double tilt_deg;
};

TrialPlan PlanOf(int trial) {
  return {static_cast<GroundTexture>(trial % 4), trial / 4 % 2 == 0 ? 50.0 : 30.0,
          trial / 8 % 2 == 0 ? -90.0 : -45.0};
}

/// A wire across the picture at a random place, its direction from the baseline's, and what is
/// straight below it and seen by both cameras.
struct WireCase {
  PaintedWire wire;
  double direction_deg = 0;
  double height_m = 0;
  Belongs below;
};

WireCase MakeWire(const FlagField& field, double diameter_m, double grey, bool painted,
                  RandomStream& random) {
  WireCase made;
  const double tilt = -field.view.tilt_rad;
  made.height_m = painted ? 0.001 : random.Uniform(0.12, 0.33) * field.view.height_m;
  const double azimuth_rad = random.Uniform(0, Rad(180));  // 0 north, across the baseline
  made.direction_deg = Deg(std::abs(azimuth_rad - Rad(90)));
  const Eigen::Vector2d along(std::cos(azimuth_rad), std::sin(azimuth_rad));
  const Eigen::Vector2d aside(-along.y(), along.x());
  // Where the camera's axis passes the wire's height.
  const double north_m =
      tilt > Rad(89) ? 0.0 : (field.view.height_m - made.height_m) / std::tan(tilt);
  const Eigen::Vector2d middle =
      Eigen::Vector2d(north_m, 0) + random.Uniform(-0.1, 0.1) * field.view.height_m * aside;
  const auto end = [&](double length_m) {
    const Eigen::Vector2d p = middle + length_m * along;
    return Eigen::Vector3d(p.x(), p.y(), -made.height_m);
  };
  made.wire = {end(-30), end(30), diameter_m, grey};
  // The middle third of what the picture shows of it.
  const double reach_m = 0.1 * (field.view.height_m - made.height_m) / std::sin(tilt);
  made.below = [=](double n, double e) {
    const Eigen::Vector2d off = Eigen::Vector2d(n, e) - middle;
    return std::abs(off.dot(aside)) < 0.08 && std::abs(off.dot(along)) < reach_m;
  };
  return made;
}

/// One thing on the field and what it should be flagged as; 0: nothing should be.
struct Thing {
  const char* kind;
  double size = 0;  ///< of a wire cm, of a pool m, of a walker m/s
  double grey = std::nan("");
  double direction_deg = std::nan("");
  double height_m = std::nan("");
  FlagField field;
  unsigned flag = 0;
  Belongs belongs{};
};

Thing WireThing(const FlagField& field, const char* kind, double diameter_m, double grey,
                RandomStream& random) {
  const bool painted = kind != std::string("wire");
  const WireCase made = MakeWire(field, diameter_m, grey, painted, random);
  Thing thing{.kind = kind, .size = 100 * diameter_m, .grey = grey, .field = field};
  thing.direction_deg = made.direction_deg;
  thing.height_m = painted ? 0 : made.height_m;
  thing.field.world.wires.push_back(made.wire);
  thing.flag = kFlagThinStructure;
  thing.belongs = made.below;
  return thing;
}

Thing PoolThing(const FlagField& field, double radius_m, RandomStream& random) {
  const double north_m = field.middle_north_m + random.Uniform(-1, 1);
  const PaintedPool pool{north_m, random.Uniform(-1, 1), radius_m, 90};
  Thing thing{.kind = "pool", .size = 2 * radius_m, .grey = 90, .height_m = 0, .field = field};
  thing.field.world.pools.push_back(pool);
  thing.flag = kFlagNoTexture;
  thing.belongs = [=](double n, double e) {
    return std::hypot(n - pool.north_m, e - pool.east_m) < 0.75 * pool.radius_m;
  };
  return thing;
}

Thing WalkerThing(const FlagField& field, RandomStream& random) {
  const double north_m = field.middle_north_m + random.Uniform(-1, 1);
  const double start_m = random.Uniform(-1.5, 0.5);
  const double end_m = start_m + kWalk_mps * kFlagInterval_s * (kMovingFrames - 1);
  Thing thing{.kind = "walker", .size = kWalk_mps, .height_m = 1.6, .field = field};
  thing.field.world.solids.push_back(MakeBox(north_m, start_m, 0.5, 0.5, 1.6));
  thing.field.world.solids.back().v_WO.y() = kWalk_mps;
  thing.flag = kFlagMotion;
  thing.belongs = [=](double n, double e) {
    return std::abs(n - north_m) < 0.25 && std::abs(e - end_m) < 0.25;
  };
  return thing;
}

std::vector<Thing> ThingsOn(const FlagField& field, std::uint64_t seed) {
  RandomStream random(seed, "things");
  std::vector<Thing> things = {{.kind = "nothing", .field = field}};
  for (const double diameter_m : {0.01, 0.02, 0.03}) {
    for (const double grey : {40.0, 100.0, 220.0}) {
      things.push_back(WireThing(field, "wire", diameter_m, grey, random));
    }
  }
  things.push_back(WireThing(field, "painted line", 0.03, 220, random));
  for (const double radius_m : {0.3, 0.6}) {
    things.push_back(PoolThing(field, radius_m, random));
  }
  things.push_back(WalkerThing(field, random));
  return things;
}

Result<std::vector<TrialRow>> RunTrial(int trial, std::uint64_t seed) {
  const TrialPlan plan = PlanOf(trial);
  FlagField field =
      MakeFlagField(plan.texture, plan.height_ft * kMetresPerFoot, Rad(plan.tilt_deg), seed);
  field.view.frames = kMovingFrames;
  const BakedGround ground = BakeForHover(field.world, field.view, HoverPoses(field.view, seed));
  std::vector<TrialRow> rows;
  for (const Thing& thing : ThingsOn(field, seed)) {
    const bool may_move = thing.flag == kFlagMotion || thing.flag == 0;
    const auto map =
        FlagsOfField(thing.field, may_move ? kMovingFrames : kStillFrames, ground, seed);
    if (!map) {
      return map.error();
    }
    const Outcome o = Compare(**map, thing.flag, thing.belongs);
    rows.push_back({NameOf(plan.texture), CsvNumber(plan.height_ft), CsvNumber(plan.tilt_deg),
                    thing.kind, CsvNumber(thing.size), CsvNumber(thing.grey),
                    CsvNumber(thing.direction_deg), CsvNumber(thing.height_m), CsvNumber(o.share),
                    std::to_string(o.cells), std::to_string(o.thin), std::to_string(o.bare),
                    std::to_string(o.motion), std::to_string(o.shadow)});
  }
  return rows;
}

}  // namespace

Experiment SiteFlagsExperiment() {
  Experiment experiment;
  experiment.name = "site-flags";
  experiment.purpose = "Wires, painted lines, still water, walking: what pictures add to heights";
  experiment.default_trials = 64;
  experiment.columns = {"texture",    "height_ft",     "tilt_deg",     "thing",       "size",
                        "grey",       "direction_deg", "above_m",      "share",       "cells",
                        "thin_cells", "bare_cells",    "motion_cells", "shadow_cells"};
  experiment.setup = [] { return std::string("field of view 45 deg, noise 2 grey"); };
  experiment.run = RunTrial;
  experiment.report = ReportSiteFlags;
  return experiment;
}

}  // namespace palace
