#include "engine/runtime/approval_record.h"

#include "engine/core/text.h"
#include "engine/model/find_site.h"

namespace palace {
namespace {

constexpr std::size_t kWithPictures = 20;

ApprovalRecord Begin(const EngineSnapshot& snapshot) {
  const MissionStatus& mission = snapshot.flight->mission;
  ApprovalRecord record;
  record.given = mission.approval->approved_at;
  record.approval = *mission.approval;
  record.site = *mission.armed;
  record.limits = mission.armed_limits;
  for (const LimitId id : {LimitId::kWind, LimitId::kOffWind}) {
    if (const LimitRow* row = FindLimit(mission.limits, id)) {
      record.limits.push_back(*row);
      if (row->enforced_by == EnforcedBy::kAlarm) {
        record.limits.back().enforced_by = EnforcedBy::kGuard;  // of the approval; now it flies
      }
    }
  }
  if (const auto& vehicle = snapshot.sensors->vehicle) {
    record.wind_mps = vehicle->wind_speed_mps;
    record.wind_from_rad = vehicle->wind_from_rad;
  }
  if (const LandingSite* now = FindSite(snapshot.terrain->OfRecord().get(), record.site.id)) {
    record.site.called_unsafe_s = now->called_unsafe_s;
  }
  record.by = mission.approved_by;
  record.left = snapshot.sensors->left_rectified;
  record.range = snapshot.terrain->range;
  record.map = snapshot.terrain->OfRecord();
  return record;
}

std::string AnswerOf(const MissionStatus& mission) {
  using Phase = MissionStatus::ApprovalPhase;
  const std::string after = WithNumbers(" after %.1f s", mission.approval_answer_s);
  return mission.approval_phase == Phase::kAccepted ? "accepted" + after
         : mission.approval_phase == Phase::kRefused
             ? "refused" + after + ": " + mission.approval_answer
             : "none";
}

}  // namespace

void ApprovalRecords::Add(const EngineSnapshot& snapshot) {
  const MissionStatus& mission = snapshot.flight->mission;
  const bool ours = mission.approval && mission.armed;
  if (ours && (records_.empty() || records_.back().approval.id != mission.approval->id)) {
    records_.push_back(Begin(snapshot));
    open_ = true;
    if (records_.size() > kWithPictures) {
      ApprovalRecord& old = records_[records_.size() - 1 - kWithPictures];
      old.left = nullptr;
      old.range = nullptr;
      old.map = nullptr;
    }
  }
  if (!open_) {
    return;
  }
  ApprovalRecord& record = records_.back();
  if (ours) {
    record.answer = AnswerOf(mission);
  }
  if (ours || mission.state != record.last_state) {
    record.last_state = mission.state;
    record.why = mission.why;
  }
  // The state that ended it is the last that counts; landed, it is over, though it still stands.
  open_ = ours && mission.state != MissionState::kLanded;
}

}  // namespace palace
