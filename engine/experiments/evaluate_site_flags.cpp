#include "engine/experiments/evaluate_site_flags.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "engine/core/random.h"
#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/experiments/flag_field.h"
#include "engine/report/statistics.h"

namespace palace {
namespace {

constexpr int kStillFrames = 4;
constexpr int kMovingFrames = 7;
constexpr double kWalk_mps = 0.5;

constexpr double kFalseLimit = 0.001;  // of the cells, where there is nothing

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

Result<std::vector<TrialRow>> RunTrial(int trial, std::uint64_t seed) {
  const TrialPlan plan = PlanOf(trial);
  const FlagField field =
      MakeFlagField(plan.texture, plan.height_ft * kMetresPerFoot, Rad(plan.tilt_deg), seed);
  const BakedGround ground = BakeFlagField(field, kMovingFrames, seed);
  RandomStream random(seed, "things");
  std::vector<TrialRow> rows;

  const auto add = [&](const char* kind, double size, double grey, double direction_deg,
                       double height_m, const FlagField& seen, unsigned flag,
                       const Belongs& belongs) -> Status {
    const int frames = flag == kFlagMotion || flag == 0 ? kMovingFrames : kStillFrames;
    const auto map = FlagsOfField(seen, frames, ground, seed);
    if (!map) {
      return map.error();
    }
    const Outcome o = Compare(**map, flag, belongs);
    rows.push_back({NameOf(plan.texture), CsvNumber(plan.height_ft), CsvNumber(plan.tilt_deg), kind,
                    CsvNumber(size), CsvNumber(grey), CsvNumber(direction_deg), CsvNumber(height_m),
                    CsvNumber(o.share), std::to_string(o.cells), std::to_string(o.thin),
                    std::to_string(o.bare), std::to_string(o.motion), std::to_string(o.shadow)});
    return Ok();
  };
  const auto with_wire = [&](const PaintedWire& wire) {
    FlagField wired = field;
    wired.world.wires.push_back(wire);
    return wired;
  };
  const double unknown = std::nan("");
  std::vector<std::function<Status()>> looks;
  looks.push_back([&] { return add("nothing", 0, unknown, unknown, unknown, field, 0, nullptr); });
  for (const double diameter_m : {0.01, 0.02, 0.03}) {
    for (const double grey : {40.0, 100.0, 220.0}) {
      looks.push_back([&, diameter_m, grey] {
        const WireCase made = MakeWire(field, diameter_m, grey, false, random);
        return add("wire", diameter_m * 100, grey, made.direction_deg, made.height_m,
                   with_wire(made.wire), kFlagThinStructure, made.below);
      });
    }
  }
  looks.push_back([&] {
    const WireCase made = MakeWire(field, 0.03, 220, true, random);
    return add("painted line", 3, 220, made.direction_deg, 0, with_wire(made.wire),
               kFlagThinStructure, made.below);
  });
  for (const double radius_m : {0.3, 0.6}) {
    looks.push_back([&, radius_m] {
      const PaintedPool pool{field.middle_north_m + random.Uniform(-1, 1), random.Uniform(-1, 1),
                             radius_m, 90};
      FlagField wet = field;
      wet.world.pools.push_back(pool);
      return add("pool", 2 * radius_m, 90, unknown, 0, wet, kFlagNoTexture,
                 [=](double n, double e) {
                   return std::hypot(n - pool.north_m, e - pool.east_m) < 0.75 * radius_m;
                 });
    });
  }
  looks.push_back([&] {
    const Eigen::Vector2d start(field.middle_north_m + random.Uniform(-1, 1),
                                random.Uniform(-1.5, 0.5));
    const double end_m = start.y() + kWalk_mps * 0.2 * (kMovingFrames - 1);
    FlagField walked = field;
    walked.world.solids.push_back(MakeBox(start.x(), start.y(), 0.5, 0.5, 1.6));
    walked.world.solids.back().v_WO.y() = kWalk_mps;
    return add("walker", kWalk_mps, unknown, unknown, 1.6, walked, kFlagMotion,
               [=](double n, double e) {
                 return std::abs(n - start.x()) < 0.25 && std::abs(e - end_m) < 0.25;
               });
  });
  for (const auto& look : looks) {
    const Status done = look();
    if (!done.ok()) {
      return done.error();
    }
  }
  return rows;
}

/// "97 % (92-99), 31 of 32" of the rows that pass; found is half of what should be flagged.
std::string Found(const TrialTable& table, const std::function<bool(double direction)>& passes) {
  const std::vector<double> shares = table.Numbers("share");
  const std::vector<double> directions = table.Numbers("direction_deg");
  int hits = 0, count = 0;
  for (std::size_t k = 0; k < shares.size(); ++k) {
    if (std::isfinite(shares[k]) && passes(directions[k])) {
      ++count;
      hits += shares[k] >= 0.5 ? 1 : 0;
    }
  }
  const Interval interval = WilsonInterval(hits, count);
  return count == 0
             ? "-"
             : OrDash("%.0f %% (", 100.0 * hits / count) + OrDash("%.0f-", 100 * interval.low) +
                   OrDash("%.0f), ", 100 * interval.high) + std::to_string(hits) + " of " +
                   std::to_string(count);
}

ExperimentReport Report(const TrialTable& table) {
  ExperimentReport report{HtmlPage("Flags from pictures and motion")};
  const auto line = [&](const std::string& text) { report.lines.push_back(text); };
  const auto any = [](double) { return true; };
  report.page.Paragraph(
      "Found: at least half of the cells that should carry the flag do. Wires run across the "
      "picture; direction is counted from the baseline's, 0 degrees along it. Intervals: Wilson, "
      "95 %.");

  const TrialTable wires = table.Where("thing", "wire");
  std::vector<std::vector<std::string>> rows;
  const auto steep = [](double direction_deg) { return direction_deg >= 15; };
  for (const std::string& size : wires.Values("size")) {
    for (const std::string& grey : wires.Values("grey")) {
      const TrialTable part = wires.Where("size", size).Where("grey", grey);
      std::vector<std::string> row = {size, grey};
      for (const char* texture : {"cloud", "gravel", "grass", "asphalt"}) {
        row.push_back(Found(part.Where("texture", texture), steep));
      }
      row.push_back(Found(part, steep));
      row.push_back(Found(part, [](double d) { return d < 15; }));
      line("wire " + size + " cm, grey " + grey + ": found " + row[6] +
           "; within 15 deg of the baseline " + row[7]);
      rows.push_back(std::move(row));
    }
  }
  report.page.Heading("Wires").Table(
      {"thickness, cm", "grey", "cloud", "gravel", "grass", "asphalt", "all, from 15 degrees",
       "within 15 degrees of the baseline"},
      rows);
  rows.clear();
  for (const std::string& height : wires.Values("height_ft")) {
    for (const std::string& tilt : wires.Values("tilt_deg")) {
      const TrialTable part = wires.Where("height_ft", height).Where("tilt_deg", tilt);
      rows.push_back({height, tilt, Found(part, steep)});
      line("wires from " + height + " ft, tilt " + tilt + " deg: found " + rows.back()[2]);
    }
  }
  report.page.Table({"height, ft", "tilt, degrees", "found, from 15 degrees"}, rows);

  rows.clear();
  struct Thing {
    const char *name, *size, *unit;
  };
  for (const Thing& thing : {Thing{"pool", "diameter", "m"},
                             {"walker", "speed", "m/s"},
                             {"painted line", "width", "cm"}}) {
    const TrialTable part = table.Where("thing", thing.name);
    for (const std::string& size : part.Values("size")) {
      const std::string named = std::string(thing.size) + " " + size + " " + thing.unit;
      rows.push_back({thing.name, named, Found(part.Where("size", size), any)});
      line(std::string(thing.name) + ", " + named + ": flagged " + rows.back()[2]);
    }
  }
  report.page.Heading("Other things")
      .Paragraph("A painted line should not be flagged.")
      .Table({"thing", "size", "flagged"}, rows);

  rows.clear();
  const TrialTable nothing = table.Where("thing", "nothing");
  const auto falses = [&](const TrialTable& part, const std::string& name) {
    const double cells = part.Sum("cells");
    std::vector<std::string> row = {name};
    double worst = 0;
    for (const char* column : {"thin_cells", "bare_cells", "motion_cells", "shadow_cells"}) {
      const double share = part.Sum(column) / cells;
      row.push_back(OrDash("%.4f %%", 100 * share));
      worst = column == std::string("shadow_cells") ? worst : std::max(worst, share);
    }
    line("nothing there, " + name + ": thin " + row[1] + ", no texture " + row[2] + ", motion " +
         row[3] + ", shadow " + row[4] + " of the cells");
    rows.push_back(std::move(row));
    return worst;
  };
  for (const std::string& texture : nothing.Values("texture")) {
    falses(nothing.Where("texture", texture), texture);
  }
  const double worst = falses(nothing, "all");
  report.page.Heading("Where there is nothing")
      .Table({"ground", "thin structure", "no texture", "motion", "shadow"}, rows);
  report.passed = !(worst > kFalseLimit);
  report.page.Verdict(report.passed, "At most " + OrDash("%.1f %%", 100 * kFalseLimit) +
                                         " of the cells flagged falsely, each kind by itself");
  return report;
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
  experiment.report = Report;
  return experiment;
}

}  // namespace palace
