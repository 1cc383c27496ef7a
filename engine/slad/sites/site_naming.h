// SiteNaming: ids and letters of a flight. A letter is never given to another place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/slad/sites/site_place.h"

namespace palace {

/// "A" to "Z" without I and O, then "A2" to "Z2", "A3", ...: of the nth place, from 0.
std::string SiteLetter(std::size_t n);

/// Letters after a Reset: within a flight none is given twice; another flight begins at A. Ids are
/// never used again.
enum class SiteNames { kGoOn, kAnew };

class SiteNaming {
 public:
  /// Gives `fresh`, one of `places`, id and letter: those of the place that moved here, by less
  /// than `moves_m` from where it was named, or new ones. That place is none any more. Places that
  /// are listed stay, and so does `kept`.
  void Name(std::vector<SitePlace>& places, SitePlace& fresh, double moves_m, std::uint64_t kept);
  void Reset(SiteNames names);
  /// A flight goes on in which so many places were named already.
  void GoOnNaming(std::uint64_t named);
  /// Of a recorded flight: that id is in use.
  void Use(std::uint64_t id);
  std::uint64_t named() const { return named_; }

 private:
  std::uint64_t next_id_ = 1;
  std::uint64_t named_ = 0;
};

}  // namespace palace
