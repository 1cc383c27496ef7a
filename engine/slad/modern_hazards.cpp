// Modern mode: footprint plane, deviations and steps beyond their noise, Gaussian tails.
#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Dense>

#include "engine/core/units.h"
#include "engine/slad/cost_map.h"
#include "engine/slad/hazard_layers.h"
#include "engine/slad/plane_fit.h"

namespace palace {
namespace {

/// Squared noise multiple: thousands of cells are tested, so a deviation counts beyond four sigmas
/// only.
constexpr float kNoise2 = 16;
/// Makes the squared deviation of an unknown cell negative whatever its height.
constexpr float kNever = 1e20F;
/// Known limit of attitude: the slope of everything is off by this much.
constexpr double kAttitudeSigma_rad = 0.1 * kRadPerDeg;
constexpr double kHeightSigmaFloor_m = 1e-3;
constexpr double kCorrelatedCells = 4;
constexpr int kMostOffsets = 24;

double BeyondNoise(float square) { return std::sqrt(std::max(0.0, static_cast<double>(square))); }

double Phi(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

/// Working layers, heights relative to a reference so that floats keep their digits.
struct Layers {
  GridF height;         ///< 0 where not measured
  GridF noise2;         ///< 16 sigma^2, kNever where not measured
  GridF plane;          ///< 0 where no plane
  GridF east, south;    ///< gradient per cell
  GridF step2;          ///< largest squared step to a neighbour beyond noise, -kNever none
  GridF step_at_cell2;  ///< the same where this cell is the one off the ground
  GridF footprint_deviation2;
  GridF footprint_step2;
};

Layers MakeLayers(const ElevationMap& map, const FootprintPlanes& planes) {
  const int rows = map.geometry.rows, cols = map.geometry.cols;
  const GridF zero(rows, cols, 0.0F), never(rows, cols, -kNever);
  Layers layers{zero, GridF(rows, cols, kNever), zero, zero, zero, never, never, never, never};
  float reference = 0;
  for (const float z : planes.plane.height_m.cells()) {
    if (!std::isnan(z)) {
      reference = z;
      break;
    }
  }
  const float cell = static_cast<float>(map.geometry.cell_m);
  for (std::size_t i = 0; i < map.state.cells().size(); ++i) {
    if (map.state.cells()[i] == CellState::kMeasured) {
      layers.height.cells()[i] = map.height_m.cells()[i] - reference;
      layers.noise2.cells()[i] = kNoise2 * map.variance_m2.cells()[i];
    }
    if (!std::isnan(planes.plane.height_m.cells()[i])) {
      layers.plane.cells()[i] = planes.plane.height_m.cells()[i] - reference;
      layers.east.cells()[i] = planes.plane.east_gradient.cells()[i] * cell;
      layers.south.cells()[i] = -planes.plane.north_gradient.cells()[i] * cell;
    }
  }
  return layers;
}

/// Steps between a cell and its eight neighbours, less what the ground plane itself rises.
void FindSteps(const ElevationMap& map, Layers& layers) {
  const int rows = map.geometry.rows, cols = map.geometry.cols;
  const auto off_ground = [&](int r, int c) {
    return std::abs(layers.height.at(r, c) - layers.plane.at(r, c));
  };
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < cols; ++c) {
      if (layers.noise2.at(r, c) >= kNever) {
        continue;
      }
      for (int k = 0; k < 9; ++k) {
        const int dr = k / 3 - 1, dc = k % 3 - 1;
        const Cell near{r + dr, c + dc};
        if (k == 4 || !map.geometry.Contains(near) || layers.noise2.at(near) >= kNever) {
          continue;
        }
        const float rise = layers.height.at(near) - layers.height.at(r, c) -
                           layers.east.at(r, c) * static_cast<float>(dc) -
                           layers.south.at(r, c) * static_cast<float>(dr);
        const float step2 = rise * rise - layers.noise2.at(r, c) - layers.noise2.at(near);
        layers.step2.at(r, c) = std::max(layers.step2.at(r, c), step2);
        // The cell that stands off the ground makes the step, not its level neighbour.
        if (off_ground(r, c) >= 0.9F * off_ground(near.row, near.col)) {
          layers.step_at_cell2.at(r, c) = std::max(layers.step_at_cell2.at(r, c), step2);
        }
      }
    }
  }
}

/// Largest deviation from the plane of each cell, and largest step, over its footprint disc. One
/// offset of the disc at a time, over whole rows: plain vector arithmetic.
void FindFootprintMaxima(double radius_cells, Layers& layers) {
  using Row = Eigen::Map<Eigen::ArrayXf>;
  using ConstRow = Eigen::Map<const Eigen::ArrayXf>;
  const int rows = layers.height.rows(), cols = layers.height.cols();
  const int reach = static_cast<int>(radius_cells);
  // A huge footprint on tiny cells is sampled: every cell is a hazard by itself anyway.
  const int stride = reach / kMostOffsets + 1;
  Eigen::ArrayXf base(cols);
  for (int r = 0; r < rows; ++r) {
    const ConstRow plane(layers.plane.row(r), cols), east(layers.east.row(r), cols),
        south(layers.south.row(r), cols);
    Row deviation(layers.footprint_deviation2.row(r), cols);
    Row step(layers.footprint_step2.row(r), cols);
    for (int dr = -(reach / stride) * stride; dr <= reach; dr += stride) {
      const int rr = r + dr;
      if (rr < 0 || rr >= rows) {
        continue;
      }
      base = plane + south * static_cast<float>(dr);
      const int half = static_cast<int>(std::sqrt(radius_cells * radius_cells - dr * dr));
      for (int dc = -(half / stride) * stride; dc <= half; dc += stride) {
        const int first = std::max(0, -dc), count = cols - std::abs(dc);
        if (count <= 0) {
          continue;
        }
        const ConstRow height(layers.height.row(rr) + first + dc, count);
        const ConstRow noise(layers.noise2.row(rr) + first + dc, count);
        const ConstRow step2(layers.step2.row(rr) + first + dc, count);
        auto out = deviation.segment(first, count);
        out = out.max((height - base.segment(first, count) -
                       east.segment(first, count) * static_cast<float>(dc))
                          .square() -
                      noise);
        auto out_step = step.segment(first, count);
        out_step = out_step.max(step2);
      }
    }
  }
}

/// Figures of one cell and the verdicts on them.
class CellJudge {
 public:
  CellJudge(const ElevationMap& map, const SladSettings& settings, const FootprintPlanes& planes,
            const Layers& layers, HazardMaps& hazards)
      : map_(map),
        settings_(settings),
        planes_(planes),
        layers_(layers),
        hazards_(hazards),
        up_W_(settings.up_W()),
        max_slope_(Rad(settings.max_slope_deg)) {
    // A rock covers several cells, whose noise averages as far as it is independent.
    const double rock_cells = std::pow(settings.max_rock_size_m / map.geometry.cell_m, 2);
    averaging_ = 1 / std::sqrt(std::max(1.0, rock_cells / kCorrelatedCells));
  }

