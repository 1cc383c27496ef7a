// What the report keeps of an approval: the evidence as it was armed, the wind as it was approved,
// and what became of it.
#include "engine/runtime/approval_record.h"

#include <gtest/gtest.h>

namespace palace {
namespace {

EngineSnapshot Approved(std::uint64_t id, double wind_mps) {
  EngineSnapshot snap;
  MissionStatus& mission = snap.flight.Edit().mission;
  mission.state = MissionState::kApproved;
  mission.why = "Approved";
  mission.armed = LandingSite{};
  mission.armed->letter = "B";
  Approval approval;
  approval.id = id;
  mission.approval = approval;
  mission.armed_limits = {{.id = LimitId::kSlope, .label = "Slope", .value = 3, .limit = 10}};
  mission.limits = {{.id = LimitId::kOffPath, .label = "Off the path", .value = 0.1, .limit = 1.2},
                    {.id = LimitId::kWind, .label = "Wind", .value = wind_mps, .limit = 8}};
  mission.limits[1].enforced_by = EnforcedBy::kAlarm;
  return snap;
}

TEST(ApprovalRecords, KeepTheWindThatItWasApprovedIn) {
  ApprovalRecords records;
  records.Add(Approved(7, 3));
  records.Add(Approved(7, 6));  // it blows harder later
  ASSERT_EQ(records.all().size(), 1u);
  const ApprovalRecord& record = records.all().front();
  ASSERT_EQ(record.limits.size(), 2u) << "the site's, then the wind";
  EXPECT_EQ(record.limits[0].id, LimitId::kSlope);
  EXPECT_EQ(record.limits[1].id, LimitId::kWind);
  EXPECT_EQ(record.limits[1].value, 3);
  EXPECT_EQ(record.limits[1].enforced_by, EnforcedBy::kGuard) << "as it was asked";
}

TEST(ApprovalRecords, EndWithTheStateThatEndedThem) {
  ApprovalRecords records;
  records.Add(Approved(7, 3));
  EngineSnapshot held = Approved(7, 3);
  held.flight.Edit().mission.state = MissionState::kHold;
  held.flight.Edit().mission.why = "Held by the operator";
  held.flight.Edit().mission.approval.reset();
  records.Add(held);
  held.flight.Edit().mission.state = MissionState::kSearch;
  held.flight.Edit().mission.why = "Vehicle hovers, sites re-evaluated";
  records.Add(held);
  records.Add(Approved(8, 2));
  ASSERT_EQ(records.all().size(), 2u);
  EXPECT_EQ(records.all()[0].last_state, MissionState::kHold);
  EXPECT_EQ(records.all()[0].why, "Held by the operator");
  EXPECT_EQ(records.all()[1].approval.id, 8u);
}

// A wave-off pressed long after a touchdown is none of that approval.
TEST(ApprovalRecords, EndWithTheTouchdown) {
  ApprovalRecords records;
  EngineSnapshot flight = Approved(7, 3);
  records.Add(flight);
  MissionStatus& m = flight.flight.Edit().mission;
  m.state = MissionState::kLanded;
  m.why = "Vehicle says it is on the ground";
  records.Add(flight);
  m.state = MissionState::kAborting;
  m.why = "Waved off by the operator";
  records.Add(flight);
  EXPECT_EQ(records.all()[0].last_state, MissionState::kLanded);
  EXPECT_EQ(records.all()[0].why, "Vehicle says it is on the ground");
}

}  // namespace
}  // namespace palace
