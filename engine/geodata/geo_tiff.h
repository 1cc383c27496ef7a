// Map layers as GeoTIFF files: float32, one band, NaN where unknown, north up.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "engine/core/result.h"
#include "engine/model/grid.h"

namespace palace {

/// Of a place from its system's origin, metres east or north. Gauss-Kruger systems put the zone's
/// number, up to 120, in front of an easting of six digits; farther lies nothing, and cells would
/// fall together.
inline constexpr double kFarthestPlace_m = 1.3e8;

/// One layer with its place. Rows north to south, as grids are.
struct MapLayer {
  GridGeometry geometry;
  GridF cells;
  std::optional<int> epsg;  ///< projected coordinate system, where the file names one
};

/// Writes pixel scale and tie point (top-left corner of the north-west cell), NaN as no-data.
Status WriteGeoTiff(const std::filesystem::path& path, const MapLayer& layer);

/// Reads one-band strips or tiles of 8 to 64 bits; no-data becomes NaN. Refuses, saying what to do:
/// files without a place, rotated, in degrees, in feet, with cells that are not square or not
/// between 1 mm and 1 km, farther than 130 000 km from their origin, larger than 8192 cells a side,
/// with a no-data value that is no number, cut off, or no TIFF at all. `room` is asked before the
/// cells are read, and what it refuses is refused with the file's name.
Result<MapLayer> ReadGeoTiff(const std::filesystem::path& path,
                             const std::function<Status(const GridGeometry&)>& room = {});

}  // namespace palace
