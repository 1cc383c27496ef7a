// The engine with threads and without gives the same flight; commands, recorder and the abort path
// keep their promises. No pictures: what is seen is tested in its own rooms.
#include "engine/runtime/engine.h"

#include <mutex>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "engine/simulation/simulator.h"

namespace palace {
namespace {

/// Remembers what was recorded; may fail on demand.
struct Tape {
  std::mutex mutex;
  std::vector<std::uint64_t> hashes;
  std::vector<EngineCommand> commands;
  bool closed = false;
};
class TapeSink final : public RecordSink {
 public:
  TapeSink(std::shared_ptr<Tape> tape, int fail_after)
      : tape_(std::move(tape)), left_(fail_after) {}
  Status Record(const RecordItem& item) override {
    if (left_-- <= 0) {
      return UnavailableError("the disk is full");
    }
    const std::lock_guard lock(tape_->mutex);
    tape_->hashes.push_back(item.snapshot->decision_hash);
    tape_->commands.insert(tape_->commands.end(), item.commands.begin(), item.commands.end());
    return Ok();
  }
  Status Close() override {
    tape_->closed = true;
    return Ok();
  }
  std::string Path() const override { return "tape"; }

 private:
  std::shared_ptr<Tape> tape_;
  int left_;
};

class CountingLink final : public VehicleLink {
 public:
  bool Send(const VehicleMessage& message) override {
    const std::lock_guard lock(mutex_);
    aborts_ += std::holds_alternative<AbortRequest>(message) ? 1 : 0;
    return true;
  }
  int aborts() const {
    const std::lock_guard lock(mutex_);
    return aborts_;
  }

