#include "engine/experiments/handover_flight.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "engine/runtime/engine.h"
#include "engine/runtime/scripted_operator.h"
#include "engine/simulation/session.h"

namespace palace {
namespace {

constexpr double kAfter_s = 10;
constexpr double kSameMoment_s = 0.011;  // half a step of control, in which the truth is told

/// The simulator's link, overheard.
class OverheardLink final : public VehicleLink {
 public:
  explicit OverheardLink(std::shared_ptr<Simulator> simulator) : simulator_(std::move(simulator)) {}

  bool Send(const VehicleMessage& message) override {
    if (const auto* estimate = std::get_if<PositionEstimate>(&message)) {
      newest_ = *estimate;
    }
    return simulator_->Send(message);
  }
  void Seal(VehicleMessage& message) override { simulator_->Seal(message); }
  void Hear(const FrameBundle& bundle) override { simulator_->Hear(bundle); }
  AuthorityStatus Authority() const override { return simulator_->Authority(); }
  void Announce(const EngineSnapshot& snapshot) override { simulator_->Announce(snapshot); }

  const std::optional<PositionEstimate>& newest() const { return newest_; }

 private:
  std::shared_ptr<Simulator> simulator_;
  std::optional<PositionEstimate> newest_;
};

struct Errors {
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  int count = 0;

  void Add(const Eigen::Vector3d& error) {
    squares += error.cwiseAbs2();
    ++count;
  }
  Eigen::Vector3d Rms() const {
    return count > 0 ? Eigen::Vector3d((squares / count).cwiseSqrt())
                     : Eigen::Vector3d::Constant(NAN);
  }
};

class Onlooker {
 public:
  void Look(const EngineSnapshot& snapshot, const PositionEstimate& sent) {
    const auto& truth = snapshot.sensors->truth;
    if (!truth || std::abs(SecondsBetween(truth->time, sent.time)) > kSameMoment_s) {
      return;
    }
    const NavigationStatus& navigation = snapshot.flight->navigation;
    const Eigen::Vector3d error = sent.v_WB - truth->v_WB;
    if (sent.source == EstimateSource::kGps) {
      if (on_gps_) {
        usual_.Add(error - *on_gps_);
      }
      on_gps_ = error;
      if (navigation.vision.running) {
        hover_.Add(navigation.vision.estimate.v_WB - truth->v_WB);
      }
      return;
    }
    if (sent.source != EstimateSource::kVision || !on_gps_) {
      return;
    }
    if (!switched_) {
      switched_ = sent.time;
      const Eigen::Vector3d on_gps_now = navigation.gps.estimate.v_WB;
      seen_.step_mps = (sent.v_WB - on_gps_now).norm();
      seen_.gap_mps = (navigation.vision.estimate.v_WB - on_gps_now).norm();
      seen_.message_mps = (error - *on_gps_).norm();
    }
    descent_.Add(error);
  }
  bool IsOver(Timestamp now) const {
    return switched_ && SecondsBetween(*switched_, now) > kAfter_s;
  }
  HandoverFlight Seen() const {
    HandoverFlight seen = seen_;
    seen.usual_mps = usual_.Rms().norm();
    seen.hover_rms_mps = hover_.Rms();
    seen.descent_rms_mps = descent_.Rms();
    return seen;
  }

 private:
  std::optional<Eigen::Vector3d> on_gps_;  ///< error of the newest velocity sent
  std::optional<Timestamp> switched_;
  Errors usual_, hover_, descent_;
  HandoverFlight seen_;
};

}  // namespace

Result<HandoverFlight> FlyHandover(const MissionFlight& flight, const SceneCameraFactory& camera) {
  Result<SimulatedSession> session = OpenSimulatedSession({.scenario = flight.scenario,
                                                           .seed = flight.seed,
                                                           .vehicle = flight.vehicle,
                                                           .wind_mps = flight.wind_mps},
                                                          camera);
  if (!session) {
    return session.error();
  }
  const auto link = std::make_shared<OverheardLink>(session->simulator);
  EngineParts parts;
  parts.settings = flight.settings;
  parts.mission.session_id = session->id;
  parts.source = session->simulator;
  parts.link = link;
  Engine engine(std::move(parts), /*threaded=*/false);
  ScriptedOperator pilot;
  Onlooker onlooker;
  const Timestamp end = AddSeconds(Simulator::kEpoch, flight.limit_s);
  while (engine.Step()) {
    const auto snapshot = engine.Latest();
    if (link->newest() && link->newest()->time == snapshot->time) {
      onlooker.Look(*snapshot, *link->newest());
    }
    for (const EngineCommand& command : pilot.Decide(*snapshot)) {
      engine.Post(command);
    }
    if (snapshot->time > end || onlooker.IsOver(snapshot->time)) {
      break;
    }
  }
  if (!engine.error().empty()) {
    return UnavailableError(engine.error());
  }
  return onlooker.Seen();
}

}  // namespace palace
