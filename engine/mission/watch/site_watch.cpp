#include "engine/mission/watch/site_watch.h"

#include <algorithm>
#include <utility>

namespace palace {

void SiteWatch::Add(SiteFinding finding, Timestamp time) {
  const Finding found = finding.finding;
  if (found >= Finding::kOver && (findings_.empty() || findings_.back() < Finding::kOver)) {
    over_since_ = time;
  }
  findings_.push_back(found);
  if (findings_.size() > kMapsKept) {
    findings_.pop_front();
  }
  good_run_ = found == Finding::kGood ? good_run_ + 1 : 0;
  inside_run_ = found < Finding::kOver ? inside_run_ + 1 : 0;
  const auto maps_from = [&](Finding least) {
    return std::count_if(findings_.begin(), findings_.end(), [&](Finding f) { return f >= least; });
  };
  if (found == Finding::kGross || maps_from(Finding::kOver) >= kLostMaps) {
    verdict_ = SiteVerdict::kLost;
  } else if (verdict_ == SiteVerdict::kLost) {
    verdict_ = inside_run_ < kRecoverMaps ? SiteVerdict::kLost : SiteVerdict::kDegraded;
  } else if (maps_from(Finding::kDoubtful) >= kLostMaps) {
    verdict_ = SiteVerdict::kDegraded;
  }
  if (good_run_ >= kRecoverMaps) {
    verdict_ = SiteVerdict::kHolds;
  }
  if (!finding.reason.empty()) {
    reason_ = finding.reason;
  } else if (verdict_ == SiteVerdict::kHolds) {
    reason_.clear();
  }
  newest_ = std::move(finding);
}

SiteVerdict SiteWatch::VerdictAt(Timestamp now) const {
  const bool over = !findings_.empty() && findings_.back() >= Finding::kOver;
  return over && SecondsBetween(over_since_, now) >= kLostAfter_s ? SiteVerdict::kLost : verdict_;
}

}  // namespace palace
