// Trust from end to end: forged, altered and replayed commands against a vehicle and a station that
// talk over a bus in memory.
#include <algorithm>
#include <functional>

#include <gtest/gtest.h>

#include "engine/runtime/engine.h"
#include "engine/simulation/session.h"
#include "engine/wire/convert.h"
#include "engine/wire/lcm_link.h"
#include "engine/wire/lcm_source.h"
#include "tests/support/expected.h"

namespace palace {
namespace {

const ChannelNames kNames;

/// One station: its source, link and engine, stepped by the test.
struct Station {
  Station(const std::shared_ptr<Bus>& bus, std::string name, std::optional<SecretKey> key) {
    StationTrust trust{.station_id = RandomWord(),
                       .station_name = std::move(name),
                       .key = std::move(key),
                       .no_key_why = "No key for this vehicle"};
    link = std::make_shared<LcmLink>(bus, kNames, std::move(trust));
    LcmSourceOptions live;
    live.heartbeat_s = 0;
    live.overheard = [this](const WireMessage& message) { link->Overhear(message); };
    EngineParts parts;
    parts.source = LcmSource::Create(bus, kNames, std::move(live)).value();
    parts.link = link;
    parts.mission.session_id = RandomWord();
    engine = std::make_unique<Engine>(std::move(parts), /*threaded=*/false);
  }
  const SessionPart& session() const { return *engine->Latest()->session; }
  const MissionStatus& mission() const { return engine->Latest()->flight->mission; }
  bool HasAlarm(AlarmId id) const {
    const auto& alarms = mission().alarms;
    return std::any_of(alarms.begin(), alarms.end(),
                       [&](const Alarm& alarm) { return alarm.kind == id; });
  }
  bool HasEvent(const std::string& begin) const {
    const auto& events = *session().events;
    return std::any_of(events.begin(), events.end(),
                       [&](const Event& event) { return event.text.find(begin) == 0; });
  }
  std::shared_ptr<LcmLink> link;
  std::unique_ptr<Engine> engine;
};

/// A vehicle without pictures on a bus in memory.
class TrustOnTheBus : public testing::Test {
 protected:
  void SetUp() override {
    bus_ = Bus::Open("memq://").value();
    session_.emplace(OpenSimulatedSession(
                         {.scenario = "empty",
                          .seed = 3,
                          .speed = 1,  // stations judge stamps by their own clock
                          .render = false,
                          .other_stations = SessionSpec::OtherStations{{{SecretKey::FromSeed(1),
                                                                         SecretKey::FromSeed(2)}}}},
                         nullptr)
                         .value());
    server_ = VehicleServer::Create(bus_, *session_->simulator, kNames).value();
    const auto keep = [this](WireMessage m) { Keep(std::move(m)); };
    ASSERT_TRUE(bus_->Subscribe(kNames.position_estimate, keep).ok());
    ASSERT_TRUE(bus_->Subscribe(kNames.command, keep).ok());
  }
  void Keep(WireMessage message) { heard_.push_back(std::move(message)); }
  /// A tenth of a second of flight, told to every station; what they send is heard.
  void Step() {
    const auto bundle = session_->simulator->Next({}).value();
    mode_ = bundle->status->mode;
    for (const CommandAck& ack : bundle->acks) {
      acks_.push_back(ack);
    }
    ASSERT_TRUE(server_->Publish(*bundle).ok());
    for (Station* station : stations_) {
      ASSERT_TRUE(station->engine->Step());
    }
    ASSERT_TRUE(server_->Poll(0).ok());
  }
  /// True when it came within `steps`.
  bool Until(const std::function<bool()>& done, int steps = 200) {
    for (int i = 0; i < steps; ++i) {
      Step();
      if (done()) {
        return true;
      }
    }
    return false;
  }
  void Forge(const VehicleMessage& message) {
    ASSERT_TRUE(bus_->Publish(EncodeVehicleMessage(message, {}, kNames)).ok());
    Step();
    Step();
    Step();
  }
  Approval ForgedApproval() const {
    Approval a;
    a.id = 71;
    a.site_id = a.map_hash = a.settings_hash = a.calibration_hash = 1;
    a.vehicle_boot_id = session_->simulator->boot_id();
    a.approved_at = Simulator::kEpoch;
    a.expires_at = AddSeconds(a.approved_at, 110);
    a.p_WS = {15, 0, 0};
    a.glide_slope_rad = 0.8;
    a.descent_rate_mps = 1;
    a.clear_radius_m = 2;
    return a;
  }

