// Which picture of the left camera belongs to which of the right one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "engine/core/time.h"
#include "engine/model/frame_bundle.h"

namespace palace {

struct PicturePair {
  TimedPicture left;
  TimedPicture right;
};

/// Pairs two streams of pictures by nearest time.
///
/// Rule, with l and r the oldest waiting pictures of either side: l and r are a pair when
/// |t_l - t_r| <= tolerance and no picture waiting behind the earlier of the two is nearer to the
/// later one. A picture that cannot have a partner any more (its side's next one is nearer, or the
/// other side is already further ahead than the tolerance) is dropped and counted. Pairs come in
/// order of time and no picture is in two of them. Where both cameras' periods exceed twice the
/// tolerance the pairs are exactly those within the tolerance, in whatever order the pictures of
/// the two sides arrive.
///
/// At most `capacity` pictures of a side wait; the oldest is dropped beyond. A picture whose time
/// does not advance is a repetition: dropped. Any one thread.
class FramePairing {
 public:
  enum Side : std::size_t { kLeft = 0, kRight = 1 };

  explicit FramePairing(double tolerance_s, std::size_t capacity = 8);

  /// The pair that the picture completes, if any. One picture completes one pair at most.
  std::optional<PicturePair> Add(Side side, TimedPicture picture);
  /// Forgets the pictures that wait, and the times seen: the streams begin anew. Counts stay.
  void Restart();

  /// Pictures dropped without a partner.
  std::uint64_t unpaired(Side side) const { return unpaired_[side]; }
  std::size_t waiting(Side side) const { return waiting_[side].size(); }
  double tolerance_s() const { return tolerance_s_; }

 private:
  void Drop(Side side);

  const double tolerance_s_;
  const std::size_t capacity_;
  std::array<std::deque<TimedPicture>, 2> waiting_;
  std::array<std::optional<Timestamp>, 2> newest_;
  std::array<std::uint64_t, 2> unpaired_{};
};

}  // namespace palace
