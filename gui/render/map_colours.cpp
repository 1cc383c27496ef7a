#include "gui/render/map_colours.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/core/median.h"
#include "engine/core/units.h"
#include "gui/render/map_scale.h"

namespace palace {
namespace {

// Even stops of each map; the table is linear in between.
using Stops = std::array<std::uint32_t, 33>;
constexpr Stops kViridis = {0x440154, 0x470D60, 0x48186A, 0x482374, 0x472D7B, 0x453781, 0x424086,
                            0x3E4989, 0x3B528B, 0x375B8D, 0x33638D, 0x2F6B8E, 0x2C728E, 0x297A8E,
                            0x26828E, 0x23898E, 0x21918C, 0x1F978B, 0x1F9F88, 0x21A685, 0x27AD81,
                            0x31B57B, 0x3DBC74, 0x4CC26C, 0x5CC863, 0x6ECE58, 0x81D34D, 0x95D840,
                            0xAADC32, 0xC0DF25, 0xD5E21A, 0xEAE51A, 0xFDE725};
constexpr Stops kCividis = {0x00224E, 0x00285B, 0x002E6A, 0x053371, 0x1A386F, 0x273E6E, 0x32436D,
                            0x3B496C, 0x434E6C, 0x4B546C, 0x535A6D, 0x5A5F6E, 0x61656F, 0x686A71,
                            0x6F7073, 0x767676, 0x7D7C78, 0x838179, 0x8B8778, 0x928D78, 0x9A9376,
                            0xA29975, 0xAAA073, 0xB3A670, 0xBBAD6D, 0xC3B369, 0xCCBA64, 0xD4C15F,
                            0xDDC858, 0xE6D051, 0xEFD748, 0xF8DF3C, 0xFEE838};
constexpr Stops kMagma = {0x000004, 0x030312, 0x0A0822, 0x130D34, 0x1D1147, 0x29115A, 0x36106B,
                          0x440F76, 0x51127C, 0x5D177F, 0x6A1C81, 0x762181, 0x832681, 0x902A81,
                          0x9C2E7F, 0xAA337D, 0xB73779, 0xC23B75, 0xCF4070, 0xDB476A, 0xE55064,
                          0xEE5B5E, 0xF4695C, 0xF9785D, 0xFB8761, 0xFD9668, 0xFEA571, 0xFEB47B,
                          0xFEC287, 0xFED194, 0xFDE0A1, 0xFCEEB0, 0xFCFDBF};
constexpr Stops kInferno = {0x000004, 0x040312, 0x0B0724, 0x150B37, 0x210C4A, 0x2F0A5B, 0x3D0965,
                            0x4A0C6B, 0x57106E, 0x64156E, 0x71196E, 0x7D1E6D, 0x8A226A, 0x972766,
                            0xA32C61, 0xB0315B, 0xBC3754, 0xC63D4D, 0xD04545, 0xDA4E3C, 0xE35933,
                            0xEB6429, 0xF1711F, 0xF67E14, 0xF98C0A, 0xFB9B06, 0xFCAA0F, 0xFBBA1F,
                            0xF9C932, 0xF5D949, 0xF2E865, 0xF3F586, 0xFCFFA4};
constexpr std::array<std::uint32_t, 6> kSafeDistance = {0xDCE9F7, 0x9CC3EA, 0x5B97D6,
                                                        0x2F67AE, 0x173D7A, 0x0A2250};

constexpr Rgba8 kUnsafeInBoth = RgbaFromHex(0x161C22);

std::uint8_t Between(std::uint8_t a, std::uint8_t b, double t) {
  return static_cast<std::uint8_t>(std::lround(a + (b - a) * t));
}

template <std::size_t N>
ColourTable TableFrom(const std::array<std::uint32_t, N>& stops) {
  ColourTable table;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double x = static_cast<double>(i) / 255.0 * (N - 1);
    const std::size_t k = std::min<std::size_t>(static_cast<std::size_t>(x), N - 2);
    const double t = x - static_cast<double>(k);
    const Rgba8 a = RgbaFromHex(stops[k]), b = RgbaFromHex(stops[k + 1]);
    table[i] = {Between(a.r, b.r, t), Between(a.g, b.g, t), Between(a.b, b.b, t), 255};
  }
  return table;
}

Rgba8 Look(const ColourTable& table, float value, ValueRange range) {
  if (std::isnan(value)) {
    return kUnknownColour;
  }
  const float share = (value - range.low) / (range.high - range.low);
  const float index = std::clamp(share * 255.0F, 0.0F, 255.0F);
  return table[static_cast<std::size_t>(std::lround(index))];
}

}  // namespace

