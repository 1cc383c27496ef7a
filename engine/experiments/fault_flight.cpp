#include "engine/experiments/fault_flight.h"

#include <algorithm>
#include <memory>
#include <set>
#include <utility>

#include "engine/camera/pinhole.h"
#include "engine/faults/faulted_source.h"
#include "engine/runtime/engine.h"
#include "engine/runtime/flight_summary.h"
#include "engine/runtime/scripted_operator.h"
#include "engine/simulation/session.h"
#include "engine/wire/convert.h"
#include "engine/wire/output_encoder.h"

namespace palace {
namespace {

constexpr double kTries_s = 4;  // the operator's, after the fault
constexpr double kTriesUntil_s = 8;
constexpr double kIntoDescent_s = 4;
constexpr double kWatchAfterEnd_s = 3;
constexpr double kLongest_s = 70;  // of a descent under a fault
constexpr double kReachIt_s = 90;  // the moment of the fault, from the start
constexpr double kCommit_m = 3, kUnseen_m = 2.5;
constexpr double kDepthError_m = 0.3, kDepthError = 0.05;
constexpr int kGridCols = 12, kGridRows = 9;

/// What a log would hold of events: those of the messages that are written.
class EventRecord final : public RecordSink {
 public:
  explicit EventRecord(std::shared_ptr<std::set<std::string>> texts) : texts_(std::move(texts)) {}
  Status Record(const RecordItem& item) override {
    if (!item.snapshot) {
      return Ok();
    }
    for (const WireMessage& message : encoder_.Encode(*item.snapshot)) {
      if (message.channel == ChannelNames{}.event) {
        if (const Result<Event> event = DecodeEvent(message)) {
          texts_->insert(event->text);
        }
      }
    }
    return Ok();
  }
  Status Close() override { return Ok(); }
  std::string Path() const override { return "memory"; }

 private:
  OutputEncoder encoder_;
  std::shared_ptr<std::set<std::string>> texts_;
};

/// A third of the grid knows its depth, and rightly.
bool MeasuresGround(const RangeMap& range, const World& world, const RigidTransform& X_WC) {
  int known = 0;
  for (int i = 0; i < kGridCols * kGridRows; ++i) {
    const int x = (2 * (i % kGridCols) + 1) * range.camera.width / (2 * kGridCols);
    const int y = (2 * (i / kGridCols) + 1) * range.camera.height / (2 * kGridRows);
    const auto depth_m = static_cast<double>(range.depth_m.at(x, y));
    const double true_m = CastRay(world, X_WC.p, X_WC.R * RayFromPixel(range.camera, {x, y})).s;
    known += std::abs(depth_m - true_m) <= std::max(kDepthError_m, kDepthError * true_m) ? 1 : 0;
  }
  return 3 * known >= kGridCols * kGridRows;
}

/// Follows the snapshots of a flight from the fault on.
class Witness {
 public:
  Witness(const World& world, const StereoRig& rig) : world_(world), X_BC_(rig.X_BC()) {}

  void Begin(const EngineSnapshot& snapshot) {
    outcome_.struck = true;
    for (const Alarm& alarm : snapshot.flight->mission.alarms) {
      if (alarm.active) {
        stood_.insert(alarm.kind);
      }
    }
    last_range_ = snapshot.terrain->range.get();
  }

  void See(const EngineSnapshot& snapshot, double after_s) {
    for (const Alarm& alarm : snapshot.flight->mission.alarms) {
      if (alarm.active && stood_.insert(alarm.kind).second) {
        outcome_.raised.push_back({alarm.kind, after_s, alarm.text});
      }
    }
    const RangeMap* range = snapshot.terrain->range.get();
    if (range == nullptr || range == last_range_ || !snapshot.sensors->truth) {
      return;
    }
    last_range_ = range;
    const RigidTransform& X_WB = snapshot.sensors->truth->X_WB;
    if (MeasuresGround(*range, world_, X_WB * X_BC_)) {
      outcome_.ground_s = after_s;
      const Eigen::Vector3d skids = X_WB * snapshot.session->settings.slad.lander.skid_centre_B();
      seen_from_m_ = -skids.z() - SurfaceHeight(world_, skids.x(), skids.y());
    }
  }

