#include "engine/slad/hazards/hazard_maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <opencv2/core.hpp>

#include "engine/core/units.h"
#include "engine/model/cell_explanation.h"
#include "engine/model/site_standing.h"
#include "engine/slad/hazards/ground_classes.h"
#include "engine/slad/hazards/hazard_layers.h"
#include "engine/slad/hazards/hidden_things.h"
#include "engine/slad/hazards/loops/slad_loops.h"
#include "engine/slad/hazards/safe_distance.h"

namespace palace {
namespace {

static_assert(kSteep == kHazardSlope && kRough == kHazardRoughness && kStepped == kHazardStep &&
              kNotKnown == kHazardUnknown && kUnlikely == kHazardProbability);

class Judge {
 public:
  Judge(const TerrainFigures& figures, const SladSettings& settings, HazardMaps& hazards)
      : figures_(figures),
        hazards_(hazards),
        up_W_{static_cast<float>(settings.lander.up_W().x()),
              static_cast<float>(settings.lander.up_W().y()),
              static_cast<float>(settings.lander.up_W().z())},
        limits_(LimitsOf(settings, !figures.narrow.empty())),
        forbidden_flags_(ForbiddenFlags(settings.limits)) {}

  void Row(int r) const {
    const int cols = hazards_.geometry.cols;
    loops_.slope(figures_.north_gradient.row(r), figures_.east_gradient.row(r), up_W_.data(), cols,
                 hazards_.slope_rad.row(r));
    if (figures_.mode == SladMode::kThesis) {
      loops_.thesis_verdict({limits_.max_slope_rad, limits_.max_deviation_m},
                            hazards_.slope_rad.row(r), hazards_.roughness_m.row(r), cols,
                            hazards_.cost.row(r), hazards_.reasons.row(r));
      // A plane where the height itself is unknown has no roughness: it is no ground.
      for (int c = 0; c < cols; ++c) {
        float& slope = hazards_.slope_rad.at(r, c);
        slope = hazards_.reasons.at(r, c) == kHazardUnknown ? kUnknownValue : slope;
      }
      return;
    }
    loops_.modern_verdict(
        limits_,
        {hazards_.slope_rad.row(r), figures_.slope_sigma_rad.row(r),
         figures_.footprint_deviation_m.row(r), figures_.footprint_step_m.row(r),
         figures_.footprint_sigma_m.row(r), figures_.denoised_deviation_m.row(r),
         figures_.gear_tilt_rad.row(r), figures_.belly_rise_m.row(r), figures_.deviation_m.row(r),
         figures_.step_m.row(r), figures_.sigma_m.row(r), figures_.measured.row(r)},
        cols, {hazards_.safe_probability.row(r), hazards_.cost.row(r), hazards_.reasons.row(r)});
    if (!hazards_.flags.empty()) {
      ForbidFlagged(r);
    }
  }

 private:
  void ForbidFlagged(int r) const {
    for (int c = 0; c < hazards_.geometry.cols; ++c) {
      if ((hazards_.flags.at(r, c) & forbidden_flags_) != 0) {
        hazards_.reasons.at(r, c) |= kHazardFlagged;
        hazards_.cost.at(r, c) = std::isnan(hazards_.cost.at(r, c)) ? kUnknownValue : 1.0F;
      }
    }
  }

