#include "engine/mission/alarms/alarms.h"

namespace palace {
namespace {

/// Who acts beyond it now.
EnforcedBy EnforcerOf(const HoldLimit& hold, const AlarmFacts& f) {
  switch (f.state) {
    case MissionState::kApproved:
      return EnforcedBy::kGuard;  // the approval ends
    case MissionState::kDescending:
      return f.committed && !hold.committed ? EnforcedBy::kNobody : EnforcedBy::kHold;
    default:
      return EnforcedBy::kGuard;  // on hold: no site is proposed again
  }
}

LimitRow RowOf(const HoldLimit& hold, const AlarmFacts& f) {
  const double value = f.*hold.value;
  return Judged({.id = hold.id,
                 .label = hold.label,
                 .value = value,
                 .limit = hold.limit_from != nullptr ? f.*hold.limit_from : hold.limit,
                 .unit = hold.unit,
                 .decimals = hold.decimals,
                 // What is not asked now, or cannot be told without motion, holds nothing.
                 .enforced_by = std::isnan(value) ? EnforcedBy::kNobody : EnforcerOf(hold, f),
                 .lasts = hold.lasts});
}

}  // namespace

std::vector<LimitRow> LimitsOfHolds(const AlarmFacts& f) {
  std::vector<LimitRow> rows;
  if (!IsFlying(f.state) && f.state != MissionState::kHold) {
    return rows;
  }
  for (const AlarmRow& row : AlarmTable()) {
    if (row.hold.label != nullptr) {
      rows.push_back(RowOf(row.hold, f));
    }
  }
  if (std::isfinite(f.unconfirmed_height_m)) {
    rows.push_back(Judged({.id = LimitId::kConfirmHeight,
                           .label = "Height, unconfirmed",
                           .value = f.unconfirmed_height_m,
                           .limit = GuardLimits::confirm_height_m,
                           .is_least = true,
                           .unit = "m",
                           .enforced_by = EnforcedBy::kHold}));
  }
  return rows;
}

}  // namespace palace
