// One way to assemble a simulated session: what the seed fixes, and whom the vehicle obeys.
#include "engine/simulation/session.h"

#include <gtest/gtest.h>

#include "tests/simulation/simulated_station.h"

namespace palace {
namespace {

/// Steps once and asks the vehicle to land ahead of it; its answer.
CommandAck AnswerTo(Simulator& simulator, bool sealed) {
  const Bundle first = simulator.Next({}).value();
  Approval approval;
  approval.id = 71;
  approval.site_id = approval.map_hash = approval.settings_hash = approval.calibration_hash = 1;
  approval.vehicle_boot_id = first->status->boot_id;
  approval.approved_at = first->time;
  approval.expires_at = AddSeconds(first->time, 30);
  approval.p_WS = {15.7, 0, 0};
  approval.glide_slope_rad = Rad(45);
  approval.descent_rate_mps = 1;
  approval.clear_radius_m = 2.3;
  VehicleMessage message = approval;
  if (sealed) {
    simulator.Seal(message);
  }
  simulator.Send(message);
  return simulator.Next({}).value()->acks.at(0);
}

// The station in this program commands from the first frame on, by the same exchange of messages;
// with other stations nobody does until one asks.
TEST(SimulatedSession, ObeysTheStationInThisProgramUnlessOthersAreNamed) {
  using Others = SessionSpec::OtherStations;
  struct Row {
    const char* name;
    std::optional<Others> stations;
    bool takes_own, takes_unsealed;
  };
  const Row rows[] = {{"this program", {}, true, false},
                      {"another's key", Others{{{SecretKey::FromSeed(99)}}}, false, false},
                      {"no key", Others{std::vector<SecretKey>()}, false, false},
                      {"a bench", Others{}, true, true}};
  for (const Row& row : rows) {
    const auto taken = [&](bool sealed) {
      const auto session = OpenSimulatedSession(
          {.scenario = "empty", .seed = 3, .render = false, .other_stations = row.stations},
          nullptr);
      EXPECT_EQ(session->simulator->Authority().commands(), !row.stations) << row.name;
      return AnswerTo(*session->simulator, sealed).result == AckResult::kAccepted;
    };
    EXPECT_EQ(taken(true), row.takes_own) << row.name;
    EXPECT_EQ(taken(false), row.takes_unsealed) << row.name;
  }
}

// I7: what was recorded on one start is of no use on another.
TEST(SimulatedSession, OnABusEveryStartHasItsOwnBootId) {
  const auto boot = [](bool others) {
    SessionSpec spec{.scenario = "empty", .seed = 3, .render = false};
    if (others) {
      spec.other_stations.emplace();
    }
    return OpenSimulatedSession(spec, nullptr)->simulator->boot_id();
  };
  EXPECT_NE(boot(true), boot(true));
  EXPECT_EQ(boot(false), boot(false));
}

TEST(SimulatedSession, WindBringsGusts) {
  const auto speeds = [](double wind_mps) {
    const auto session = OpenSimulatedSession(
        {.scenario = "empty", .seed = 4, .wind_mps = wind_mps, .render = false}, nullptr);
    double least = 1e9, most = 0;
    for (int i = 0; i < 50; ++i) {
      const double v_mps = session->simulator->Next({}).value()->truth.back().v_WB.norm();
      least = std::min(least, v_mps);
      most = std::max(most, v_mps);
    }
    return most - least;
  };
  EXPECT_GT(speeds(6), speeds(0) + 0.05);
}

TEST(SimulatedSession, UnknownScenarioListsTheNames) {
  const auto session = OpenSimulatedSession({.scenario = "moon"}, nullptr);
  ASSERT_FALSE(session.ok());
  EXPECT_EQ(session.error().code, ErrorCode::kUsage);
  EXPECT_NE(session.error().message.find("runway"), std::string::npos);
}

}  // namespace
}  // namespace palace