  const TerrainFigures& figures_;
  HazardMaps& hazards_;
  const std::array<float, 3> up_W_;
  const ModernLimits limits_;
  const unsigned forbidden_flags_;
  const SladLoops& loops_ = FastestSladLoops();
};

/// A touchdown is safe when the gear finds what was measured safe and nothing hides. What a mark
/// stands for that is no hazard yet nobody knows: such marks count up to what may hide in a place
/// that is offered, so that they ask for a nearer look and take no ground away.
void CountWhatHides(const NarrowFigures& narrow, const SladSettings& settings,
                    HazardMaps& hazards) {
  const NarrowView view{narrow, hazards.geometry.cell_m, settings.limits.max_deviation_m,
                        &hazards.safe_distance_m};
  const double radius_m = settings.lander.clear_radius_m();
  hazards.hidden_things = HiddenThings(view, radius_m);
  if (!narrow.mark.empty()) {
    FlagMarks(view, kMostHiddenProvisional, hazards.flags);
    const GridF marked = MarkedThings(view, radius_m);
    const auto most = static_cast<float>(-std::log(kOffered));
    for (std::size_t i = 0; i < marked.cells().size(); ++i) {
      float& hidden = hazards.hidden_things.cells()[i];
      hidden = std::max(hidden, std::min(hidden + marked.cells()[i], most));
    }
  }
  cv::parallel_for_(cv::Range(0, hazards.geometry.rows), [&](const cv::Range& rows) {
    for (int r = rows.start; r < rows.end; ++r) {
      for (int c = 0; c < hazards.geometry.cols; ++c) {
        hazards.safe_probability.at(r, c) *= std::exp(-hazards.hidden_things.at(r, c));
      }
    }
  });
}

HazardMaps LayersFor(const GridGeometry& geometry, const TerrainFigures& figures) {
  const bool modern = figures.mode == SladMode::kModern;
  HazardMaps hazards;
  hazards.geometry = geometry;
  hazards.flags = figures.flags;
  hazards.reasons = Grid<std::uint8_t>(geometry.rows, geometry.cols, kHazardNone);
  struct Layer {
    GridF& layer;
    const GridF* same_as;  ///< null: unknown
  };
  const std::array layers = {
      Layer{hazards.slope_rad, nullptr},
      Layer{hazards.cost, nullptr},
      Layer{hazards.safe_probability, nullptr},
      Layer{hazards.slope_sigma_rad, modern ? &figures.slope_sigma_rad : nullptr},
      Layer{hazards.roughness_m, modern ? &figures.footprint_deviation_m : &figures.deviation_m},
      Layer{hazards.roughness_sigma_m, modern ? &figures.footprint_sigma_m : nullptr},
      Layer{hazards.step_m, modern ? &figures.footprint_step_m : nullptr}};
  // Of large maps the system's work of handing out memory is most of it: threads share that too.
  cv::parallel_for_(cv::Range(0, static_cast<int>(layers.size())), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) {
      const Layer& made = layers[static_cast<std::size_t>(i)];
      made.layer = made.same_as != nullptr ? *made.same_as
                                           : GridF(geometry.rows, geometry.cols, kUnknownValue);
    }
  });
  return hazards;
}

}  // namespace

ModernLimits LimitsOf(const SladSettings& settings, bool finer_measured) {
  return {static_cast<float>(Rad(settings.limits.max_slope_deg)),
          static_cast<float>(settings.limits.max_deviation_m),
          static_cast<float>(settings.limits.max_step_m),
          static_cast<float>(settings.limits.min_safe_probability),
          static_cast<float>(kProvisionalSigma_m),
          static_cast<float>(settings.lander.belly_clearance_m),
          static_cast<float>(settings.lander.gear_width_m),
          finer_measured ? 0.0F : 1.0F};
}

unsigned ForbiddenFlags(const HazardLimits& limits) {
  const unsigned always = kFlagThinStructure | kFlagNoTexture | kFlagMotion | kFlagUnexplained;
  return limits.elevated == ElevatedSurface::kAvoid ? always | kFlagElevated : always;
}

HazardMaps JudgeTerrain(const GridGeometry& geometry, const TerrainFigures& figures,
                        const SladSettings& settings) {
  PALACE_CHECK(figures.HoldFor(settings));
  PALACE_CHECK(figures.deviation_m.empty() || (figures.deviation_m.rows() == geometry.rows &&
                                               figures.deviation_m.cols() == geometry.cols),
               figures.deviation_m.rows(), geometry.rows);
  HazardMaps hazards;
  hazards.geometry = geometry;
  if (figures.deviation_m.empty()) {
    return hazards;
  }
  hazards = LayersFor(geometry, figures);
  if (settings.mode == SladMode::kModern && !figures.narrow.mark.empty()) {
    FlagMarks({figures.narrow, geometry.cell_m, settings.limits.max_deviation_m}, kRatherAThing,
              hazards.flags);
  }
  const Judge judge(figures, settings, hazards);
  cv::parallel_for_(cv::Range(0, geometry.rows), [&](const cv::Range& rows) {
    for (int r = rows.start; r < rows.end; ++r) {
      judge.Row(r);
    }
  });
  hazards.safe_distance_m =
      SafeDistance(hazards.reasons, geometry.cell_m,
                   settings.mode == SladMode::kThesis ? DistanceTo::kCentre : DistanceTo::kSquare);
  if (settings.mode == SladMode::kModern && !figures.narrow.empty()) {
    CountWhatHides(figures.narrow, settings, hazards);
  }
  ClassifyCells(settings, hazards);
  return hazards;
}

HazardMaps EvaluateHazards(const ElevationMap& map, const SladSettings& settings) {
  return JudgeTerrain(map.geometry, MeasureTerrain(map, settings), settings);
}

}  // namespace palace
