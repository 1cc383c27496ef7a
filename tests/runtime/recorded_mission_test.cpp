#include "engine/runtime/recorded_mission.h"

#include <gtest/gtest.h>

#include "engine/core/units.h"

namespace palace {
namespace {

TEST(RecordedMission, TellsTheLimitsInForceAtATime) {
  auto record = std::make_shared<FlightRecord>();
  RecordedMission flight;
  EXPECT_EQ(flight.SettingsAt({5}), nullptr);
  flight.Follow(record);
  EXPECT_EQ(flight.SettingsAt({5}), nullptr);
  for (const int degrees : {10, 6, 8}) {
    SettingsInForce entry{{static_cast<std::int64_t>(record->settings.size()) * 100 + 100}, {}};
    entry.settings.slad.limits.max_slope_deg = degrees;
    record->settings.push_back(entry);
  }
  struct Case {
    std::int64_t at_us;
    double slope_deg;
  };
  for (const Case& c :
       {Case{0, 10}, {100, 10}, {199, 10}, {200, 6}, {299, 6}, {300, 8}, {9999, 8}}) {
    const Settings* settings = flight.SettingsAt({c.at_us});
    ASSERT_NE(settings, nullptr);
    EXPECT_EQ(settings->slad.limits.max_slope_deg, c.slope_deg) << c.at_us;
  }
}

TEST(RecordedMission, TellsTheEventsOfTheFlightUntilATimeWhicheverWayItIsReached) {
  auto record = std::make_shared<FlightRecord>();
  RecordedMission flight;
  EXPECT_EQ(flight.EventsUntil({5}), nullptr);
  for (const int us : {10, 20, 20, 30}) {
    record->events.push_back({{us}, EventKind::kState, std::to_string(us)});
  }
  flight.Follow(record);
  const struct {
    std::int64_t at_us;
    std::size_t count;
  } table[] = {{5, 0}, {30, 4}, {20, 3}, {10, 1}, {99, 4}};
  for (const auto& row : table) {
    ASSERT_NE(flight.EventsUntil({row.at_us}), nullptr);
    EXPECT_EQ(flight.EventsUntil({row.at_us})->size(), row.count) << row.at_us;
  }
}

TEST(RecordedMission, TellsWhatTheNewestMapProposedThatIsNotNewer) {
  auto record = std::make_shared<FlightRecord>();
  RecordedMission flight;
  EXPECT_EQ(flight.ProposalAt({500}), nullptr);
  record->proposals = {{{500}, {{7, "K", {0.2, 0}}}}, {{2000}, {{9, "Z", {0, 0}}}}};
  flight.Follow(record);
  EXPECT_EQ(flight.ProposalAt({499}), nullptr);
  for (const std::int64_t us : {500, 1999, 2000, 9000}) {
    ASSERT_NE(flight.ProposalAt({us}), nullptr);
    EXPECT_EQ(flight.ProposalAt({us})->places[0].letter, us < 2000 ? "K" : "Z") << us;
  }
}

FlightRecordSample At(std::int64_t us, MissionState state, int armed) {
  FlightRecordSample sample;
  sample.time = {us};
  sample.state = state;
  sample.height_above_site_m = 1e-6 * static_cast<double>(us);
  sample.distance_to_site_m = 2;
  sample.armed = armed;
  return sample;
}

TEST(RecordedMission, KnowsALogThatWasCutOutOfAFlight) {
  const struct {
    MissionState first;
    bool cut;
  } table[] = {{MissionState::kNoLive, false},
               {MissionState::kSearch, false},
               {MissionState::kProposed, true},
               {MissionState::kDescending, true}};
  for (const auto& row : table) {
    auto record = std::make_shared<FlightRecord>();
    RecordedMission flight;
    EXPECT_FALSE(flight.BeginsMidFlight());
    flight.Follow(record);
    EXPECT_FALSE(flight.BeginsMidFlight());
    record->samples = {At(1, row.first, -1)};
    EXPECT_EQ(flight.BeginsMidFlight(), row.cut) << MissionStateName(row.first);
  }
}

// After a jump the status is the record's; of what this session's mission says, only what needs no
// past is taken.
TEST(RecordedMission, TellsTheRecordAndNothingOfAMissionThatWasNotSeen) {
  auto record = std::make_shared<FlightRecord>();
  LandingSite site;
  site.id = 7;
  site.letter = 'C';
  record->armed_sites = {site};
  record->samples = {
      At(1'000'000, MissionState::kProposed, -1), At(2'000'000, MissionState::kDescending, 0),
      At(3'000'000, MissionState::kDescending, 0), At(4'000'000, MissionState::kLanded, 0)};
  record->samples[2].alarms = 2;
  record->samples[1].stop_height_m = 12;
  RecordedMission mission;
  MissionStatus watched;
  watched.state = MissionState::kProposed;
  watched.approval.emplace();
  watched.rechecks.emplace_back();
  watched.can_approve = watched.may_select = true;
  record->settings.push_back({{2'500'000}, {}});
  record->settings.back().settings.slad.limits.max_slope_deg = 6;
  watched.guards.emplace_back();
  watched.alarms = {Alarm{AlarmId::kNoSite}, Alarm{AlarmId::kRowError}, Alarm{AlarmId::kHold}};
  watched.limits = {{.id = LimitId::kWind}, {.id = LimitId::kRowError, .value = 0.25}};

  EXPECT_EQ(mission.StatusAt({3'500'000}, watched).state, MissionState::kProposed);  // no record
  EXPECT_FALSE(mission.TrackedSite({3'500'000}).has_value());
  mission.Follow(record);

  EXPECT_TRUE(mission.StatusAt({2'500'000}, watched).IsLook());
  const MissionStatus status = mission.StatusAt({3'500'000}, watched);
  EXPECT_EQ(status.state, MissionState::kDescending);
  EXPECT_EQ(status.since.us, 2'000'000);
  EXPECT_EQ(status.armed->letter, "C");
  EXPECT_FALSE(status.IsLook());
  EXPECT_EQ(status.height_above_site_m, 3);
  ASSERT_NE(FindLimit(status.armed_limits, LimitId::kSlope), nullptr);
  EXPECT_NEAR(FindLimit(status.armed_limits, LimitId::kSlope)->limit, Rad(6), 1e-12);
  EXPECT_FALSE(status.can_approve);
  EXPECT_FALSE(status.may_select);
  EXPECT_EQ(status.cannot_approve_reason, WhyNoVehicle(SourceKind::kReplay));
  EXPECT_FALSE(status.approval.has_value());
  EXPECT_TRUE(status.rechecks.empty() && status.guards.empty());
  EXPECT_EQ(status.alarms_in_record, 2);
  ASSERT_EQ(status.alarms.size(), 1U);
  EXPECT_EQ(status.alarms[0].kind, AlarmId::kRowError);
  ASSERT_EQ(status.limits.size(), 1U);
  EXPECT_EQ(status.limits[0].value, 0.25);

  EXPECT_EQ(mission.StatusAt({500'000}, watched).since.us, 1'000'000);  // before it: its first
  EXPECT_EQ(mission.TrackedSite({2'000'000})->id, 7U);
  EXPECT_FALSE(mission.TrackedSite({1'500'000}).has_value());
  EXPECT_FALSE(mission.TrackedSite({4'000'000}).has_value());
}

TEST(RecordedMission, TellsTouchdownAndRefusedPlacesWhereverOneJumps) {
  auto record = std::make_shared<FlightRecord>();
  LandingSite site;
  site.id = 7;
  record->armed_sites = {site};
  record->samples = {
      At(1'000'000, MissionState::kProposed, -1), At(2'000'000, MissionState::kDescending, 0),
      At(3'000'000, MissionState::kLanded, 0), At(9'000'000, MissionState::kLanded, 0)};
  record->refusals = {{{1'500'000}, {4}}, {{2'500'000}, {}}};
  record->touchdowns = {{{3'000'000}, site.p_WS, 0.46, NAN}};
  RecordedMission mission;
  mission.Follow(record);
  const auto at = [&](std::int64_t us) { return mission.StatusAt({us}, {}); };
  EXPECT_TRUE(at(1'000'000).refused_sites.empty());
  EXPECT_EQ(at(2'000'000).refused_sites, std::vector<std::uint64_t>{4});
  EXPECT_TRUE(at(3'000'000).refused_sites.empty());
  EXPECT_FALSE(at(2'900'000).touchdown_miss_m.has_value());
  for (const std::int64_t us : {3'000'000, 9'500'000}) {
    EXPECT_EQ(at(us).touchdown_miss_m, 0.46) << us;
    EXPECT_FALSE(at(us).touchdown_miss_true_m.has_value()) << us;
  }
}

TEST(RecordedMission, TellsWhenEachChannelWasHeardLast) {
  auto record = std::make_shared<FlightRecord>();
  RecordedMission mission;
  const auto left_before = [&](std::int64_t us) {
    return mission.HeardBefore({us})[static_cast<std::size_t>(ChannelId::kCameraLeft)];
  };
  EXPECT_FALSE(left_before(5).has_value());
  mission.Follow(record);
  EXPECT_FALSE(left_before(5).has_value());
  record->heard[static_cast<std::size_t>(ChannelId::kCameraLeft)] = {{10}, {20}, {30}};
  EXPECT_FALSE(left_before(10).has_value());
  EXPECT_EQ(left_before(20)->us, 10);
  EXPECT_EQ(left_before(99)->us, 30);
  EXPECT_FALSE(mission.HeardBefore({99})[1].has_value());
}

}  // namespace
}  // namespace palace
