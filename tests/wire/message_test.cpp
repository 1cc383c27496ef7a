// Commands, settings, proposals and the station's news survive the wire.
#include <gtest/gtest.h>

#include "engine/wire/channels.h"
#include "engine/wire/convert.h"
#include "engine/wire/output_encoder.h"
#include "tests/wire/wire_samples.h"

namespace palace {
namespace {

const ChannelNames kChannels;

TEST(Command, EveryKindSurvives) {
  const std::vector<CommandAction> actions = {SetSetting{"slad.max_slope_deg", 7.25},
                                              ApplySettings{},
                                              DiscardSettings{},
                                              SelectSite{0xFEDCBA9876543210u},
                                              DisarmSite{},
                                              ApproveSite{5, ~0ull},
                                              LookAtSite{7, 8, 12.5},
                                              TurnApproach{9, kStraightApproach},
                                              RefuseSite{6},
                                              HoldHere{},
                                              WaveOff{},
                                              AcknowledgeAlarm{"gps_error"},
                                              AcknowledgeWaveOff{},
                                              AddBookmark{"Böe"},
                                              AskForCommand{true},
                                              ReleaseCommand{},
                                              CommandLost{"bravo commands"},
                                              FlyTo{{1, -2, -15.25}, 0.5},
                                              SetFlyArea{{{{0, 0}, {20, 0}, {20, 30.5}}, 25}},
                                              ClearFlyArea{}};
  ASSERT_EQ(actions.size(), std::variant_size_v<CommandAction>);
  for (std::size_t i = 0; i < actions.size(); ++i) {
    for (const auto origin : {CommandOrigin::kOperator, CommandOrigin::kScript,
                              CommandOrigin::kReplay, CommandOrigin::kStation}) {
      const WireMessage message = EncodeCommand({origin, actions[i]}, {42}, kChannels);
      const Result<EngineCommand> back = DecodeCommand(message);
      ASSERT_TRUE(back.ok()) << back.error().message;
      EXPECT_EQ(back->origin, origin);
      EXPECT_EQ(back->action.index(), i);
      EXPECT_EQ(EncodeCommand(*back, {42}, kChannels).payload, message.payload);
    }
  }
  const auto back = DecodeCommand(EncodeCommand({CommandOrigin::kOperator, actions[5]}, {1}, {}));
  EXPECT_EQ(std::get<ApproveSite>(back->action).site_id, 5u);
  EXPECT_EQ(std::get<ApproveSite>(back->action).snapshot_sequence, ~0ull);
  const auto to = DecodeCommand(EncodeCommand({CommandOrigin::kOperator, actions[17]}, {1}, {}));
  EXPECT_EQ(std::get<FlyTo>(to->action).p_WB, Eigen::Vector3d(1, -2, -15.25));
  EXPECT_EQ(std::get<FlyTo>(to->action).heading_rad, 0.5);
  const auto area =
      DecodeCommand(EncodeCommand({CommandOrigin::kOperator, actions[18]}, {1}, {}));
  EXPECT_EQ(std::get<SetFlyArea>(area->action).area.corners_W.at(2), Eigen::Vector2d(20, 30.5));
  EXPECT_EQ(std::get<SetFlyArea>(area->action).area.ceiling_m, 25);
  const auto look = DecodeCommand(EncodeCommand({CommandOrigin::kOperator, actions[6]}, {1}, {}));
  EXPECT_EQ(std::get<LookAtSite>(look->action).site_id, 7u);
  EXPECT_EQ(std::get<LookAtSite>(look->action).snapshot_sequence, 8u);
  EXPECT_EQ(std::get<LookAtSite>(look->action).stop_height_m, 12.5);
}

TEST(Command, AnAreaThatIsNoneIsRefusedWithTheReason) {
  const FlyArea crossed{{{0, 0}, {20, 20}, {20, 0}, {0, 20}}, 25};
  const auto back = DecodeCommand(EncodeCommand({CommandOrigin::kOperator, SetFlyArea{crossed}},
                                                {1}, {}));
  ASSERT_FALSE(back.ok());
  EXPECT_NE(back.error().message.find("area: Its edges cross"), std::string::npos)
      << back.error().message;
}

TEST(Command, ASideOfAnApproachIsOneOfTheSectorsOrStraight) {
  for (int side = -3; side <= 9; ++side) {
    const auto back =
        DecodeCommand(EncodeCommand({CommandOrigin::kOperator, TurnApproach{5, side}}, {1}, {}));
    ASSERT_EQ(back.ok(), side >= -1 && side <= 7) << side;
    if (back.ok()) {
      EXPECT_EQ(std::get<TurnApproach>(back->action).site_id, 5u);
      EXPECT_EQ(std::get<TurnApproach>(back->action).side, side);
    } else {
      EXPECT_NE(back.error().message.find("is not one of -1..7"), std::string::npos);
    }
  }
}

TEST(VehicleMessage, ApprovalSurvivesWithEveryBoundField) {
  RandomStream random(31);
  Approval a;
  a.id = random.NextBits();
  a.site_id = random.NextBits();
  a.map_hash = random.NextBits();
  a.settings_hash = random.NextBits();
  a.calibration_hash = random.NextBits();
  a.vehicle_boot_id = random.NextBits();
  a.approved_at = {100};
  a.expires_at = {30'000'100};
  a.provisional = true;
  a.p_WS = RandomVector(random);
  a.approach_heading_rad = 1.25;
  a.glide_slope_rad = 0.75;
  a.descent_rate_mps = 0.6;
  a.clear_radius_m = 2.3;
  a.stop_height_m = 12;
  a.seal = {random.NextBits(), 3, {99}, {1, 2, 3, 255}};
  const auto back = DecodeVehicleMessage(EncodeVehicleMessage(a, {9}, kChannels), kChannels);
  ASSERT_TRUE(back.ok());
  const Approval& b = std::get<Approval>(*back);
  EXPECT_EQ(b.id, a.id);
  EXPECT_EQ(b.seal.session_id, a.seal.session_id);
  EXPECT_EQ(b.seal.counter, a.seal.counter);
  EXPECT_EQ(b.seal.sent_at, a.seal.sent_at);
  EXPECT_EQ(b.site_id, a.site_id);
  EXPECT_EQ(b.stop_height_m, a.stop_height_m);
  EXPECT_EQ(b.map_hash, a.map_hash);
  EXPECT_EQ(b.settings_hash, a.settings_hash);
  EXPECT_EQ(b.calibration_hash, a.calibration_hash);
  EXPECT_EQ(b.vehicle_boot_id, a.vehicle_boot_id);
  EXPECT_EQ(b.approved_at, a.approved_at);
  EXPECT_EQ(b.expires_at, a.expires_at);
  EXPECT_EQ(b.provisional, a.provisional);
  EXPECT_EQ(b.p_WS, a.p_WS);
  EXPECT_EQ(b.approach_heading_rad, a.approach_heading_rad);
  EXPECT_EQ(b.glide_slope_rad, a.glide_slope_rad);
  EXPECT_EQ(b.descent_rate_mps, a.descent_rate_mps);
  EXPECT_EQ(b.clear_radius_m, a.clear_radius_m);
  EXPECT_EQ(b.seal.mac, a.seal.mac);
}

TEST(VehicleMessage, HealthyEstimateMustBeFinite) {
  PositionEstimate e;
  e.source = EstimateSource::kVision;
  e.healthy = true;
  e.p_WB = {1, NAN, 3};
  EXPECT_FALSE(DecodeVehicleMessage(EncodeVehicleMessage(e, {}, kChannels), kChannels).ok());
  e.healthy = false;
  EXPECT_TRUE(DecodeVehicleMessage(EncodeVehicleMessage(e, {}, kChannels), kChannels).ok());
}

TEST(Settings, SurviveWithEveryValueMoved) {
  Settings settings;
  for (const SettingInfo& info : SettingTable()) {
    const double moved = ClampSetting(info, info.default_value + (info.integer ? 1 : 0.0625));
    ASSERT_TRUE(SetSettingValue(settings, info.name, moved).ok()) << info.name;
  }
  const Result<Settings> back = DecodeSettings(EncodeSettings(settings, {5}, kChannels));
  ASSERT_TRUE(back.ok()) << back.error().message;
  EXPECT_EQ(*back, settings);
}

TEST(Settings, BoundsBeyondTheDefaultsOfTheirPartnersSurvive) {
  Settings settings;
  settings.slad.grid.x_max_m = 20;
  settings.slad.grid.x_min_m = 10;
  const Result<Settings> back = DecodeSettings(EncodeSettings(settings, {5}, kChannels));
  ASSERT_TRUE(back.ok()) << back.error().message;
  EXPECT_EQ(*back, settings);
}

TEST(Proposal, SurvivesWithEveryFigure) {
  RandomStream random(32);
  const auto bundle = RandomBundle(random, 1, nullptr);
  const EngineSnapshot snapshot = RandomSnapshot(random, *bundle);
  const WireMessage message = EncodeProposal(*snapshot.terrain->applied, bundle->time, kChannels);
  const Result<SiteProposal> back = DecodeProposal(message);
  ASSERT_TRUE(back.ok());
  EXPECT_EQ(back->map_hash, snapshot.terrain->applied->map_hash);
  ASSERT_EQ(back->selection.sites.size(), 2u);
  TerrainDecision again = *snapshot.terrain->applied;
  again.selection = back->selection;
  EXPECT_EQ(EncodeProposal(again, bundle->time, kChannels).payload, message.payload);
  EXPECT_EQ(back->selection.sites[0].reason, "widest clearance");
  EXPECT_EQ(back->grid.rows, 0) << "no map, no grid";
}

// With it alone row and column of a site are a place.
TEST(Proposal, TellsWhereItsGridLies) {
  TerrainDecision decision;
  auto hazards = std::make_shared<HazardMaps>();
  hazards->geometry = {120, 90, 0.15, -3.25, 17.5};
  decision.hazards = hazards;
  LandingSite site;
  site.cell = {10, 20};
  site.p_WS = {hazards->geometry.NorthOfRow(10), hazards->geometry.EastOfCol(20), 0};
  decision.selection.sites = {site};
  const Result<SiteProposal> back = DecodeProposal(EncodeProposal(decision, {5}, kChannels));
  ASSERT_TRUE(back.ok()) << back.error().message;
  EXPECT_EQ(back->grid, hazards->geometry);
  const LandingSite& told = back->selection.sites[0];
  EXPECT_EQ(back->grid.CellFromPoint(told.p_WS.x(), told.p_WS.y()), told.cell);
}

TEST(StationStatus, SurvivesAsARecordSample) {
  RandomStream random(33);
  const auto bundle = RandomBundle(random, 1, nullptr);
  const EngineSnapshot s = RandomSnapshot(random, *bundle);
  const auto back = DecodeStationStatus(EncodeStationStatus(s, kChannels));
  ASSERT_TRUE(back.ok());
  EXPECT_EQ(back->state, s.flight->mission.state);
  EXPECT_EQ(back->decision_hash, s.decision_hash);
  EXPECT_EQ(back->best_site, "C");
  EXPECT_EQ(back->best_safe_distance_m, s.terrain->applied->selection.sites[0].safe_distance_m);
  EXPECT_EQ(back->height_above_site_m, s.flight->mission.height_above_site_m);
  EXPECT_TRUE(std::isnan(back->distance_to_site_m));
}

TEST(Event, AnAlarmKeepsItsLevelAndOneWithoutHasNone) {
  using Level = std::optional<AlarmLevel>;
  for (const Level level : {Level(), Level(AlarmLevel::kAdvisory), Level(AlarmLevel::kCaution),
                            Level(AlarmLevel::kWarning)}) {
    const Event event{.time = {5}, .kind = EventKind::kAlarm, .text = "GPS lost", .level = level};
    const auto back = DecodeEvent(EncodeEvent(event, kChannels));
    ASSERT_TRUE(back.ok());
    EXPECT_EQ(back->kind, EventKind::kAlarm);
    EXPECT_EQ(back->text, "GPS lost");
    EXPECT_EQ(back->level, level);
  }
  for (const EventKind kind : {EventKind::kState, EventKind::kVehicle, EventKind::kFault}) {
    const auto other = DecodeEvent(EncodeEvent({{5}, kind, "Climbs"}, kChannels));
    EXPECT_EQ(other->kind, kind);
    EXPECT_FALSE(other->level.has_value());
  }
}

TEST(StationStatus, NamesTheBestSiteThatIsNotRefused) {
  RandomStream random(36);
  const auto bundle = RandomBundle(random, 1, nullptr);
  EngineSnapshot s = RandomSnapshot(random, *bundle);
  auto decision = std::make_shared<TerrainDecision>(*s.terrain->applied);
  decision->selection.sites[0].letter = "A";
  decision->selection.sites[0].id = 1;
  decision->selection.sites[1].id = 2;
  s.terrain.Edit().applied = decision;
  s.flight.Edit().mission.refused_sites = {1};
  EXPECT_EQ(DecodeStationStatus(EncodeStationStatus(s, kChannels))->best_site, "C");
}

TEST(OutputEncoder, SendsOnlyNews) {
  RandomStream random(34);
  const auto bundle = RandomBundle(random, 1, nullptr);
  EngineSnapshot s = RandomSnapshot(random, *bundle);
  s.session.Edit().events = std::make_shared<const std::vector<Event>>(
      std::vector<Event>{{s.time, EventKind::kState, "one", 1}});
  OutputEncoder encoder;
  const auto channels = [&] {
    std::vector<std::string> names;
    for (const WireMessage& m : encoder.Encode(s)) {
      names.push_back(m.channel);
    }
    return names;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(channels(), (Names{"SLAD_SETTINGS", "SITE_PROPOSAL", "TRACKER_STATUS", "EVENT",
                               "MISSION", "STATION_STATUS"}));
  EXPECT_EQ(channels(), Names{"STATION_STATUS"});
  s.session.Edit().settings.slad.limits.max_slope_deg = 9;
  s.session.Edit().settings_hash = HashOf(s.session->settings);
  EXPECT_EQ(channels(), (Names{"SLAD_SETTINGS", "STATION_STATUS"}));
  s.session.Edit().events = std::make_shared<const std::vector<Event>>(std::vector<Event>{
      {s.time, EventKind::kState, "one", 1}, {s.time, EventKind::kState, "two", 2}});
  EXPECT_EQ(channels(), (Names{"EVENT", "STATION_STATUS"}));
}

TEST(OutputEncoder, WritesEachEventOnceThoughTheListForgetsAndGoesBack) {
  RandomStream random(35);
  const auto bundle = RandomBundle(random, 1, nullptr);
  EngineSnapshot s = RandomSnapshot(random, *bundle);
  OutputEncoder encoder;
  // The numbers of the list, and what is news of it.
  const auto news = [&](const std::vector<std::uint64_t>& numbers) {
    std::vector<Event> events;
    for (const std::uint64_t number : numbers) {
      events.push_back({s.time, EventKind::kState, std::to_string(number), number});
    }
    s.session.Edit().events = std::make_shared<const std::vector<Event>>(std::move(events));
    std::vector<std::uint64_t> told;
    for (const WireMessage& m : encoder.Encode(s)) {
      if (m.channel == ChannelNames{}.event) {
        told.push_back(std::stoull(DecodeEvent(m)->text));
      }
    }
    return told;
  };
  using Numbers = std::vector<std::uint64_t>;
  EXPECT_EQ(news({1, 2, 3, 4}), (Numbers{1, 2, 3, 4}));
  EXPECT_EQ(news({3, 4, 5}), Numbers{5}) << "the mission forgot the oldest";
  EXPECT_EQ(news({3, 4}), Numbers{}) << "an engine that began anew, from the snapshot before";
  EXPECT_EQ(news({3, 4, 6}), Numbers{6});
}

TEST(Channels, FileIsTheDefaults) {
  const auto names = LoadChannels(std::string(PALACE_SOURCE_DIR) + "/config/channels.toml");
  ASSERT_TRUE(names.ok()) << names.error().message;
  EXPECT_EQ(*names, ChannelNames());
}

TEST(Channels, MistakesNameFileLineAndKey) {
  struct Case {
    const char* text;
    const char* says;
  };
  for (const Case& c :
       {Case{"[channels]\nimu = \"\"", "c.toml:2: channels.imu has 0 bytes"},
        Case{"[channels]\nimuu = \"A\"", "c.toml:2: unknown key 'channels.imuu'"},
        Case{"[channels]\nimu = 3", "c.toml:2: channels.imu must be a text"},
        Case{"[channels]\nimu = \"GPS\"", "'GPS' is used twice"},
        Case{"[channels]\nimu = \"A B\"", "c.toml:2: channels.imu holds a blank"},
        Case{"[channels]\nm\xc3\xa4 = \"A\"", "c.toml:2: a letter outside ASCII"},
        Case{"[channels\n", "c.toml:1"}, Case{"[other]\n", "unknown key 'other'"}}) {
    const auto names = ParseChannels(c.text, "c.toml");
    ASSERT_FALSE(names.ok()) << c.text;
    EXPECT_NE(names.error().message.find(c.says), std::string::npos) << names.error().message;
  }
  EXPECT_EQ(ParseChannels("[channels]\nimu = \"MY_IMU\"", "c.toml")->imu, "MY_IMU");
  EXPECT_EQ(LoadChannels("/nowhere/c.toml").error().code, ErrorCode::kUnavailable);
}

}  // namespace
}  // namespace palace
