// Modern mode: footprint plane, deviations and steps beyond their noise.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "engine/slad/hazards/hazard_layers.h"
#include "engine/slad/hazards/loops/slad_loops.h"
#include "engine/slad/hazards/plane_fit.h"
#include "engine/slad/hazards/touchdown.h"
#include "engine/slad/side_by_side.h"

namespace palace {
namespace {

/// Squared noise multiple: thousands of cells are tested, so a deviation counts beyond four sigmas
/// only.
constexpr float kNoise2 = 16;
constexpr int kMostOffsets = 24;

float BeyondNoise(float square) { return square > 0 ? std::sqrt(square) : 0.0F; }
void BeyondNoiseOf(const float* square, int count, float* __restrict__ beyond) {
  for (int c = 0; c < count; ++c) {
    beyond[c] = BeyondNoise(square[c]);
  }
}

/// A layer with a rim, readable `rim` cells beyond the map on every side.
class RimmedLayer {
 public:
  RimmedLayer() = default;
  RimmedLayer(int rows, int cols, int rim, float fill)
      : rim_(rim), grid_(rows + 2 * rim, cols + 2 * rim + kLaneSlack, fill) {}
  float* row(int r) { return grid_.row(r + rim_) + rim_; }
  const float* row(int r) const { return grid_.row(r + rim_) + rim_; }

 private:
  int rim_ = 0;
  GridF grid_;
};

/// Working layers, heights relative to a reference so that floats keep their digits.
struct Layers {
  Layers(int rows, int cols, int rim) {
    SideBySide({[&] { height = RimmedLayer(rows, cols, rim, 0.0F); },
                [&] { noise2 = RimmedLayer(rows, cols, rim, kBeyondHeights); },
                [&] { step2 = RimmedLayer(rows, cols, rim, -kBeyondHeights); },
                [&] { plane = RimmedLayer(rows, cols, 1, 0.0F); },
                [&] { east = RimmedLayer(rows, cols, 0, 0.0F); },
                [&] { south = RimmedLayer(rows, cols, 0, 0.0F); }});
  }