  std::shared_ptr<Bus> bus_;
  std::optional<SimulatedSession> session_;
  std::unique_ptr<VehicleServer> server_;
  std::vector<Station*> stations_;
  std::vector<WireMessage> heard_;
  std::vector<CommandAck> acks_;
  VehicleMode mode_ = VehicleMode::kUnknown;
};

TEST_F(TrustOnTheBus, ForgedAndReplayedCommandsAreRefusedShownAndRecorded) {
  Station alpha(bus_, "alpha", SecretKey::FromSeed(1));
  stations_ = {&alpha};
  ASSERT_TRUE(Until([&] { return alpha.session().authority.commands(); }));
  EXPECT_TRUE(alpha.HasEvent("This station commands the vehicle, key "));
  // Estimates of its own come back and are known as such.
  ASSERT_TRUE(Until([&] { return heard_.size() > 20; }));
  EXPECT_EQ(alpha.session().authority.foreign.count, 0u);
  EXPECT_FALSE(alpha.HasAlarm(AlarmId::kForeignCommand));

  struct Row {
    const char* what;
    VehicleMessage message;
    const char* refusal;  ///< null: no answer, as for estimates
  };
  Approval sealed_by_another = ForgedApproval();
  sealed_by_another.seal = {9, 1, {1}, SecretKey::FromSeed(7).Sign(SealedBytes(sealed_by_another))};
  PositionEstimate estimate;
  estimate.source = EstimateSource::kVision;
  estimate.healthy = true;
  const Row rows[] = {
      {"APPROVE on COMMAND", ForgedApproval(), "Not sealed"},
      {"APPROVE on COMMAND", sealed_by_another, "Seal does not match"},
      {"HOLD on COMMAND", HoldRequest{5, "forged", {}}, "Not sealed"},
      {"an estimate on POSITION_ESTIMATE", estimate, nullptr},
  };
  for (const Row& row : rows) {
    SCOPED_TRACE(row.what);
    const std::uint64_t before = alpha.session().authority.foreign.count;
    acks_.clear();
    Forge(row.message);
    EXPECT_EQ(mode_, VehicleMode::kHover);
    EXPECT_EQ(alpha.session().authority.foreign.count, before + 1);
    EXPECT_EQ(alpha.session().authority.foreign.what, row.what);
    EXPECT_TRUE(alpha.HasAlarm(AlarmId::kForeignCommand));
    ASSERT_EQ(acks_.size(), row.refusal != nullptr ? 1u : 0u);
    if (row.refusal != nullptr) {
      EXPECT_EQ(acks_[0].reason, row.refusal);
    }
  }
  EXPECT_TRUE(alpha.HasEvent("Foreign command from "));
  EXPECT_TRUE(alpha.HasEvent("Vehicle refused a command: Not sealed"));
  // A command of its own that somebody else plays again, long after.
  VehicleMessage own = HoldRequest{600, "own", {}};
  alpha.link->Seal(own);
  ASSERT_TRUE(bus_->Publish(EncodeVehicleMessage(own, {}, kNames)).ok());
  ASSERT_TRUE(Until([&] { return mode_ == VehicleMode::kHold; }, 3));
  acks_.clear();
  Forge(own);
  ASSERT_EQ(acks_.size(), 1u);
  EXPECT_EQ(acks_[0].reason, "Counter 1 was already used");
  // What cannot be read is answered too.
  const std::uint64_t before = alpha.session().authority.foreign.count;
  ASSERT_TRUE(bus_->Publish({kNames.command, {}, {1, 2, 3}}).ok());
  Step();
  EXPECT_EQ(server_->refused(), 1u);
  EXPECT_EQ(alpha.session().authority.foreign.count, before + 1);
  Step();
  // Open by design, and told.
  Forge(AbortRequest{7, "anybody"});
  EXPECT_EQ(mode_, VehicleMode::kAbort);
  EXPECT_EQ(alpha.session().authority.foreign.what, "ABORT (open by design) on ABORT");
}

/// Sealed in a session of the same station with a vehicle of that key and start.
Approval SealedFor(Approval approval, const SecretKey& key, std::uint64_t boot_id) {
  VehicleAuthority vehicle({.boot_id = boot_id, .keys = {key}});
  StationSession station({.station_id = 1, .station_name = "alpha", .key = key});
  const Timestamp now{Simulator::kEpoch.us};
  station.Hear(vehicle.Report(now), 0);
  (void)vehicle.Take(*station.Tick(now, 1), now);
  station.Hear(vehicle.Report(AddSeconds(now, 1)), 1);
  VehicleMessage message = approval;
  station.Seal(message, now, 1);
  return std::get<Approval>(message);
}

// I1, I4: approvals that were good once, or elsewhere, played to this vehicle while it hovers.
TEST_F(TrustOnTheBus, ApprovalsOfAnotherTimeStartOrVehicleAreRefusedShownAndRecorded) {
  Station alpha(bus_, "alpha", SecretKey::FromSeed(1));
  stations_ = {&alpha};
  ASSERT_TRUE(Until([&] { return alpha.session().authority.commands(); }));
  const std::uint64_t boot_id = session_->simulator->boot_id();
  const auto of_this_session = [&](Approval approval) {
    VehicleMessage message = approval;
    alpha.link->Seal(message);
    return std::get<Approval>(message);
  };
  Approval expired = ForgedApproval(), other_start = ForgedApproval();
  expired.expires_at = AddSeconds(expired.approved_at, 0.1);
  other_start.vehicle_boot_id = boot_id - 1;
  const struct {
    const char* what;
    Approval approval;
    const char* refusal;
  } rows[] = {
      {"expired", of_this_session(expired), "Expired"},
      {"of another start, sealed now", of_this_session(other_start),
       "Given for another start of this vehicle"},
      {"recorded on an earlier start", SealedFor(other_start, SecretKey::FromSeed(1), boot_id - 1),
       "Seal does not match"},
      {"recorded with another vehicle",
       SealedFor(ForgedApproval(), SecretKey::FromSeed(9), boot_id), "Seal does not match"},
  };
  for (const auto& row : rows) {
    SCOPED_TRACE(row.what);
    EXPECT_FALSE(Until([] { return false; }, 11)) << "refusals are told once a second";
    acks_.clear();
    Forge(row.approval);
    ASSERT_EQ(acks_.size(), 1u);
    EXPECT_EQ(acks_[0].result, AckResult::kRefused);
    EXPECT_EQ(acks_[0].reason, row.refusal);
    EXPECT_EQ(mode_, VehicleMode::kHover);
    // Events are what people see and what is recorded.
    EXPECT_TRUE(alpha.HasEvent(std::string("Vehicle refused a command: ") + row.refusal));
  }
  EXPECT_TRUE(alpha.HasEvent("Foreign command from ")) << "those of no session of this station";
  EXPECT_EQ(alpha.session().authority.foreign.count, 2u);
  // A refused one stays refused, and what is good is obeyed.
  acks_.clear();
  Forge(rows[0].approval);
  EXPECT_EQ(acks_.at(0).result, AckResult::kRefused);
  Forge(of_this_session(ForgedApproval()));
  EXPECT_EQ(mode_, VehicleMode::kAlign);
}

TEST_F(TrustOnTheBus, ASecondStationSeesWhoCommandsAndMayOnlyLook) {
  Station alpha(bus_, "alpha", SecretKey::FromSeed(1));
  stations_ = {&alpha};
  ASSERT_TRUE(Until([&] { return alpha.session().authority.commands(); }));
  Station bravo(bus_, "bravo", SecretKey::FromSeed(2)), keyless(bus_, "charlie", std::nullopt);
  stations_ = {&alpha, &bravo, &keyless};
  ASSERT_TRUE(Until([&] { return bravo.session().authority.holder.find("alpha ") == 0; }));
  EXPECT_EQ(bravo.session().authority.why_not, "Station \"alpha\" commands this vehicle");
  EXPECT_FALSE(bravo.mission().may_select);
  EXPECT_EQ(bravo.mission().cannot_approve_reason, "Station \"alpha\" commands this vehicle");
  EXPECT_TRUE(Until([&] { return bravo.HasAlarm(AlarmId::kViewOnly); }, 10));
  EXPECT_FALSE(bravo.HasAlarm(AlarmId::kForeignCommand)) << "the holder's messages are no attack";
  EXPECT_EQ(keyless.mission().cannot_approve_reason, "No key for this vehicle");
  EXPECT_FALSE(keyless.mission().may_select);
  EXPECT_TRUE(keyless.session().can_transmit) << "wave-off is offered";
  // Only a person takes over, and both are told.
  bravo.engine->Post({CommandOrigin::kOperator, AskForCommand{true}});
  ASSERT_TRUE(Until([&] { return bravo.session().authority.commands(); }));
  // What another's key seals alpha cannot check: its own session stands for 3 s, and meanwhile what
  // bravo sends is a stranger's.
  ASSERT_TRUE(Until([&] { return alpha.HasEvent("Command lost: Station \"bravo\" commands"); }));
  EXPECT_GT(alpha.session().authority.foreign.count, 0u);
  EXPECT_TRUE(bravo.HasEvent("Asked to take command over from alpha"));
  EXPECT_FALSE(alpha.mission().may_select);
  EXPECT_TRUE(Until([&] { return !bravo.session().authority.commands(); }, 1) == false);
  // Given back, and left alone by the one that lost it.
  bravo.engine->Post({CommandOrigin::kOperator, ReleaseCommand{}});
  ASSERT_TRUE(Until([&] { return alpha.session().authority.holder.empty(); }));
  EXPECT_FALSE(Until([&] { return alpha.session().authority.commands(); }, 10));
  alpha.engine->Post({CommandOrigin::kOperator, AskForCommand{}});
  EXPECT_TRUE(Until([&] { return alpha.session().authority.commands(); }));
}

// I17: whoever starts anew is somebody else, and what the one before sealed is of no use.
TEST_F(TrustOnTheBus, ARestartedStationInheritsNothing) {
  VehicleMessage approval = ForgedApproval();
  {
    Station alpha(bus_, "alpha", SecretKey::FromSeed(1));
    stations_ = {&alpha};
    ASSERT_TRUE(Until([&] { return alpha.session().authority.commands(); }));
    alpha.link->Seal(approval);
    ASSERT_TRUE(bus_->Publish(EncodeVehicleMessage(approval, {}, kNames)).ok());
    ASSERT_TRUE(Until([&] { return mode_ == VehicleMode::kAlign; }, 3));
    stations_.clear();
    // It ends in order: command is given back, and what flew by it is over.
  }
  ASSERT_TRUE(server_->Poll(0).ok());
  Step();
  EXPECT_EQ(mode_, VehicleMode::kHold);
}

}  // namespace

}  // namespace palace
