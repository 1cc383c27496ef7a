// SiteWatch: what the maps of a descent together say of the approved site.
//
//   lost       over a limit on 3 of the last 5 maps; or over, and for 0.4 s no map said otherwise
//              (I20: hold within 0.5 s, however slow the maps); or once a gross hazard
//   degraded   doubtful or over on 3 of the last 5 maps
//   holds      otherwise; back only after 5 maps in a row without the cause
//
// One noisy map changes nothing. Limits and findings: site_finding.h.
// Source: thesis chapter 6 asks for re-verification; reference/reliability.md I20.
#pragma once

#include <cstddef>
#include <deque>
#include <string>

#include "engine/core/time.h"
#include "engine/mission/site_finding.h"
#include "engine/model/mission/mission_status.h"

namespace palace {

class SiteWatch {
 public:
  static constexpr int kLostMaps = 3;          ///< of the last ...
  static constexpr std::size_t kMapsKept = 5;  ///< ... so many
  static constexpr int kRecoverMaps = 5;       ///< in a row
  static constexpr double kLostAfter_s = 0.4;

  /// Once a map, in order of time.
  void Add(SiteFinding finding, Timestamp time);

  bool evaluated() const { return !findings_.empty(); }
  /// On the newest map alone.
  const SiteFinding& newest() const { return newest_; }
  SiteVerdict VerdictAt(Timestamp now) const;
  /// Of the newest map that was not good; empty while the site holds.
  const std::string& reason() const { return reason_; }

 private:
  std::deque<Finding> findings_;
  SiteFinding newest_;
  SiteVerdict verdict_ = SiteVerdict::kHolds;  // without the rule of time
  std::string reason_;
  int good_run_ = 0;    // maps in a row that are good
  int inside_run_ = 0;  // ... that are inside every limit
  Timestamp over_since_;
};

}  // namespace palace
