#include "engine/runtime/redecisions.h"

#include <algorithm>

namespace palace {
namespace {

/// A wider lander, or a hazard that came or went, moves the centre of one place a little.
constexpr double kSamePlace_m = 1.5;

const LandingSite* BestOf(const TerrainDecision& decision) {
  return decision.selection.sites.empty() ? nullptr : &decision.selection.sites.front();
}

}  // namespace

RedecidedSample CompareDecisions(Timestamp time, const TerrainDecision& recorded,
                                 const TerrainDecision& now) {
  const LandingSite* was = BestOf(recorded);
  const LandingSite* is = BestOf(now);
  RedecidedSample sample;
  sample.time = time;
  sample.differs = (was == nullptr) != (is == nullptr);
  if (was != nullptr) {
    sample.recorded = was->letter;
  }
  if (is != nullptr) {
    sample.best_site = is->letter;
    sample.best_safe_distance_m = is->safe_distance_m;
  }
  if (was != nullptr && is != nullptr) {
    sample.differs = (was->p_WS - is->p_WS).head<2>().norm() > kSamePlace_m;
  }
  return sample;
}

void Redecisions::Add(const RedecidedSample& sample, bool from_start) {
  if (from_start) {
    from_start_.insert(sample.time.us);
  } else if (from_start_.count(sample.time.us) != 0) {
    return;
  }
  if (!samples_) {
    samples_ = std::make_shared<std::vector<RedecidedSample>>();
  } else if (samples_.use_count() != 1) {  // a snapshot holds it too
    samples_ = std::make_shared<std::vector<RedecidedSample>>(*samples_);
  }
  const auto at =
      std::lower_bound(samples_->begin(), samples_->end(), sample.time,
                       [](const RedecidedSample& s, Timestamp time) { return s.time < time; });
  if (at != samples_->end() && at->time == sample.time) {
    *at = sample;
  } else {
    samples_->insert(at, sample);
  }
}

}  // namespace palace
