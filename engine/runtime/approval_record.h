// ApprovalRecord: one approval as it was given, with the evidence that was on the screen then and
// what became of it. For the report of the flight.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/model/snapshot.h"

namespace palace {

struct ApprovalRecord {
  Timestamp given;  ///< vehicle time
  Approval approval;
  LandingSite site;  ///< frozen when it was armed
  /// Of the site, under the limits it was armed under, and the wind when it was approved.
  std::vector<LimitRow> limits;
  double wind_mps = NAN, wind_from_rad = NAN;  ///< when it was approved; NaN: the vehicle told none
  std::string by;                              ///< "the operator" or "a script"
  std::string answer = "none";                 ///< of the vehicle, with the seconds it took
  MissionState last_state = MissionState::kApproved;  ///< reached under it
  std::string why;                                    ///< that state was entered
  // What was seen at that moment; null where there was none.
  std::shared_ptr<const ImageU8> left;
  std::shared_ptr<const RangeMap> range;
  std::shared_ptr<const TerrainDecision> map;
};

/// Follows a flight snapshot by snapshot: one record an approval. Of more than 20 the oldest lose
/// their pictures.
class ApprovalRecords {
 public:
  void Add(const EngineSnapshot& snapshot);
  const std::vector<ApprovalRecord>& all() const { return records_; }

 private:
  std::vector<ApprovalRecord> records_;
  bool open_ = false;  ///< the last one's mission is not over
};

}  // namespace palace
