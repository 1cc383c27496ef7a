// One way to assemble a simulated session: what the seed fixes, and whom the vehicle obeys.
#include "engine/simulation/session.h"

#include <gtest/gtest.h>

#include "tests/simulation/simulated_station.h"

namespace palace {
namespace {

/// Steps once and asks the vehicle to land ahead of it; its answer.
CommandAck AnswerTo(Simulator& simulator, const ApprovalSigner* signer) {
  const Bundle first = simulator.Next({}).value();
  Approval approval;
  approval.id = 71;
  approval.session_id = 5;
  approval.counter = 1;
  approval.vehicle_boot_id = first->status->boot_id;
  approval.approved_at = first->time;
  approval.expires_at = AddSeconds(first->time, 30);
  approval.p_WS = {15.7, 0, 0};
  approval.glide_slope_rad = Rad(45);
  approval.descent_rate_mps = 1;
  approval.clear_radius_m = 2.3;
  if (signer != nullptr) {
    signer->Sign(approval);
  }
  simulator.Send(approval);
  return simulator.Next({}).value()->acks.at(0);
}

TEST(SimulatedSession, ObeysItsOwnSignerUnlessAnotherStationIsNamed) {
  const ApprovalSigner other = ApprovalSigner::FromSeed(99);
  struct Row {
    const char* name;
    std::optional<SessionSpec::OtherStation> station;
    bool takes_own, takes_other, takes_unsigned;
  };
  const Row rows[] = {
      {"own", {}, true, false, false},
      {"another's key", SessionSpec::OtherStation{other.public_key()}, false, true, false},
      {"no key", SessionSpec::OtherStation{}, true, true, true}};
  for (const Row& row : rows) {
    const auto answer = [&](const ApprovalSigner* signer) {
      const auto session = OpenSimulatedSession(
          {.scenario = "empty", .seed = 3, .render = false, .other_station = row.station}, nullptr);
      return AnswerTo(*session->simulator, signer).result == AckResult::kAccepted;
    };
    const ApprovalSigner own =
        OpenSimulatedSession({.scenario = "empty", .seed = 3, .render = false}, nullptr)->signer;
    EXPECT_EQ(answer(&own), row.takes_own) << row.name;
    EXPECT_EQ(answer(&other), row.takes_other) << row.name;
    EXPECT_EQ(answer(nullptr), row.takes_unsigned) << row.name;
  }
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
