// Colour maps and the pictures of the five maps (look.md section 3).
#pragma once

#include <array>
#include <cstdint>

#include "engine/model/grid.h"
#include "engine/model/hazard_maps.h"
#include "engine/model/image.h"
#include "engine/model/settings/settings.h"
#include "gui/render/picture.h"

namespace palace {

enum class ColourMap : std::uint8_t { kViridis, kCividis, kMagma, kInferno, kSafeDistance };
using ColourTable = std::array<Rgba8, 256>;

/// 256 entries, low to high. Viridis, magma, inferno: S. van der Walt and N. Smith 2015; cividis:
/// Nunez, Anderton, Renslow 2018. Interpolated from a few stops each, within 6 of 255 of the
/// published tables. Safe distance: six even stops, dark is far from hazard.
const ColourTable& TableOf(ColourMap map);

/// Values at the first and the last colour; beyond them the end colours.
struct ValueRange {
  float low = 0;
  float high = 1;
};

/// Fixed ranges of all maps. Elevation is set once per mission; the others follow the limits:
/// slope, roughness and safe distance over so many limits (map_scale.h), cost 0..1.
struct MapRanges {
  ValueRange elevation_m{-0.5F, 1.5F};
  ValueRange slope_rad;
  ValueRange roughness_m;
  ValueRange cost;
  ValueRange safe_distance_m;
};
MapRanges RangesFor(const SladSettings& settings, ValueRange elevation_m);
/// A round elevation range for a mission's first map: from 0.5 m below the median to 1.5 m above,
/// on half metres. The default range when nothing is known.
ValueRange ElevationRangeFor(const GridF& height_m);

/// Unknown (NaN) cells, before the panel's hatch.
inline constexpr Rgba8 kUnknownColour = RgbaFromHex(0x1B222B);

/// One pixel a cell, row 0 northernmost.
ImageRgba MapPicture(const GridF& values, ValueRange range, ColourMap map);
/// Colour of one value; kUnknownColour for NaN.
Rgba8 ColourOf(float value, ValueRange range, ColourMap map);

/// Of DifferencePicture.
inline constexpr Rgba8 kKeptSafe = RgbaFromHex(0x2B6FB5);
inline constexpr Rgba8 kLostSafe = RgbaFromHex(0xF0963C);
inline constexpr Rgba8 kGainedSafe = RgbaFromHex(0xF2F5F8);

/// What became of each safe cell: kept safe, lost, gained, unsafe in both #161C22, unknown in both
/// kUnknownColour. A cell is safe when it can bear the lander. Maps of
/// different geometry are compared by place; cells of `now` outside `before` count as unsafe there.
ImageRgba DifferencePicture(const HazardMaps& before, const HazardMaps& now);

/// Depths that hold all but the nearest and farthest 2 % of the pixels, on half metres.
ValueRange DepthRangeFor(const ImageF& depth_m);
/// Viridis at 55 % over the left picture, clear where the depth is unknown.
ImageRgba RangeTint(const ImageF& depth_m, ValueRange range_m);

}  // namespace palace
