// Redecisions: what the reviewer's limits decided of a replayed flight, over all of it that was
// played since a limit was moved last.
#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <vector>

#include "engine/model/snapshot.h"

namespace palace {

/// The sample of one map: `recorded` and `now` judge the very same map under two sets of limits.
/// Sites are compared by place, because a re-decision may hand out letters in another order.
RedecidedSample CompareDecisions(Timestamp time, const TerrainDecision& recorded,
                                 const TerrainDecision& now);

/// In order of time, one sample a time, whichever way the log was played. Publishing shares; a
/// published vector never changes.
class Redecisions {
 public:
  /// `from_start`: played from the start of the flight without a jump, with all that its maps
  /// remembered then. What was decided so is not replaced by what was decided after a jump.
  void Add(const RedecidedSample& sample, bool from_start);
  /// A limit moved: what was decided under the old one says nothing of the new.
  void Forget() {
    samples_.reset();
    from_start_.clear();
  }
  /// Null while nothing was decided again.
  std::shared_ptr<const std::vector<RedecidedSample>> Publish() const { return samples_; }

 private:
  std::shared_ptr<std::vector<RedecidedSample>> samples_;
  std::set<std::int64_t> from_start_;  ///< times, microseconds
};

}  // namespace palace
