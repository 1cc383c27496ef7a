// GroundClass: what a cell of the maps is to a lander. The one meaning of "safe": pictures, maps,
// counts, cards and files take it from HazardMaps::ground, nobody works it out again.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace palace {

enum class GroundClass : std::uint8_t {
  kUnknown,    ///< not measured
  kLandable,   ///< a lander may be sent here: nothing within its clear radius, every limit kept
  kHazard,     ///< breaks a limit itself, or is flagged
  kTooNear,    ///< no hazard itself, but one (or unknown ground) lies within the clear radius
  kFootprint,  ///< has that room, but a touchdown within nav_error_m breaks a limit under the lander
};
inline constexpr std::size_t kGroundClasses = 5;

/// "Safe to land on", "Too near a hazard"; for people.
constexpr const char* GroundClassWord(GroundClass ground) {
  switch (ground) {
    case GroundClass::kUnknown:
      break;
    case GroundClass::kLandable:
      return "Safe to land on";
    case GroundClass::kHazard:
      return "Hazard";
    case GroundClass::kTooNear:
      return "Too near a hazard";
    case GroundClass::kFootprint:
      return "Over a limit under the lander";
  }
  return "Unknown";
}

/// Cells of each class; together all cells of the map.
class GroundCounts {
 public:
  int& operator[](GroundClass ground) { return cells_[static_cast<std::size_t>(ground)]; }
  int operator[](GroundClass ground) const { return cells_[static_cast<std::size_t>(ground)]; }
  friend bool operator==(const GroundCounts&, const GroundCounts&) = default;

 private:
  std::array<int, kGroundClasses> cells_{};
};

}  // namespace palace
