#include "engine/slad/hazards/hazard_maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <utility>
#include <vector>

#include <opencv2/core.hpp>

#include "engine/core/units.h"
#include "engine/model/cell_explanation.h"
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

/// The foot of an obstacle stands out less than the limit allows and belongs to the obstacle all
/// the same: what touches a cell over a limit takes over its reason from this share of the limit on
/// (hysteresis, as Canny 1986 follows edges), as far as a rock is wide.
constexpr float kLowThreshold = 0.3F;

/// First column from c on with one of the wanted reasons, `cols` without; most cells have none.
int NextWith(unsigned wanted, const std::uint8_t* reasons, int c, int cols) {
  const std::uint64_t in_any_of_eight = 0x0101010101010101U * wanted;
  for (std::uint64_t eight = 0; c + 8 <= cols; c += 8) {
    std::memcpy(&eight, reasons + c, 8);
    if ((eight & in_any_of_eight) != 0) {
      break;
    }
  }
  while (c < cols && (reasons[c] & wanted) == 0) {
    ++c;
  }
  return c;
}

/// One reason spreads from the cells that have it.
void GrowFrom(std::vector<Cell> edge, HazardReason reason, int reach, float least_m,
              const TerrainFigures& figures, HazardMaps& hazards) {
  std::vector<Cell> grown;
  for (int step = 0; step < reach && !edge.empty(); ++step) {
    grown.clear();
    for (const Cell& from : edge) {
      for (int r = from.row - 1; r <= from.row + 1; ++r) {
        for (int c = from.col - 1; c <= from.col + 1; ++c) {
          const Cell cell{r, c};
          if (hazards.geometry.Contains(cell) && (hazards.reasons.at(cell) & reason) == 0 &&
              figures.deviation_m.at(cell) > least_m) {
            hazards.reasons.at(cell) |= static_cast<std::uint8_t>(reason);
            hazards.cost.at(cell) = 1;
            grown.push_back(cell);
          }
        }
      }
    }
    edge.swap(grown);
  }
}

void GrowByHysteresis(const TerrainFigures& figures, const SladSettings& settings,
                      HazardMaps& hazards) {
  const GridGeometry& g = hazards.geometry;
  const int reach = static_cast<int>(std::min(settings.lander.max_rock_size_m / g.cell_m, 1e6));
  std::vector<Cell> rough, stepped;
  for (int r = 0; reach > 0 && r < g.rows; ++r) {
    const std::uint8_t* reasons = hazards.reasons.row(r);
    constexpr unsigned kEither = kHazardRoughness | kHazardStep;
    for (int c = NextWith(kEither, reasons, 0, g.cols); c < g.cols;
         c = NextWith(kEither, reasons, c + 1, g.cols)) {
      if ((reasons[c] & kHazardRoughness) != 0) {
        rough.push_back({r, c});
      }
      if ((reasons[c] & kHazardStep) != 0) {
        stepped.push_back({r, c});
      }
    }
  }
  const float least_m = kLowThreshold * static_cast<float>(settings.limits.max_deviation_m);
  GrowFrom(std::move(rough), kHazardRoughness, reach, least_m, figures, hazards);
  GrowFrom(std::move(stepped), kHazardStep, reach, least_m, figures, hazards);
}

/// A touchdown is safe when the gear finds what was measured safe and nothing hides. What a mark
/// stands for nobody knows: marks count up to what may hide in a place that is offered, so that
/// they ask for a nearer look and take no ground away.
void CountWhatHides(const NarrowFigures& narrow, const SladSettings& settings,
                    HazardMaps& hazards) {
  const NarrowView view{narrow, hazards.geometry.cell_m, settings.limits.max_deviation_m,
                        &hazards.safe_distance_m};
  const double radius_m = settings.lander.clear_radius_m();
  hazards.hidden_things = HiddenThings(view, radius_m);
  if (!narrow.mark.empty()) {
    FlagMarks(view, hazards.flags);
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
  const unsigned always = kFlagThinStructure | kFlagNoTexture | kFlagMotion;
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
  const Judge judge(figures, settings, hazards);
  cv::parallel_for_(cv::Range(0, geometry.rows), [&](const cv::Range& rows) {
    for (int r = rows.start; r < rows.end; ++r) {
      judge.Row(r);
    }
  });
  if (settings.mode == SladMode::kModern) {
    GrowByHysteresis(figures, settings, hazards);
  }
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