  void Judge(int r, int c) {
    const CellState state = map_.state.at(r, c);
    std::uint8_t& reasons = hazards_.reasons.at(r, c);
    if (state != CellState::kMeasured) {
      reasons |= kHazardUnknown;
    }
    if (state == CellState::kUnknown || std::isnan(planes_.plane.height_m.at(r, c))) {
      reasons |= kHazardUnknown;
      return;
    }
    const double p_slope = JudgeSlope(r, c, reasons);
    JudgeFootprint(r, c, p_slope);
    JudgeCell(r, c, p_slope, reasons);
  }

 private:
  double JudgeSlope(int r, int c, std::uint8_t& reasons) {
    const double north = static_cast<double>(planes_.plane.north_gradient.at(r, c));
    const double east = static_cast<double>(planes_.plane.east_gradient.at(r, c));
    const double slope = SlopeOfGradient(north, east, up_W_);
    const double sigma = std::hypot(
        static_cast<double>(planes_.gradient_sigma.at(r, c)) / (1 + north * north + east * east),
        kAttitudeSigma_rad);
    hazards_.slope_rad.at(r, c) = static_cast<float>(slope);
    hazards_.slope_sigma_rad.at(r, c) = static_cast<float>(sigma);
    if (slope > max_slope_) {
      reasons |= kHazardSlope;
    }
    return Phi((max_slope_ - slope) / sigma);
  }

