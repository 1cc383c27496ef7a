// What many maps together say of one place: single maps that differ change nothing, worse counts
// sooner than better.
#pragma once

#include <algorithm>
#include <deque>
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

/// A claim of each map against what stands. It holds once as many maps in a row have made it as
/// stood without it before, two at least and `most` at most: one map alone ends nothing, and what
/// stood long falls slowly.
class LastingClaim {
 public:
  LastingClaim() = default;
  /// What stands stood for so many maps already.
  explicit LastingClaim(int stood) : stood_(stood) {}
  bool Add(bool claim, int most) {
    stood_ += claim ? 0 : run_ + 1;
    run_ = claim ? run_ + 1 : 0;
    return run_ >= std::clamp(stood_, 2, most);
  }

 private:
  int stood_ = 1;
  int run_ = 0;
};

/// One frame's blunder stays in a fused map for the frames_fused (10) maps that remember it: only
/// what outlasts it counts, what is worse sooner than what is better.
inline constexpr int kWorseAfter_maps = 12;
inline constexpr int kBetterAfter_maps = 24;

/// A figure, more is better: what all but 11 of the newest 35 maps reach, so that it falls after
/// kWorseAfter_maps in a row and rises after kBetterAfter_maps; of fewer than 12 maps the best. It
/// stays until that differs by more than the noise. Figures that grow side by side, as what is
/// known of the ground does in a hover, do not pass each other.
class SteadyFigure {
 public:
  void Add(double figure, double noise);
  bool empty() const { return !value_; }
  double value() const { return *value_; }  ///< not of an empty one

 private:
  std::deque<double> newest_;
  std::optional<double> value_;
};

}  // namespace palace