const ColourTable& TableOf(ColourMap map) {
  static const std::array<ColourTable, 5> kTables = {TableFrom(kViridis), TableFrom(kCividis),
                                                     TableFrom(kMagma), TableFrom(kInferno),
                                                     TableFrom(kSafeDistance)};
  return kTables[static_cast<std::size_t>(map)];
}

MapRanges RangesFor(const SladSettings& settings, ValueRange elevation_m) {
  MapRanges ranges;
  ranges.elevation_m = elevation_m;
  ranges.slope_rad = {0,
                      static_cast<float>(kSlopeLimitsShown * Rad(settings.limits.max_slope_deg))};
  ranges.roughness_m = {
      0, static_cast<float>(kRoughnessLimitsShown * settings.limits.max_deviation_m)};
  ranges.cost = {0, 1};
  ranges.safe_distance_m = {
      0, static_cast<float>(kClearRadiiShown * settings.lander.clear_radius_m())};
  return ranges;
}

ValueRange ElevationRangeFor(const GridF& height_m) {
  std::vector<float> known;
  known.reserve(height_m.cells().size());
  for (const float height : height_m.cells()) {
    if (!std::isnan(height)) {
      known.push_back(height);
    }
  }
  if (known.empty()) {
    return MapRanges{}.elevation_m;
  }
  const float low = std::round((UpperMedian(known) - 0.5F) * 2.0F) / 2.0F;
  return {low, low + 2.0F};
}

Rgba8 ColourOf(float value, ValueRange range, ColourMap map) {
  return Look(TableOf(map), value, range);
}

ImageRgba MapPicture(const GridF& values, ValueRange range, ColourMap map) {
  ImageRgba picture(values.cols(), values.rows());
  const ColourTable& table = TableOf(map);
  for (std::size_t i = 0; i < values.cells().size(); ++i) {
    picture.pixels()[i] = Look(table, values.cells()[i], range);
  }
  return picture;
}

ValueRange DepthRangeFor(const ImageF& depth_m) {
  constexpr std::size_t kStride = 7;  // a sample of the pixels is enough for colours
  std::vector<float> known;
  for (std::size_t i = 0; i < depth_m.pixels().size(); i += kStride) {
    const float depth = depth_m.pixels()[i];
    if (std::isfinite(depth)) {
      known.push_back(depth);
    }
  }
  if (known.empty()) {
    return {0, 1};
  }
  const auto at = [&known](double share) {
    const auto k = static_cast<std::ptrdiff_t>(share * static_cast<double>(known.size() - 1));
    std::nth_element(known.begin(), known.begin() + k, known.end());
    return known[static_cast<std::size_t>(k)];
  };
  const float near = std::floor(at(0.02) * 2.0F) / 2.0F;
  const float far = std::ceil(at(0.98) * 2.0F) / 2.0F;
  return {near, std::max(far, near + 0.5F)};
}

ImageRgba RangeTint(const ImageF& depth_m, ValueRange range_m) {
  constexpr std::uint8_t kTintAlpha = 140;
  ImageRgba tint(depth_m.width(), depth_m.height());
  const ColourTable& table = TableOf(ColourMap::kViridis);
  for (std::size_t i = 0; i < depth_m.pixels().size(); ++i) {
    const float depth = depth_m.pixels()[i];
    Rgba8 colour = Look(table, depth, range_m);
    colour.a = std::isfinite(depth) ? kTintAlpha : std::uint8_t{0};
    tint.pixels()[i] = colour;
  }
  return tint;
}

ImageRgba DifferencePicture(const HazardMaps& before, const HazardMaps& now) {
  const GridGeometry& geometry = now.geometry;
  ImageRgba picture(geometry.cols, geometry.rows);
  for (int row = 0; row < geometry.rows; ++row) {
    for (int col = 0; col < geometry.cols; ++col) {
      const std::uint8_t reasons = now.reasons.at(row, col);
      const std::optional<Cell> cell =
          before.geometry.CellFromPoint(geometry.NorthOfRow(row), geometry.EastOfCol(col));
      const bool was_safe = cell && CanBearLander(before, *cell);
      const bool was_unknown = !cell || (before.reasons.at(*cell) & kHazardUnknown) != 0;
      const bool is_safe = CanBearLander(now, {row, col});
      const bool is_unknown = (reasons & kHazardUnknown) != 0;
      picture.at(col, row) = is_safe && was_safe         ? kKeptSafe
                             : is_safe                   ? kGainedSafe
                             : was_safe                  ? kLostSafe
                             : is_unknown && was_unknown ? kUnknownColour
                                                         : kUnsafeInBoth;
    }
  }
  return picture;
}

}  // namespace palace