  RimmedLayer height;  ///< 0 where not measured
  RimmedLayer noise2;  ///< 16 sigma^2, kBeyondHeights where not measured
  RimmedLayer step2;   ///< largest squared step to a neighbour beyond noise, -kBeyondHeights none
  RimmedLayer plane;   ///< 0 where no plane
  RimmedLayer east, south;  ///< gradient per cell
};

/// What heights are taken relative to: the first plane's.
float ReferenceOf(const FootprintPlanes& planes) {
  for (const float z : planes.plane.height_m.cells()) {
    if (!std::isnan(z)) {
      return z;
    }
  }
  return 0;
}

void FillLayers(const ElevationMap& map, const FootprintPlanes& planes, float reference,
                Layers& layers) {
  const int cols = map.geometry.cols;
  ForEach(map.geometry.rows, [&](int r) {
    // Values of the row's own: one that is captured might be what a row of floats writes.
    const float cell = static_cast<float>(map.geometry.cell_m), base = reference;
    const CellState* state = map.state.row(r);
    const float *height_m = map.height_m.row(r), *variance_m2 = map.variance_m2.row(r);
    float *height = layers.height.row(r), *noise2 = layers.noise2.row(r);
    for (int c = 0; c < cols; ++c) {
      const bool measured = state[c] == CellState::kMeasured;
      height[c] = measured ? height_m[c] - base : 0.0F;
      noise2[c] = measured ? kNoise2 * variance_m2[c] : kBeyondHeights;
    }
    const float* plane_m = planes.plane.height_m.row(r);
    const float* east_gradient = planes.plane.east_gradient.row(r);
    const float* north_gradient = planes.plane.north_gradient.row(r);
    float *plane = layers.plane.row(r), *east = layers.east.row(r), *south = layers.south.row(r);
    for (int c = 0; c < cols; ++c) {
      const bool spanned = !std::isnan(plane_m[c]);
      plane[c] = spanned ? plane_m[c] - base : 0.0F;
      east[c] = spanned ? east_gradient[c] * cell : 0.0F;
      south[c] = spanned ? -north_gradient[c] * cell : 0.0F;
    }
  });
}

/// Steps between a cell and its eight neighbours, less what the ground plane itself rises.
void FindSteps(const GridGeometry& geometry, Layers& layers, GridF& step_at_cell_m) {
  const SladLoops& loops = FastestSladLoops();
  const int cols = geometry.cols;
  ForEach(geometry.rows, [&](int r) {
    std::vector<float> at_cell2(static_cast<std::size_t>(cols + kLaneSlack));
    loops.steps({{layers.height.row(r - 1), layers.height.row(r), layers.height.row(r + 1)},
                 {layers.noise2.row(r - 1), layers.noise2.row(r), layers.noise2.row(r + 1)},
                 {layers.plane.row(r - 1), layers.plane.row(r), layers.plane.row(r + 1)},
                 layers.east.row(r),
                 layers.south.row(r)},
                cols, layers.step2.row(r), at_cell2.data());
    BeyondNoiseOf(at_cell2.data(), cols, step_at_cell_m.row(r));
  });
}

/// The disc of the footprint as runs of columns, one a row.
struct Disc {
  explicit Disc(double radius_cells) : reach(static_cast<int>(radius_cells)) {
    // A huge footprint on tiny cells is sampled: every cell is a hazard by itself anyway.
    stride = reach / kMostOffsets + 1;
    for (int dr = -(reach / stride) * stride; dr <= reach; dr += stride) {
      const int wide = static_cast<int>(std::sqrt(radius_cells * radius_cells - dr * dr));
      row_offset.push_back(dr);
      half.push_back(wide / stride * stride);
    }
  }
  int reach;
  int stride = 1;
  std::vector<int> row_offset, half;
};

/// Heights of all cells that have one, less their noise: what the gear is put down on.
struct Denoised {
  Denoised(int rows, int cols, int rim) {
    SideBySide({[&] { height = RimmedLayer(rows, cols, 0, 0.0F); },
                [&] { measured = RimmedLayer(rows, cols, rim, kUnknownValue); },
                [&] { known = GridF(rows, cols, 0.0F); }});
  }
  RimmedLayer height;    ///< 0 where not known
  RimmedLayer measured;  ///< the same where measured, NaN elsewhere
  GridF known;           ///< 1 or 0
};

void DenoiseHeights(const ElevationMap& map, const FootprintPlanes& planes, float reference,
                    const Layers& layers, Denoised& out) {
  const SladLoops& loops = FastestSladLoops();
  const int rows = map.geometry.rows, cols = map.geometry.cols;
  RimmedLayer height(rows, cols, 1, 0.0F), known(rows, cols, 1, 0.0F);
  ForEach(rows, [&](int r) {
    const float *z = map.height_m.row(r), *plane_m = planes.plane.height_m.row(r);
    const float base = reference;
    float* __restrict__ above = height.row(r);
    float* __restrict__ is_known = known.row(r);
    for (int c = 0; c < cols; ++c) {
      const bool both = !std::isnan(z[c]) && !std::isnan(plane_m[c]);
      above[c] = both ? z[c] - base : 0.0F;
      is_known[c] = both ? 1.0F : 0.0F;
    }
    std::copy_n(is_known, cols, out.known.row(r));
  });
  ForEach(rows, [&](int r) {
    loops.denoise({{height.row(r - 1), height.row(r), height.row(r + 1)},
                   {known.row(r - 1), known.row(r), known.row(r + 1)},
                   layers.plane.row(r),
                   layers.east.row(r),
                   layers.south.row(r),
                   map.variance_m2.row(r)},
                  cols, out.height.row(r));
    const CellState* state = map.state.row(r);
    const float* from = out.height.row(r);
    float* __restrict__ measured = out.measured.row(r);
    for (int c = 0; c < cols; ++c) {
      measured[c] = state[c] == CellState::kMeasured ? from[c] : kUnknownValue;
    }
  });
}

/// Largest deviation from the plane of each cell, and largest step, over its footprint disc.
void FindFootprintMaxima(const GridGeometry& geometry, const Disc& disc, const Layers& layers,
                         const Denoised& denoised, TerrainFigures& figures) {
  const SladLoops& loops = FastestSladLoops();
  const int cols = geometry.cols;
  ForEach(geometry.rows, [&](int r) {
    const std::size_t padded = static_cast<std::size_t>(cols + kLaneSlack);
    std::vector<float> deviation2(padded, -kBeyondHeights), step2(padded, -kBeyondHeights);
    std::vector<float> denoised_off(padded, 0.0F);
    std::vector<float> work(padded + 2 * static_cast<std::size_t>(disc.reach));
    std::vector<int> row_offset, half;
    std::vector<const float*> height, noise2, denoised_height;
    for (std::size_t i = 0; i < disc.half.size(); ++i) {
      const int rr = r + disc.row_offset[i];
      if (rr >= 0 && rr < geometry.rows) {
        row_offset.push_back(disc.row_offset[i]);
        half.push_back(disc.half[i]);
        height.push_back(layers.height.row(rr));
        noise2.push_back(layers.noise2.row(rr));
        denoised_height.push_back(denoised.measured.row(rr));
        loops.window_maximum(layers.step2.row(rr), disc.half[i], cols, work.data(), step2.data());
      }
    }
    loops.disc_deviation({static_cast<int>(half.size()), disc.stride, row_offset.data(),
                          half.data(), height.data(), noise2.data(), denoised_height.data()},
                         layers.plane.row(r), layers.east.row(r), layers.south.row(r), cols,
                         deviation2.data(), denoised_off.data());
    BeyondNoiseOf(deviation2.data(), cols, figures.footprint_deviation_m.row(r));
    BeyondNoiseOf(step2.data(), cols, figures.footprint_step_m.row(r));
    for (float& off : denoised_off) {
      off *= off;
    }
    BeyondNoiseOf(denoised_off.data(), cols, figures.denoised_deviation_m.row(r));
  });
}

void MeasureGearTilt(const GridGeometry& geometry, const Denoised& denoised, const Lander& lander,
                     TerrainFigures& figures) {
  GridF height_m(geometry.rows, geometry.cols, kUnknownValue);
  ForEach(geometry.rows, [&](int r) {
    const float *known = denoised.known.row(r), *from = denoised.height.row(r);
    float* __restrict__ height = height_m.row(r);
    for (int c = 0; c < geometry.cols; ++c) {
      height[c] = known[c] > 0 ? from[c] : kUnknownValue;
    }
  });
  const GearOverMap gear(height_m, geometry.cell_m, lander);
  ForEach(geometry.rows, [&](int r) {
    gear.WorstOfRow(r, figures.gear_tilt_rad.row(r), figures.belly_rise_m.row(r));
  });
}

/// Deviation and sigmas of each cell by itself; no figures where there is no plane.
void FindCellFigures(const ElevationMap& map, const Lander& lander, const FootprintPlanes& planes,
                     TerrainFigures& figures) {
  // A rock covers several cells, whose noise averages as far as it is independent.
  const double rock_cells = std::pow(lander.max_rock_size_m / map.geometry.cell_m, 2);
  const double averaging_of_rock = 1 / std::sqrt(std::max(1.0, rock_cells / kCorrelatedCells));
  const int cols = map.geometry.cols;
  ForEach(map.geometry.rows, [&](int r) {
    const CellState* state = map.state.row(r);
    const float averaging = static_cast<float>(averaging_of_rock);
    const float attitude2 = static_cast<float>(map.attitude_sigma_rad * map.attitude_sigma_rad);
    const float* off = planes.plane.residual_m.row(r);
    std::uint8_t* __restrict__ measured = figures.measured.row(r);
    std::vector<float> known(static_cast<std::size_t>(cols));  // 1 where there are figures, or 0
    float* __restrict__ has = known.data();
    for (int c = 0; c < cols; ++c) {
      measured[c] = state[c] == CellState::kMeasured ? 1 : 0;
      has[c] = state[c] != CellState::kUnknown && !std::isnan(off[c]) ? 1.0F : 0.0F;
    }
    const auto known_only = [&](const float* from, float* to) {
      for (int c = 0; c < cols; ++c) {
        to[c] = has[c] > 0 ? from[c] : kUnknownValue;
      }
    };
    const float *north = planes.plane.north_gradient.row(r),
                *east = planes.plane.east_gradient.row(r);
    known_only(north, figures.north_gradient.row(r));
    known_only(east, figures.east_gradient.row(r));
    known_only(figures.footprint_deviation_m.row(r), figures.footprint_deviation_m.row(r));
    known_only(figures.footprint_step_m.row(r), figures.footprint_step_m.row(r));
    const float *sigma = planes.gradient_sigma.row(r), *variance_m2 = map.variance_m2.row(r),
                *cell_variance_m2 = planes.cell_variance_m2.row(r);
    float *__restrict__ slope_sigma_rad = figures.slope_sigma_rad.row(r),
                        *__restrict__ deviation_m = figures.deviation_m.row(r),
                        *__restrict__ sigma_m = figures.sigma_m.row(r),
                        *__restrict__ footprint_sigma_m = figures.footprint_sigma_m.row(r);
    for (int c = 0; c < cols; ++c) {
      const float gradient_sigma = sigma[c] / (1 + north[c] * north[c] + east[c] * east[c]);
      const float slope_sigma = std::sqrt(gradient_sigma * gradient_sigma + attitude2);
      slope_sigma_rad[c] = has[c] > 0 ? slope_sigma : kUnknownValue;
    }
    for (int c = 0; c < cols; ++c) {
      // A filled cell is judged by its filled height, so that it reads like its neighbours.
      const float deviation = BeyondNoise(off[c] * off[c] - kNoise2 * variance_m2[c]);
      deviation_m[c] = has[c] > 0 ? deviation : kUnknownValue;
    }
    for (int c = 0; c < cols; ++c) {
      sigma_m[c] = has[c] > 0 ? averaging * std::sqrt(variance_m2[c]) : kUnknownValue;
      footprint_sigma_m[c] =
          has[c] > 0 ? averaging * std::sqrt(cell_variance_m2[c]) : kUnknownValue;
    }
  });
}

}  // namespace

void MeasureModern(const ElevationMap& map, const Lander& lander, TerrainFigures& figures) {
  const int rows = map.geometry.rows, cols = map.geometry.cols;
  const std::array layers_of_figures = {
      &figures.north_gradient,        &figures.east_gradient,    &figures.slope_sigma_rad,
      &figures.deviation_m,           &figures.sigma_m,          &figures.step_m,
      &figures.footprint_deviation_m, &figures.footprint_step_m, &figures.footprint_sigma_m,
      &figures.denoised_deviation_m,  &figures.gear_tilt_rad,    &figures.belly_rise_m};
  ForEach(static_cast<int>(layers_of_figures.size()), [&](int i) {
    *layers_of_figures[static_cast<std::size_t>(i)] = GridF(rows, cols, kUnknownValue);
  });
  figures.measured = Grid<std::uint8_t>(rows, cols, 0);
  const FootprintPlanes planes = FitFootprintPlanes(map, lander.base_size_m, figures.flags);
  const Disc disc(std::max(kLeastDisc_cells, lander.radius_m() / map.geometry.cell_m));
  Layers layers(rows, cols, disc.reach);
  const float reference = ReferenceOf(planes);
  FillLayers(map, planes, reference, layers);
  FindSteps(map.geometry, layers, figures.step_m);
  Denoised denoised(rows, cols, disc.reach);
  DenoiseHeights(map, planes, reference, layers, denoised);
  FindFootprintMaxima(map.geometry, disc, layers, denoised, figures);
  MeasureGearTilt(map.geometry, denoised, lander, figures);
  FindCellFigures(map, lander, planes, figures);
}

}  // namespace palace
