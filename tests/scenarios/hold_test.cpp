// Hold here, of a real descent, leaves at once: it waits for no frame, and for no pass.
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "engine/journal/flight_recorder.h"
#include "engine/runtime/engine.h"
#include "engine/runtime/scripted_operator.h"
#include "engine/simulation/session.h"
#include "gui/platform/offscreen_scene_camera.h"
#include "tests/scenarios/scenario.h"

namespace palace {
namespace {

constexpr int kMostFrames = 300;

/// A simulated vehicle that gives a frame only when asked to, and may hold the engine in a pass.
class GatedVehicle final : public Source, public VehicleLink {
 public:
  explicit GatedVehicle(std::shared_ptr<Simulator> simulator) : simulator_(std::move(simulator)) {}
  Result<std::shared_ptr<const FrameBundle>> Next(std::stop_token stop) override {
    {
      std::unique_lock lock(mutex_);
      if (!changed_.wait(lock, stop, [&] { return frames_ > 0; })) {
        return Error{ErrorCode::kEnd, "stopped"};
      }
      --frames_;
    }
    return simulator_->Next(stop);
  }
  bool IsLockstep() const override { return true; }
  SourceStatus Status() const override { return simulator_->Status(); }
  void Control(const PlaybackControl&) override {}
  bool Send(const VehicleMessage& message) override {
    simulator_->Send(message);
    const std::lock_guard lock(mutex_);
    if (const auto* hold = std::get_if<HoldRequest>(&message)) {
      holds_.push_back(hold->command_id);
    }
    changed_.notify_all();
    return true;
  }
  void Seal(VehicleMessage& message) override { simulator_->Seal(message); }
  void Hear(const FrameBundle& bundle) override { simulator_->Hear(bundle); }
  AuthorityStatus Authority() const override { return simulator_->Authority(); }
  void Announce(const EngineSnapshot& snapshot) override {
    std::unique_lock lock(mutex_);
    if (flown_.empty() || flown_.back().first != snapshot.time) {
      flown_.emplace_back(snapshot.time, snapshot.decision_hash);
    }
    in_pass_ = true;
    changed_.notify_all();
    changed_.wait(lock, [&] { return !blocked_; });
    in_pass_ = false;
  }

  /// Time and hash of the pass of each frame.
  std::vector<std::pair<Timestamp, std::uint64_t>> flown() const {
    const std::lock_guard lock(mutex_);
    return flown_;
  }
  void GiveFrame() {
    const std::lock_guard lock(mutex_);
    ++frames_;
    changed_.notify_all();
  }
  void BlockPasses(bool blocked) {
    const std::lock_guard lock(mutex_);
    blocked_ = blocked;
    changed_.notify_all();
  }
  void AwaitPass() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return in_pass_; });
  }
  std::vector<std::uint64_t> AwaitHolds(std::size_t count) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return holds_.size() >= count; });
    return holds_;
  }

 private:
  std::shared_ptr<Simulator> simulator_;
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::vector<std::uint64_t> holds_;
  std::vector<std::pair<Timestamp, std::uint64_t>> flown_;
  int frames_ = 0;
  bool blocked_ = false;
  bool in_pass_ = false;
};

using Hold = Scenario;

TEST_F(Hold, LeavesWithoutAFrameOrAPassAndIsReplayedAsFlown) {
  EngineParts parts;
  const SimulatedSession session =
      OpenSimulatedSession({.seed = 1}, MakeOffscreenSceneCamera).value();
  const auto vehicle = std::make_shared<GatedVehicle>(session.simulator);
  parts.source = vehicle;
  parts.link = vehicle;
  auto recorder = FlightRecorder::Open(folder_, "flight");
  ASSERT_TRUE(recorder.ok());
  parts.sink = std::move(*recorder);
  Engine engine(std::move(parts), /*threaded=*/true);
  engine.Start();
  const auto step = [&] {
    const auto before = engine.Latest();
    vehicle->GiveFrame();
    while (!engine.ended() &&
           (!engine.Latest() || (before && engine.Latest()->time == before->time))) {
      std::this_thread::yield();
    }
  };
  ScriptedOperator pilot;
  const auto state = [&] { return engine.Latest()->flight->mission.state; };
  step();
  for (int i = 0; i < kMostFrames && state() != MissionState::kDescending; ++i) {
    for (const EngineCommand& command : pilot.Decide(*engine.Latest())) {
      engine.Post(command);  // between frames: none is given before the next step
    }
    step();
  }
  ASSERT_EQ(state(), MissionState::kDescending) << engine.Latest()->flight->mission.why;
  step();

  // A pass that does not end: the short path does not wait for it.
  vehicle->BlockPasses(true);
  vehicle->GiveFrame();
  vehicle->AwaitPass();
  engine.Post({CommandOrigin::kOperator, HoldHere{}});
  ASSERT_EQ(vehicle->AwaitHolds(1).size(), 1u);
  EXPECT_EQ(state(), MissionState::kDescending);

  // The pass ends, and no frame follows: the engine's own does not wait for one.
  vehicle->BlockPasses(false);
  const std::vector<std::uint64_t> holds = vehicle->AwaitHolds(2);
  EXPECT_NE(holds[0], holds[1]);
  while (state() == MissionState::kDescending) {
    std::this_thread::yield();
  }
  EXPECT_EQ(state(), MissionState::kHold);
  EXPECT_EQ(engine.Latest()->time, vehicle->flown().back().first);
  step();
  step();
  EXPECT_EQ(state(), MissionState::kHold);
  EXPECT_EQ(engine.Latest()->sensors->vehicle->mode, VehicleMode::kHold);
  ASSERT_TRUE(engine.Stop().ok());

  const auto flown = vehicle->flown();
  EngineParts again;
  auto log = OpenLog(folder_ / "flight" / "flight.lcm");
  again.settings = log->recorded()->settings_at_start;
  again.source = std::move(log);
  Engine replay(std::move(again), /*threaded=*/false);
  for (std::size_t i = 0; i < flown.size(); ++i) {
    ASSERT_TRUE(replay.Step()) << i;
    ASSERT_EQ(replay.Latest()->time, flown[i].first) << i;
    ASSERT_EQ(replay.Latest()->decision_hash, flown[i].second) << i;
  }
  EXPECT_EQ(replay.Latest()->flight->mission.state, MissionState::kHold);
}

}  // namespace
}  // namespace palace
