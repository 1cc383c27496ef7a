#include "engine/slad/pictures/flag_memory.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace palace {
namespace {

/// Maps a raised flag stays without being found, in the order of kKinds.
constexpr std::array<std::uint8_t, 4> kStays = {20, 5, 3, 20};
constexpr unsigned kLastThree = 7;
constexpr double kHardlySeen_rad = 0.26;  // from the baseline

/// Whether lines of these bearings run alike, either way.
bool RunAlike(double a_rad, double b_rad) {
  return std::abs(std::sin(a_rad - b_rad)) < std::sin(kHardlySeen_rad);
}

/// Whether a line there was told to lie on the ground.
bool IsToldToLie(const ThinSight& sight) { return std::isinf(sight.top_m) && sight.top_m < 0; }

}  // namespace

void FlagMemory::Reset() {
  geometry_ = {};
  tracks_ = {};
}

void FlagMemory::MoveTo(const GridGeometry& geometry) {
  if (geometry == geometry_) {
    return;
  }
  tracks_ = MovedTo(geometry, geometry_, tracks_);
  geometry_ = geometry;
}

void FlagMemory::ForgetMotion() {
  for (CellTracks& cell : tracks_.cells()) {
    cell.kinds[kMotion] = {};
  }
}

void FlagMemory::Add(const Grid<std::uint8_t>& seen, const Grid<std::uint8_t>& found,
                     const ThinSights& thin) {
  PALACE_CHECK(seen.rows() == geometry_.rows && found.rows() == geometry_.rows &&
                   seen.cols() == geometry_.cols && found.cols() == geometry_.cols,
               seen.rows(), found.rows(), geometry_.rows);
  PALACE_CHECK(thin.cells.empty() ||
                   (thin.cells.rows() == geometry_.rows && thin.cells.cols() == geometry_.cols),
               thin.cells.rows(), geometry_.rows);
  for (std::size_t cell = 0; cell < tracks_.cells().size(); ++cell) {
    ThinSight& known = tracks_.cells()[cell].thin;
    const ThinSight now = thin.cells.empty() ? ThinSight{} : thin.cells.cells()[cell];
    const bool lies = Lies(tracks_.cells()[cell], now, (seen.cells()[cell] & kKinds[kThin]) != 0);
    for (std::size_t k = 0; k < kKinds.size(); ++k) {
      Track& track = tracks_.cells()[cell].kinds[k];
      const bool is_found = (found.cells()[cell] & kKinds[k]) != 0 && !(k == kThin && lies);
      const bool is_blind = k == kThin && !is_found && !IsToldToLie(now) && track.maps_left > 0 &&
                            std::isfinite(known.top_m) &&
                            RunAlike(double{known.bearing_rad}, thin.baseline_bearing_rad);
      if ((seen.cells()[cell] & kKinds[k]) == 0 || is_blind) {
        const bool fades = kKinds[k] == kFlagMotion;
        track.maps_left -= fades && track.maps_left > 0 ? 1 : 0;
        track.recent = fades ? std::uint8_t{0} : track.recent;
        continue;
      }
      track.recent =
          static_cast<std::uint8_t>(((track.recent << 1U) | (is_found ? 1U : 0U)) & kLastThree);
      track.looks = static_cast<std::uint8_t>(std::min(3, track.looks + 1));
      const bool twice = std::popcount(track.recent) >= 2;
      if (is_found && twice) {
        track.maps_left = kStays[k];
      } else if (track.maps_left > 0) {
        --track.maps_left;
      }
    }
    if (thin.cells.empty()) {
      continue;
    }
    // A height that was told stands for one unknown, before or after.
    const bool is_told = std::isinf(known.top_m) && std::isfinite(now.top_m);
    const bool was_told = std::isfinite(known.top_m) && std::isinf(now.top_m);
    const bool is_kept = InForce(tracks_.cells()[cell], kThin) &&
                         (was_told || (known.top_m >= now.top_m && !is_told));
    if (!std::isnan(now.top_m)) {
      known = is_kept ? known : now;
    } else if (!InForce(tracks_.cells()[cell], kThin)) {
      known = {};
    }
  }
}

bool FlagMemory::Lies(CellTracks& cell, const ThinSight& now, bool is_seen) {
  if (IsToldToLie(now)) {
    cell.lies_left = kStays[kThin];
    if (std::isinf(cell.thin.top_m)) {
      cell.kinds[kThin] = {};
    }
    return true;
  }
  cell.lies_left -= is_seen && cell.lies_left > 0 ? 1 : 0;
  return std::isinf(now.top_m) && cell.lies_left > 0;
}

bool FlagMemory::InForce(const CellTracks& cell, std::size_t kind) {
  const Track& track = cell.kinds[kind];
  const bool first_look = kKinds[kind] != kFlagMotion && track.looks == 1 && track.recent == 1;
  return track.maps_left > 0 || first_look;
}

Grid<std::uint8_t> FlagMemory::Flags() const {
  Grid<std::uint8_t> flags(geometry_.rows, geometry_.cols, kFlagNone);
  for (std::size_t cell = 0; cell < tracks_.cells().size(); ++cell) {
    for (std::size_t k = 0; k < kKinds.size(); ++k) {
      if (InForce(tracks_.cells()[cell], k)) {
        flags.cells()[cell] |= kKinds[k];
      }
    }
  }
  return flags;
}

GridF FlagMemory::ThinTops() const {
  GridF tops;
  for (std::size_t cell = 0; cell < tracks_.cells().size(); ++cell) {
    if (!InForce(tracks_.cells()[cell], kThin)) {
      continue;
    }
    if (tops.empty()) {
      tops = GridF(geometry_.rows, geometry_.cols, std::numeric_limits<float>::quiet_NaN());
    }
    tops.cells()[cell] = tracks_.cells()[cell].thin.top_m;
  }
  return tops;
}

}  // namespace palace