  void End(const MissionStatus& mission, double after_s) {
    if (std::isnan(outcome_.end_s)) {
      outcome_.end_s = after_s;
      outcome_.end = mission.state;
      outcome_.why = mission.why;
    }
    if (mission.state == MissionState::kLanded) {
      outcome_.end = mission.state;
      outcome_.unseen_m = std::isnan(seen_from_m_) ? INFINITY : seen_from_m_;
    }
  }

  FaultOutcome& outcome() { return outcome_; }

 private:
  const World& world_;
  const RigidTransform X_BC_;
  const RangeMap* last_range_ = nullptr;
  std::set<AlarmId> stood_;
  double seen_from_m_ = NAN;
  FaultOutcome outcome_;
};

bool Ended(MissionState state) {
  return state == MissionState::kHold || state == MissionState::kAborting ||
         state == MissionState::kLanded;
}

/// The operator of an armed phase, after the fault.
std::vector<EngineCommand> TryToApprove(const EngineSnapshot& snapshot) {
  const MissionStatus& mission = snapshot.flight->mission;
  if (mission.state == MissionState::kProposed && snapshot.terrain->applied) {
    if (const LandingSite* site =
            mission.BestStanding(snapshot.terrain->applied->selection.sites)) {
      return {{CommandOrigin::kScript, SelectSite{site->id}}};
    }
  }
  if (mission.can_approve && mission.armed) {
    return {{CommandOrigin::kScript, ApproveSite{mission.armed->id, snapshot.sequence}}};
  }
  return {};
}

/// Passes of one phase from the fault to its end; true when it is over.
bool StepArmed(Witness& witness, Engine& engine, const EngineSnapshot& snapshot, double after_s) {
  const MissionStatus& mission = snapshot.flight->mission;
  FaultOutcome& outcome = witness.outcome();
  if (IsFlying(mission.state)) {
    outcome.approved = true;
    witness.End(mission, after_s);
    return true;
  }
  if (after_s >= kTries_s) {
    if (outcome.blocked_by.empty()) {
      outcome.blocked_by =
          mission.state == MissionState::kArmed ? mission.cannot_approve_reason : mission.why;
    }
    for (const EngineCommand& command : TryToApprove(snapshot)) {
      engine.Post(command);
    }
  }
  return after_s > kTriesUntil_s;
}

bool StepDescent(Witness& witness, const EngineSnapshot& snapshot, double after_s) {
  if (Ended(snapshot.flight->mission.state)) {
    witness.End(snapshot.flight->mission, after_s);
  }
  const double end_s = witness.outcome().end_s;
  const bool landed = witness.outcome().end == MissionState::kLanded;
  return after_s > kLongest_s || after_s - end_s > (landed ? 0 : kWatchAfterEnd_s);
}

/// The moment of the fault has come.
bool Begins(FaultPhase phase, const MissionStatus& mission, Timestamp now) {
  return phase == FaultPhase::kArmed ? mission.state == MissionState::kArmed
                                     : mission.state == MissionState::kDescending &&
                                           SecondsBetween(mission.since, now) >= kIntoDescent_s;
}

Status Strike(FaultedSource& source, const FaultCase& fault) {
  for (Fault part : fault.faults) {
    part.from_s = source.now_s() + 1e-3;  // from the next bundle on
    if (const Result<int> added = source.Add(part); !added) {
      return added.error();
    }
  }
  return Ok();
}

}  // namespace

const char* FaultPhaseName(FaultPhase phase) {
  return phase == FaultPhase::kArmed ? "armed" : "descent";
}

Result<FaultOutcome> FlyUnderFault(const FaultFlight& flight, const FaultCase& fault,
                                   FaultPhase phase, const SceneCameraFactory& camera) {
  Result<SimulatedSession> session = OpenSimulatedSession(
      {.scenario = flight.scenario, .seed = flight.seed, .wind_mps = flight.wind_mps}, camera);
  if (!session) {
    return session.error();
  }
  const auto source =
      std::make_shared<FaultedSource>(session->simulator, session->simulator, flight.seed);
  const auto recorded = std::make_shared<std::set<std::string>>();
  EngineParts parts;
  parts.settings = flight.settings;
  parts.mission.session_id = session->id;
  parts.source = source;
  parts.link = source;
  parts.sink = std::make_unique<EventRecord>(recorded);
  Engine engine(std::move(parts), /*threaded=*/false);
  Witness witness(session->scene, DefaultVehicle().rig);
  FlightSummarizer summarizer(session->scene);
  ScriptedOperator pilot;
  double struck_s = NAN;
  while (engine.Step()) {
    const auto snapshot = engine.Latest();
    summarizer.Add(*snapshot);
    const double after_s = source->now_s() - struck_s;
    if (std::isnan(struck_s)) {
      if (Begins(phase, snapshot->flight->mission, snapshot->time)) {
        struck_s = source->now_s();
        witness.Begin(*snapshot);
        if (const Status struck = Strike(*source, fault); !struck) {
          return struck.error();
        }
      } else if (source->now_s() > kReachIt_s) {
        break;
      }
    } else {
      witness.See(*snapshot, after_s);
      if (phase == FaultPhase::kArmed ? StepArmed(witness, engine, *snapshot, after_s)
                                      : StepDescent(witness, *snapshot, after_s)) {
        break;
      }
    }
    if (phase == FaultPhase::kDescent || std::isnan(struck_s)) {
      for (const EngineCommand& command : Ended(snapshot->flight->mission.state)
                                              ? std::vector<EngineCommand>{}
                                              : pilot.Decide(*snapshot)) {
        engine.Post(command);
      }
    }
  }
  if (!engine.error().empty()) {
    return UnavailableError(engine.error());
  }
  FaultOutcome outcome = std::move(witness.outcome());
  if (const Touchdown* touchdown = session->simulator->touchdown();
      touchdown != nullptr && summarizer.summary().site) {
    outcome.miss_m = (touchdown->p_W_skid - summarizer.summary().site->p_WS).head<2>().norm();
  }
  outcome.recorded =
      std::all_of(outcome.raised.begin(), outcome.raised.end(),
                  [&](const RaisedAlarm& alarm) { return recorded->count(alarm.text) == 1; });
  if (std::isfinite(outcome.end_s)) {
    outcome.recorded =
        outcome.recorded &&
        std::any_of(recorded->begin(), recorded->end(), [&](const std::string& text) {
          return text.find(outcome.why) != std::string::npos;
        });
  }
  return outcome;
}

std::vector<std::string> Shortfalls(const FaultCase& fault, FaultPhase phase,
                                    const FaultOutcome& outcome) {
  if (!outcome.struck) {
    return {"the flight did not come to the fault"};
  }
  std::vector<std::string> falls;
  const auto is_one_of = [](const std::vector<AlarmId>& ids, const RaisedAlarm& alarm) {
    return std::find(ids.begin(), ids.end(), alarm.id) != ids.end();
  };
  const auto names = [&](const RaisedAlarm& alarm) { return is_one_of(fault.cause, alarm); };
  const auto named = std::find_if(outcome.raised.begin(), outcome.raised.end(), names);
  if (named == outcome.raised.end()) {
    if (!fault.silent) {
      falls.push_back(outcome.raised.empty() ? "not seen" : "cause not named");
    }
  } else if (named->after_s > fault.within_s + 0.05) {
    falls.push_back("named late");
  }
  for (const RaisedAlarm& alarm : outcome.raised) {
    if (!names(alarm) && !is_one_of(fault.besides, alarm) && !IsConsequence(alarm.id) &&
        !fault.garbled) {
      falls.push_back(std::string("wrong cause: ") + AlarmName(alarm.id));
    }
  }
  if (!outcome.recorded) {
    falls.push_back("not recorded");
  }
  if (phase == FaultPhase::kArmed) {
    if (fault.blocks && outcome.approved) {
      falls.push_back("approved");
    }
    return falls;
  }
  const bool landed = outcome.end == MissionState::kLanded;
  const bool stopped = outcome.end == MissionState::kHold || outcome.end == MissionState::kAborting;
  if (landed && outcome.unseen_m > kCommit_m + kUnseen_m) {
    falls.push_back("landed on ground not seen since");
  }
  if (fault.descent == DescentMust::kStop && !stopped) {
    falls.push_back(landed ? "landed" : "went on");
  }
  if (fault.descent == DescentMust::kLand && !landed) {
    falls.push_back(stopped ? "stopped" : "did not land");
  }
  if (landed && !(outcome.miss_m <= 0.5)) {
    falls.push_back("missed");
  }
  return falls;
}

}  // namespace palace