 private:
  mutable std::mutex mutex_;
  int aborts_ = 0;
};

EngineParts Parts(double duration_s, std::shared_ptr<Tape> tape, int fail_after = 1'000'000) {
  SimulatorOptions options;
  options.render = false;
  options.duration_limit_s = duration_s;
  EngineParts parts;
  parts.source = std::make_shared<Simulator>(std::move(options), nullptr);
  parts.sink = tape ? std::make_unique<TapeSink>(tape, fail_after) : nullptr;
  return parts;
}

/// Runs a threaded engine until its source ends.
void RunOut(Engine& engine) {
  engine.Start();
  while (!engine.ended()) {
    std::this_thread::yield();
  }
}

TEST(Engine, ThreadsGiveTheSameFlightAsNone) {
  const auto stepped = std::make_shared<Tape>(), threaded = std::make_shared<Tape>();
  Engine plain(Parts(8, stepped), false);
  while (plain.Step()) {
  }
  ASSERT_TRUE(plain.Stop());
  Engine engine(Parts(8, threaded), true);
  RunOut(engine);
  ASSERT_TRUE(engine.Stop());
  EXPECT_GE(stepped->hashes.size(), 79u);
  EXPECT_EQ(stepped->hashes, threaded->hashes);
  EXPECT_TRUE(threaded->closed);
}

TEST(Engine, APauseIsPublishedAlthoughNothingMoreComes) {
  Engine engine(Parts(20, nullptr), false);
  ASSERT_TRUE(engine.Step());
  EXPECT_FALSE(engine.Latest()->session->source.paused);
  for (const bool pause : {true, false, true}) {
    using Kind = PlaybackControl::Kind;
    engine.Control({pause ? Kind::kPause : Kind::kPlay, 0});
    EXPECT_EQ(engine.Latest()->session->source.paused, pause);
  }
}

TEST(Inbox, IsWokenOnceByWhatBringsNothing) {
  Inbox inbox;
  inbox.Wake();
  Inbox::Batch batch;
  ASSERT_TRUE(inbox.Take(batch, {}));
  EXPECT_EQ(batch.bundle, nullptr);
  EXPECT_TRUE(batch.commands.empty());
  std::stop_source stopped;
  stopped.request_stop();
  EXPECT_FALSE(inbox.Take(batch, stopped.get_token()));
}

TEST(Engine, CommandsFromOtherThreadsAreAppliedOnceInOrderAndRecorded) {
  constexpr int kThreads = 3, kEach = 20;
  const auto tape = std::make_shared<Tape>();
  Engine engine(Parts(20, tape), true);
  engine.Start();
  std::vector<std::jthread> operators;
  for (int thread = 0; thread < kThreads; ++thread) {
    operators.emplace_back([&engine, thread] {
      for (int i = 0; i < kEach; ++i) {
        engine.Post({CommandOrigin::kOperator,
                     AddBookmark{std::to_string(thread) + "/" + std::to_string(i)}});
        (void)engine.Latest();
      }
    });
  }
  operators.clear();
  while (!engine.ended()) {
    std::this_thread::yield();
  }
  ASSERT_TRUE(engine.Stop());
  std::vector<std::string> recorded, happened;
  for (const EngineCommand& command : tape->commands) {
    recorded.push_back(std::get<AddBookmark>(command.action).note);
  }
  for (const Event& event : *engine.Latest()->session->events) {
    if (event.kind == EventKind::kBookmark) {
      happened.push_back(event.text);
    }
  }
  EXPECT_EQ(recorded.size(), static_cast<std::size_t>(kThreads * kEach));
  EXPECT_EQ(recorded, happened);
  for (int thread = 0; thread < kThreads; ++thread) {
    int next = 0;
    for (const std::string& note : recorded) {
      const std::string of_thread = std::to_string(thread) + "/";
      if (note.rfind(of_thread, 0) == 0) {
        EXPECT_EQ(note, of_thread + std::to_string(next++));
      }
    }
    EXPECT_EQ(next, kEach) << "thread " << thread;
  }
}

// The screen asks for Play or Pause by what the snapshot says, and a paused source gives none.
TEST(Engine, WhatThePlaybackWasToldIsShownThoughNoFrameComes) {
  using Kind = PlaybackControl::Kind;
  for (const bool threaded : {false, true}) {
    SCOPED_TRACE(threaded ? "threads" : "no threads");
    Engine engine(Parts(threaded ? 1e6 : 20, nullptr), threaded);
    if (threaded) {
      engine.Start();
    } else {
      ASSERT_TRUE(engine.Step());
    }
    while (!engine.Latest()) {
      std::this_thread::yield();
    }
    const auto told = [&](Kind kind, double value, auto is_so) {
      engine.Control({kind, value});
      while (threaded && !is_so(engine.Latest()->session->source)) {
        std::this_thread::yield();  // a defect hangs here, until the test's time is up
      }
      return is_so(engine.Latest()->session->source);
    };
    EXPECT_TRUE(told(Kind::kPause, 0, [](const SourceStatus& s) { return s.paused; }));
    EXPECT_TRUE(told(Kind::kSpeed, 4, [](const SourceStatus& s) { return s.speed == 4; }));
    EXPECT_TRUE(told(Kind::kPlay, 0, [](const SourceStatus& s) { return !s.paused; }));
    EXPECT_TRUE(engine.Stop());
  }
}

TEST(Engine, ARecorderThatFailsIsShownAndReported) {
  const auto tape = std::make_shared<Tape>();
  Engine engine(Parts(3, tape, 5), false);
  while (engine.Step()) {
  }
  EXPECT_FALSE(engine.Latest()->session->recording);
  const Status stopped = engine.Stop();
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().message, "the disk is full");
}

TEST(Engine, WaveOffLeavesByItsOwnPath) {
  const auto link = std::make_shared<CountingLink>();
  EngineParts parts = Parts(1, nullptr);
  parts.link = link;
  Engine engine(std::move(parts), true);
  engine.Post({CommandOrigin::kOperator, WaveOff{}});  // the engine itself is not even running
  while (link->aborts() == 0) {
    std::this_thread::yield();
  }
  EXPECT_EQ(link->aborts(), 1);
}

TEST(Inbox, AnOvertakenFrameIsJoinedAndCommandsAreKept) {
  Inbox inbox;
  const auto first = std::make_shared<FrameBundle>(), second = std::make_shared<FrameBundle>();
  first->stereo = second->stereo = std::make_shared<StereoFrame>();
  first->acks.push_back({{1}, 7, AckResult::kAccepted, ""});
  first->imu.resize(2);
  first->discontinuity = true;
  second->sequence = 2;
  second->imu.resize(3);
  inbox.PutNewest(first);
  EXPECT_EQ(inbox.losses(), Losses{});
  inbox.Post({CommandOrigin::kOperator, WaveOff{}});
  inbox.PutNewest(second);
  EXPECT_EQ(inbox.losses().pairs_replaced, 1u);
  Inbox::Batch batch;
  ASSERT_TRUE(inbox.Take(batch, {}));
  EXPECT_EQ(batch.commands.size(), 1u);
  EXPECT_EQ(batch.bundle->sequence, 2u);
  EXPECT_EQ(batch.bundle->imu.size(), 5u);
  ASSERT_EQ(batch.bundle->acks.size(), 1u);
  EXPECT_EQ(batch.bundle->acks[0].command_id, 7u);
  EXPECT_TRUE(batch.bundle->discontinuity);
}

TEST(Inbox, CommandsAloneWakeTheEngine) {
  Inbox inbox;
  inbox.Post({CommandOrigin::kOperator, DiscardSettings{}});
  Inbox::Batch batch;
  ASSERT_TRUE(inbox.Take(batch, {}));
  EXPECT_EQ(batch.bundle, nullptr);
  EXPECT_EQ(batch.commands.size(), 1u);
}

TEST(Inbox, StopEndsTheWait) {
  Inbox inbox;
  std::stop_source stop;
  stop.request_stop();
  Inbox::Batch batch;
  EXPECT_FALSE(inbox.Take(batch, stop.get_token()));
}

}  // namespace
}  // namespace palace