  double SafeFrom(double deviation, double step, double sigma) const {
    const double s = std::hypot(sigma * averaging_, kHeightSigmaFloor_m);
    return std::min(Phi((settings_.max_deviation_m - deviation) / s),
                    Phi((settings_.max_step_m - step) / (std::sqrt(2.0) * s)));
  }

  void JudgeFootprint(int r, int c, double p_slope) {
    const double roughness = BeyondNoise(layers_.footprint_deviation2.at(r, c));
    const double step = BeyondNoise(layers_.footprint_step2.at(r, c));
    const double sigma = std::sqrt(static_cast<double>(planes_.cell_variance_m2.at(r, c)));
    hazards_.roughness_m.at(r, c) = static_cast<float>(roughness);
    hazards_.roughness_sigma_m.at(r, c) = static_cast<float>(sigma * averaging_);
    hazards_.step_m.at(r, c) = static_cast<float>(step);
    hazards_.safe_probability.at(r, c) =
        static_cast<float>(p_slope * SafeFrom(roughness, step, sigma));
    hazards_.cost.at(r, c) = MaximumCost(
        static_cast<float>(static_cast<double>(hazards_.slope_rad.at(r, c)) / max_slope_),
        static_cast<float>(roughness / settings_.max_deviation_m),
        static_cast<float>(step / settings_.max_step_m));
  }

  void JudgeCell(int r, int c, double p_slope, std::uint8_t& reasons) {
    // A filled cell is judged by its filled height, so that it reads like its neighbours.
    const float off = map_.height_m.at(r, c) - planes_.plane.height_m.at(r, c);
    const float variance = map_.variance_m2.at(r, c);
    const double deviation = BeyondNoise(off * off - kNoise2 * variance);
    const double step = BeyondNoise(layers_.step_at_cell2.at(r, c));
    if (deviation > settings_.max_deviation_m) {
      reasons |= kHazardRoughness;
    }
    if (step > settings_.max_step_m) {
      reasons |= kHazardStep;
    }
    const double sigma = std::sqrt(static_cast<double>(variance));
    if (p_slope * SafeFrom(deviation, step, sigma) < settings_.min_safe_probability) {
      reasons |= kHazardProbability;
    }
    if (reasons != kHazardNone) {
      hazards_.cost.at(r, c) = 1.0F;
    }
  }

  const ElevationMap& map_;
  const SladSettings& settings_;
  const FootprintPlanes& planes_;
  const Layers& layers_;
  HazardMaps& hazards_;
  const Eigen::Vector3d up_W_;
  const double max_slope_;
  double averaging_ = 1;
};

}  // namespace

void EvaluateModern(const ElevationMap& map, const SladSettings& settings, HazardMaps& hazards) {
  const FootprintPlanes planes = FitFootprintPlanes(map, settings.lander_base_size_m);
  Layers layers = MakeLayers(map, planes);
  FindSteps(map, layers);
  FindFootprintMaxima(std::max(1.5, settings.lander_radius_m() / map.geometry.cell_m), layers);
  CellJudge judge(map, settings, planes, layers, hazards);
  for (int r = 0; r < map.geometry.rows; ++r) {
    for (int c = 0; c < map.geometry.cols; ++c) {
      judge.Judge(r, c);
    }
  }
}

}  // namespace palace
