// World files: a simulated world that a person writes (TOML).
//
//   name = "yard"
//   [ground]   material = "grass"  seed  albedo  contrast  scale  turn_deg  rise_north_deg
//              rise_east_deg
//   [relief]   rms_m  longest_m  shortest_m  hurst  seed  size_m: gentle or rough ground, fractal
//              file = "dem.tif"  at: heights of a GeoTIFF, its middle at that place, above or below
//              those where the vehicle starts; without `at` it lies in the middle of the relief
//   [sun]      azimuth_deg  elevation_deg; or by date and place (sun_position.h):
//              utc = "2004-06-21 19:09:00"  latitude_deg  longitude_deg
//   [[hole]]   at = [north, east]  diameter_m  depth_m
//   [[ditch]]  from  to  width_m  depth_m
//   [[mound]]  at  diameter_m  height_m: a cosine bell
//   [[line]]   from  to  width_m  material ...: flat paint
//   [[patch]]  outline = [n1, e1, n2, e2, ...]  material ...
//   [[pool]]   at  diameter_m
//   [[box]]    at  size_m = [north, east, height]  turn_deg  albedo  moves_mps = [north, east]
//   [[cylinder]] [[cone]]   at  diameter_m  height_m  albedo  moves_mps
//   [[mesh]]   file = "rock.obj"  at  turn_deg  scale  y_up  open  albedo  moves_mps: triangles of an
//              OBJ or PLY file; metres, x east, y north, z up unless scale and y_up say otherwise
//   [[rod]]    from = [north, east, height]  to = [...]  diameter_m: a pole, wire or rail
//
// Lengths in metres of W: north and east of where the vehicle starts, which looks north; heights
// above the ground there. Files are named from the world file's folder. Every key is checked; an
// error names file, line, key, value and limit, and nothing is half loaded.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "engine/core/result.h"
#include "engine/world/world.h"

namespace palace {

Result<World> LoadWorld(const std::filesystem::path& path);
/// `name` for messages; files that it names lie in `folder`.
Result<World> ParseWorld(const std::string& text, const std::string& name,
                         const std::filesystem::path& folder = {});

/// A name of SceneNames(), drawn by the seed, or the path of a world file (*.toml).
Result<World> OpenWorld(const std::string& name_or_path, std::uint64_t seed);

}  // namespace palace
