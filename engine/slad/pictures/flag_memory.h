// Flags of the map's cells over several maps, so that none flickers and none is forgotten at once.
//
// A flag is raised when two of the last three maps that saw the cell have it; on a cell seen once
// so far, by that one map (not for motion, which always needs two). Raised by two, it stays for a
// number of maps that see the cell without it: thin structures and motion 20, no texture 5, shadow
// 3. Cells out of view keep their flags, but motion there fades at the same rate. A thin structure
// of known height that runs within 15 degrees of the baseline is hardly seen: once it is raised,
// not to find it is no look at the cell. While it is in force its highest top counts, but a height
// that a map tells stands for one unknown, before or after. A line that a map tells to lie on the
// ground ends the flag of one of unknown height, and none is raised there for 20 maps that see the
// cell.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "engine/model/elevation_map.h"

namespace palace {

/// A thin structure above a cell.
struct ThinSight {
  /// Up-positive in W; infinite: unknown; minus infinity: a line that was told to lie on the
  /// ground.
  float top_m = std::numeric_limits<float>::quiet_NaN();
  float bearing_rad = 0;  ///< it runs to, clockwise from north
};

/// What one map tells of them.
struct ThinSights {
  Grid<ThinSight> cells;            ///< of the cells where one was found; empty: nothing is told
  double baseline_bearing_rad = 0;  ///< of the pair of cameras that looked
};

class FlagMemory {
 public:
  void Reset();
  /// The grid moves by whole cells; cells that leave it are forgotten. Another cell size starts
  /// afresh.
  void MoveTo(const GridGeometry& geometry);
  /// Nothing was ever in motion: the views that said so are doubted.
  void ForgetMotion();
  /// One map's findings: bits of `seen` say which flags were looked for in the cell, bits of
  /// `found` which were there. Both have the geometry's size.
  void Add(const Grid<std::uint8_t>& seen, const Grid<std::uint8_t>& found,
           const ThinSights& thin = {});
  /// The flags in force.
  Grid<std::uint8_t> Flags() const;
  /// Tops of the thin structures in force, NaN elsewhere; empty: none.
  GridF ThinTops() const;

 private:
  struct Track {
    std::uint8_t recent = 0;     ///< of the last three maps, newest in bit 0
    std::uint8_t looks = 0;      ///< maps that looked, at most three
    std::uint8_t maps_left = 0;  ///< it stays without being found
  };
  static constexpr std::array<TerrainFlag, 4> kKinds = {kFlagThinStructure, kFlagNoTexture,
                                                        kFlagShadow, kFlagMotion};
  static constexpr std::size_t kThin = 0, kMotion = 3;  ///< of kKinds
  struct CellTracks {
    std::array<Track, kKinds.size()> kinds;
    ThinSight thin;
    std::uint8_t lies_left = 0;  ///< maps a line of unknown height there counts as lying
  };
  static bool InForce(const CellTracks& cell, std::size_t kind);
  /// Whether what this map sees of a line there lies on the ground.
  static bool Lies(CellTracks& cell, const ThinSight& now, bool is_seen);

  GridGeometry geometry_;
  Grid<CellTracks> tracks_;
};

}  // namespace palace
