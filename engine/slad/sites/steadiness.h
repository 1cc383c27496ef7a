// What many maps together say of one place: single maps that differ change nothing, worse counts
// sooner than better.
#pragma once

#include <optional>

namespace palace {

/// A yes or no of each map. The first map decides alone; afterwards yes becomes no when 3 of the
/// last 5 maps say so, and no becomes yes after 5 in a row. As SiteWatch judges an approved site.
class SteadyVerdict {
 public:
  void Add(bool good);
  bool good() const { return good_; }

 private:
  static constexpr int kBadMaps = 3;   ///< of the last ...
  static constexpr int kMapsKept = 5;  ///< ... so many; and so many good ones in a row

  int maps_ = 0;
  unsigned bad_ = 0;  ///< bit k: the map k maps ago was bad
  bool good_ = false;
};

/// A claim of each map: it holds once so many maps in a row have made it.
class LastingClaim {
 public:
  bool Add(bool claim, int maps) {
    run_ = claim ? run_ + 1 : 0;
    return run_ >= maps;
  }

 private:
  int run_ = 0;
};

/// One frame's blunder stays in a fused map for the frames_fused (10) maps that remember it: only
/// what outlasts it counts, what is worse sooner than what is better.
inline constexpr int kWorseAfter_maps = 12;
inline constexpr int kBetterAfter_maps = 24;

/// A figure, more is better, that stays until the maps differ from it by more than the noise, all
/// of them to the same side, kWorseAfter_maps or kBetterAfter_maps in a row.
class SteadyFigure {
 public:
  void Add(double figure, double noise);
  double value() const { return *value_; }

 private:
  std::optional<double> value_;
  LastingClaim worse_, better_;
};

}  // namespace palace
