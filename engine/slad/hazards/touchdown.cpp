#include "engine/slad/hazards/touchdown.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

#include "engine/slad/hazards/hazard_layers.h"

namespace palace {
namespace {

constexpr int kFewestHeadings = 4, kMostHeadings = 32;
/// Cells the gear's corners may move from one heading to the next; a point feels a cell both ways.
constexpr double kCellsBetweenHeadings = 1.25;

/// The point (north_m, east_m) from the gear's middle, between the cells around it.
GearPoint PointAt(double north_m, double east_m, double cell_m, int pitch) {
  const double row = -north_m / cell_m, col = east_m / cell_m;
  // Rounding must not make a whole number of cells a hair less.
  const int r = static_cast<int>(std::floor(row + 1e-9)),
            c = static_cast<int>(std::floor(col + 1e-9));
  const double south = std::max(0.0, row - r), east = std::max(0.0, col - c);
  return {r * pitch + c,
          {static_cast<float>((1 - south) * (1 - east)), static_cast<float>((1 - south) * east),
           static_cast<float>(south * (1 - east)), static_cast<float>(south * east)}};
}

/// Denoised heights (slad_loops.h) around a site, off its plane.
struct DenoisedPlace {
  GridF height_m;         ///< the site in the middle
  float deviation_m = 0;  ///< largest off the plane over the footprint
};

DenoisedPlace DenoiseAround(const ElevationMap& map, const Lander& lander,
                            const LandingSite& site) {
  const double cell_m = map.geometry.cell_m;
  const double corner_m = std::hypot(lander.gear_length_m, lander.gear_width_m) / 2;
  const double radius_m = std::max(lander.radius_m(), kLeastDisc_cells * cell_m);
  // A huge lander is looked at over the map's width, where it cannot stand anyway.
  const int widest = std::max(map.geometry.rows, map.geometry.cols) + 2;
  const int reach = static_cast<int>(
      std::min<double>(std::ceil(std::max(corner_m, radius_m) / cell_m) + 3, widest));
  const int side = 2 * reach + 1, padded = side + 2 + kLaneSlack;
  const float north = static_cast<float>(-site.normal_W.x() / site.normal_W.z());
  const float east = static_cast<float>(-site.normal_W.y() / site.normal_W.z());
  const float step = static_cast<float>(cell_m);
  GridF height(side + 2, padded, 0.0F), known = height;  // a cell wider on every side
  GridF variance(side, side, 0.0F);
  const auto cell_at = [&](int r, int c) {
    return Cell{site.cell.row + r - reach, site.cell.col + c - reach};
  };
  for (int r = -1; r <= side; ++r) {
    for (int c = -1; c <= side; ++c) {
      const Cell cell = cell_at(r, c);
      if (map.geometry.Contains(cell) && !std::isnan(map.height_m.at(cell))) {
        height.at(r + 1, c + 1) =
            map.height_m.at(cell) - static_cast<float>(-site.p_WS.z()) -
            step * (static_cast<float>(c - reach) * east - static_cast<float>(r - reach) * north);
        known.at(r + 1, c + 1) = 1;
        if (r >= 0 && c >= 0 && r < side && c < side) {
          variance.at(r, c) = map.variance_m2.at(cell);
        }
      }
    }
  }
  DenoisedPlace place{GridF(side, side, kUnknownValue)};
  const std::vector<float> level(static_cast<std::size_t>(padded), 0.0F);
  std::vector<float> denoised(static_cast<std::size_t>(padded));
  for (int r = 0; r < side; ++r) {
    const auto row = [&](const GridF& layer, int south) { return layer.row(r + 1 + south) + 1; };
    FastestSladLoops().denoise({{row(height, -1), row(height, 0), row(height, 1)},
                                {row(known, -1), row(known, 0), row(known, 1)},
                                level.data(),
                                level.data(),
                                level.data(),
                                variance.row(r)},
                               side, denoised.data());
    for (int c = 0; c < side; ++c) {
      if (row(known, 0)[c] == 0) {
        continue;
      }
      const float off = denoised[static_cast<std::size_t>(c)];
      place.height_m.at(r, c) = off + step * (static_cast<float>(c - reach) * east -
                                              static_cast<float>(r - reach) * north);
      if (std::abs(off) > place.deviation_m &&
          std::hypot(r - reach, c - reach) * cell_m <= radius_m) {
        place.deviation_m = std::abs(off);
      }
    }
  }
  return place;
}

}  // namespace

GearOverMap::GearOverMap(const GridF& height_m, double cell_m, const Lander& lander,
                         const SladLoops& loops)
    : loops_(loops), rows_(height_m.rows()), cols_(height_m.cols()) {
  LayOut(lander, cell_m);
  CopyHeights(height_m);
}

double GearOverMap::heading_rad(int index) const { return index * M_PI / headings(); }

void GearOverMap::LayOut(const Lander& lander, double cell_m) {
  const double length_m = lander.gear_length_m, width_m = lander.gear_width_m;
  const bool skids = lander.gear == LandingGear::kSkids;
  const double corner_m = std::hypot(length_m, width_m) / 2;
  // An even number of gaps: one point is the middle.
  const double gaps =
      std::clamp(2 * std::ceil(length_m / cell_m / 2 - 1e-9), 2.0, kMostGearPoints - 1.0);
  const int points = skids ? static_cast<int>(gaps) + 1 : 2;
  stride_ = skids ? std::max(1, static_cast<int>(std::ceil(length_m / gaps / cell_m - 1e-9))) : 1;
  reach_ = static_cast<int>(std::ceil(corner_m / cell_m)) + stride_ + 1;
  const int pitch = cols_ + 2 * reach_ + kLaneSlack;
  // Even, so that ground turned by 90 degrees is tried in the same headings.
  const int headings = static_cast<int>(
      std::clamp(2 * std::ceil(M_PI * corner_m / cell_m / kCellsBetweenHeadings / 2 - 1e-9),
                 double{kFewestHeadings}, double{kMostHeadings}));
  const double spacing_m = length_m / (points - 1);
  heading_.resize(static_cast<std::size_t>(headings));
  belly_.resize(heading_.size());
  for (int h = 0; h < headings; ++h) {
    const double north = std::cos(heading_rad(h)), east = std::sin(heading_rad(h));
    GearHeading& heading = heading_[static_cast<std::size_t>(h)];
    heading.north = static_cast<float>(north);
    heading.east = static_cast<float>(east);
    for (int side = 0; side < 2; ++side) {
      const double y = (side - 0.5) * width_m;
      for (int k = 0; k < points; ++k) {
        const double x = spacing_m * (k - 0.5 * (points - 1));
        heading.point[side][k] = PointAt(x * north - y * east, x * east + y * north, cell_m, pitch);
      }
    }
    // Every stride-th cell: the layer then holds the highest around it.
    std::vector<BellyRow>& belly = belly_[static_cast<std::size_t>(h)];
    const int around = reach_ / stride_ * stride_;
    for (int r = -around; r <= around; r += stride_) {
      BellyRow row{};
      for (int c = -around; c <= around; c += stride_) {
        const double n = -r * cell_m, e = c * cell_m;
        if (std::abs(n * north + e * east) <= length_m / 2 &&
            std::abs(e * north - n * east) <= width_m / 2) {
          if (row.cells == 0) {
            row = {r * pitch + c, 0, stride_, static_cast<float>(n), static_cast<float>(e)};
          }
          ++row.cells;
        }
      }
      if (row.cells > 0) {
        belly.push_back(row);
      }
    }
    heading.belly_rows = static_cast<int>(belly.size());
    heading.belly_step_m = static_cast<float>(stride_ * cell_m);
    heading.belly = belly.data();
  }
  const Eigen::Vector3d up_W = lander.up_W();
  shape_ = {
      skids,
      points,
      static_cast<float>(spacing_m),
      static_cast<float>(width_m),
      {static_cast<float>(up_W.x()), static_cast<float>(up_W.y()), static_cast<float>(up_W.z())},
      pitch,
      headings,
      heading_.data()};
}

void GearOverMap::CopyHeights(const GridF& height_m) {
  const int rows = rows_ + 2 * reach_, cols = cols_ + 2 * reach_ + kLaneSlack;
  height_ = GridF(rows, cols, 0.0F);
  GridF unknown(rows, cols, 1.0F);
  const auto is_known = [](float z) { return !std::isnan(z); };
  const auto first = std::find_if(height_m.cells().begin(), height_m.cells().end(), is_known);
  const float reference = first != height_m.cells().end() ? *first : 0.0F;
  for (int r = 0; r < rows_; ++r) {
    const float* from = height_m.row(r);
    float *height = height_.row(r + reach_) + reach_, *none = unknown.row(r + reach_) + reach_;
    for (int c = 0; c < cols_; ++c) {
      height[c] = is_known(from[c]) ? from[c] - reference : 0.0F;
      none[c] = is_known(from[c]) ? 0.0F : 1.0F;
    }
  }
  FindUnknown(unknown);
  if (stride_ > 1) {
    const GridF lone = height_;
    const int half = stride_ / 2, inner = cols_ + 2 * (reach_ - half);
    std::vector<float> work(static_cast<std::size_t>(cols + 2 * half));
    for (int r = half; r < rows - half; ++r) {
      for (int dr = -half; dr <= half; ++dr) {
        loops_.window_maximum(lone.row(r + dr) + half, half, inner, work.data(),
                              height_.row(r) + half);
      }
    }
  }
}

void GearOverMap::FindUnknown(const GridF& unknown) {
  near_unknown_ = GridF(unknown.rows(), cols_, 0.0F);
  std::vector<float> work(static_cast<std::size_t>(unknown.cols()));
  for (int r = 0; r < unknown.rows(); ++r) {
    loops_.window_maximum(unknown.row(r) + reach_, reach_ - 1, cols_, work.data(),
                          near_unknown_.row(r));
  }
}

void GearOverMap::WorstOfRow(int row, float* tilt_rad, float* rise_m) const {
  const std::size_t padded = static_cast<std::size_t>(cols_ + kLaneSlack);
  std::vector<float> tan2(padded), rise(padded), unknown(padded), work(padded);
  for (int r = row + 1; r < row + 2 * reach_; ++r) {
    loops_.window_maximum(near_unknown_.row(r), 0, cols_, work.data(), unknown.data());
  }
  const auto is_known = [](float u) { return u == 0; };
  const auto end = unknown.begin() + cols_;
  const auto first = std::find_if(unknown.begin(), end, is_known);
  const auto last =
      std::find_if(std::reverse_iterator(end), std::reverse_iterator(first), is_known);
  const std::ptrdiff_t from = first - unknown.begin(), count = last.base() - first;
  if (count > 0) {
    loops_.put_gear_down(shape_, HeightRow(row) + from, static_cast<int>(count), tan2.data() + from,
                         rise.data() + from);
  }
  for (int c = 0; c < cols_; ++c) {
    const std::size_t i = static_cast<std::size_t>(c);
    const bool known = is_known(unknown[i]);
    tilt_rad[c] = known ? std::atan(std::sqrt(tan2[i])) : kUnknownValue;
    rise_m[c] = known ? rise[i] : kUnknownValue;
  }
}

bool GearOverMap::IsKnown(Cell cell) const {
  bool known = true;
  for (int r = cell.row + 1; r < cell.row + 2 * reach_; ++r) {
    known = known && near_unknown_.at(r, cell.col) == 0;
  }
  return known;
}

GearRest GearOverMap::At(Cell cell, int heading) const {
  if (!IsKnown(cell)) {
    return {};
  }
  GearShape one = shape_;
  one.headings = 1;
  one.heading = &heading_[static_cast<std::size_t>(heading)];
  float tan2[kLaneSlack], rise[kLaneSlack];
  loops_.put_gear_down(one, HeightRow(cell.row) + cell.col, 1, tan2, rise);
  return {std::atan(std::sqrt(tan2[0])), rise[0]};
}

TouchdownOdds OddsOfTouchdown(const ElevationMap& map, const HazardMaps& hazards,
                              const SladSettings& settings, const LandingSite& site) {
  TouchdownOdds odds;
  const float known = hazards.safe_probability.at(site.cell);
  if (settings.mode == SladMode::kThesis || std::isnan(known) || site.p_WS.hasNaN()) {
    return odds;
  }
  const DenoisedPlace place = DenoiseAround(map, settings.lander, site);
  const GearOverMap gear(place.height_m, map.geometry.cell_m, settings.lander);
  const Cell middle{place.height_m.rows() / 2, place.height_m.cols() / 2};
  // All figures but the gear's are those of the worst heading too.
  const ModernLimits limits = LimitsOf(settings, !hazards.hidden_things.empty());
  const float slope = hazards.slope_rad.at(site.cell);
  const float slope_sigma = hazards.slope_sigma_rad.at(site.cell);
  const float deviation = hazards.roughness_m.at(site.cell), step = hazards.step_m.at(site.cell);
  const float sigma = hazards.roughness_sigma_m.at(site.cell), none = 0;
  const unsigned char measured = 1;
  const double nothing_hides =
      hazards.hidden_things.empty()
          ? 1
          : std::exp(-static_cast<double>(hazards.hidden_things.at(site.cell)));
  odds.worst_probability = 2;
  odds.best_probability = -1;
  for (int h = 0; h < gear.headings(); ++h) {
    const GearRest rest = gear.At(middle, h);
    float share = 0, cost = 0;
    unsigned char reasons = 0;
    FastestSladLoops().modern_verdict(
        limits,
        {&slope, &slope_sigma, &deviation, &step, &sigma, &place.deviation_m, &rest.tilt_rad,
         &rest.rise_m, &none, &none, &sigma, &measured},
        1, {&share, &cost, &reasons});
    const double probability = nothing_hides * static_cast<double>(share);
    if (probability < odds.worst_probability) {
      odds.worst_probability = probability;
      odds.worst_heading_rad = gear.heading_rad(h);
    }
    if (probability > odds.best_probability) {
      odds.best_probability = probability;
      odds.best_heading_rad = gear.heading_rad(h);
    }
  }
  // The map's planes are each cell's own, the site's is one.
  odds.worst_probability = static_cast<double>(known);
  odds.best_probability = std::max(odds.best_probability, odds.worst_probability);
  return odds;
}

}  // namespace palace
