// The doors of the engine: what comes while it is busy is joined, not lost; commands wake it at
// once; a disk that is too slow costs pictures only. Sources and links wait for each other, never
// for a clock.
#include <algorithm>
#include <functional>
#include <latch>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include <gtest/gtest.h>

#include "engine/runtime/engine.h"

namespace palace {
namespace {

std::shared_ptr<FrameBundle> MakeBundle(std::uint64_t number, int samples = 40) {
  auto bundle = std::make_shared<FrameBundle>();
  bundle->sequence = number;
  bundle->time = {1'000'000'000 + static_cast<std::int64_t>(number) * 100'000};
  for (int i = 0; i < samples; ++i) {
    ImuSample sample;
    sample.time = {bundle->time.us - 99'000 + 2'000 * i};
    bundle->imu.push_back(sample);
  }
  bundle->stereo =
      std::make_shared<StereoFrame>(StereoFrame{bundle->time, ImageU8(2, 2, 9), ImageU8(2, 2, 9)});
  return bundle;
}

EngineCommand Bookmark(const std::string& note) {
  return {CommandOrigin::kOperator, AddBookmark{note}};
}

std::vector<std::string> NotesOf(const std::vector<EngineCommand>& commands) {
  std::vector<std::string> notes;
  for (const EngineCommand& command : commands) {
    notes.push_back(std::get<AddBookmark>(command.action).note);
  }
  return notes;
}

/// What was recorded, in order.
struct Tape {
  std::vector<RecordItem> items;
  std::vector<std::string> notes() const {
    std::vector<EngineCommand> commands;
    for (const RecordItem& item : items) {
      commands.insert(commands.end(), item.commands.begin(), item.commands.end());
    }
    return NotesOf(commands);
  }
  std::vector<Timestamp> imu() const {
    std::vector<Timestamp> times;
    for (const RecordItem& item : items) {
      for (const ImuSample& sample : item.bundle ? item.bundle->imu : std::vector<ImuSample>()) {
        times.push_back(sample.time);
      }
    }
    return times;
  }
};

class TapeSink final : public RecordSink {
 public:
  /// The first item waits for `go`.
  explicit TapeSink(std::shared_ptr<Tape> tape, std::latch* go = nullptr)
      : tape_(std::move(tape)), go_(go) {}
  Status Record(const RecordItem& item) override {
    if (go_ != nullptr) {
      go_->wait();
    }
    tape_->items.push_back(item);
    return Ok();
  }
  Status Close() override { return Ok(); }
  std::string Path() const override { return "tape"; }

 private:
  std::shared_ptr<Tape> tape_;
  std::latch* go_;
};

/// A live source of given bundles; `before(i)` runs before number i is handed over, and once more
/// when all are.
class LiveSource final : public Source {
 public:
  LiveSource(std::vector<std::shared_ptr<FrameBundle>> bundles,
             std::function<void(std::size_t)> before)
      : bundles_(std::move(bundles)), before_(std::move(before)) {}
  Result<std::shared_ptr<const FrameBundle>> Next(std::stop_token) override {
    before_(next_);
    if (next_ >= bundles_.size()) {
      return Error{ErrorCode::kEnd, "all given"};
    }
    return std::shared_ptr<const FrameBundle>(bundles_[next_++]);
  }
  bool IsLockstep() const override { return false; }
  SourceStatus Status() const override {
    SourceStatus status;
    status.kind = SourceKind::kLive;
    return status;
  }
  void Control(const PlaybackControl&) override {}

 private:
  std::vector<std::shared_ptr<FrameBundle>> bundles_;
  std::function<void(std::size_t)> before_;
  std::size_t next_ = 0;
};

class Link final : public VehicleLink {
 public:
  explicit Link(std::function<void(const EngineSnapshot&)> announced = nullptr)
      : announced_(std::move(announced)) {}
  bool Send(const VehicleMessage& message) override {
    const std::lock_guard lock(mutex_);
    sent_.push_back(message);
    return true;
  }
  void Announce(const EngineSnapshot& snapshot) override {
    if (announced_) {
      announced_(snapshot);
    }
  }
  std::vector<VehicleMessage> sent() const {
    const std::lock_guard lock(mutex_);
    return sent_;
  }

 private:
  std::function<void(const EngineSnapshot&)> announced_;
  mutable std::mutex mutex_;
  std::vector<VehicleMessage> sent_;
};

// A pass of 0.4 s at 10 Hz pictures and 100 Hz samples: four bundles come while one is worked on.
TEST(Doors, ASlowEngineLosesPicturesOnlyAndCountsThem) {
  std::latch busy(1), go(1), done(1);
  std::vector<std::shared_ptr<FrameBundle>> bundles;
  std::vector<Timestamp> samples;
  for (std::uint64_t number = 0; number < 5; ++number) {
    bundles.push_back(MakeBundle(number));
    for (const ImuSample& sample : bundles.back()->imu) {
      samples.push_back(sample.time);
    }
  }
  bundles[2]->acks = {{bundles[2]->time, 71, AckResult::kAccepted, ""}};
  bundles[3]->acks = {{bundles[3]->time, 72, AckResult::kRefused, "no"}};
  int passes = 0;
  bool finished = false;
  EngineParts parts;
  const auto tape = std::make_shared<Tape>();
  parts.sink = std::make_unique<TapeSink>(tape);
  parts.link = std::make_shared<Link>([&](const EngineSnapshot& snapshot) {
    if (++passes == 1) {
      busy.count_down();
      go.wait();
    } else if (snapshot.time == bundles[4]->time && !std::exchange(finished, true)) {
      done.count_down();
    }
  });
  Engine* to_post = nullptr;
  parts.source = std::make_shared<LiveSource>(bundles, [&](std::size_t number) {
    if (number == 1) {
      busy.wait();
    } else if (number == 5) {
      go.count_down();
    }
    if (number >= 1) {
      to_post->Post(Bookmark(std::to_string(number)));
    }
  });
  Engine engine(std::move(parts), /*threaded=*/true);
  to_post = &engine;
  engine.Start();
  done.wait();
  ASSERT_TRUE(engine.Stop());

  EXPECT_EQ(engine.Latest()->session->losses.pairs_replaced, 3u);
  for (const ChannelId camera : {ChannelId::kCameraLeft, ChannelId::kCameraRight}) {
    const ChannelHealth* channel = FindChannel(engine.Latest()->sensors->channels, camera);
    EXPECT_EQ(channel->count, 5u);
    EXPECT_EQ(channel->lost, 0u) << "overtaken is not lost";
  }
  EXPECT_EQ(engine.Latest()->session->losses.samples_overflowed, 0u);
  EXPECT_EQ(tape->imu(), samples);
  EXPECT_EQ(tape->notes(), (std::vector<std::string>{"1", "2", "3", "4", "5"}));
  std::vector<std::uint64_t> acks;
  for (const RecordItem& item : tape->items) {
    for (const CommandAck& ack : item.bundle ? item.bundle->acks : std::vector<CommandAck>()) {
      acks.push_back(ack.command_id);
    }
  }
  EXPECT_EQ(acks, (std::vector<std::uint64_t>{71, 72}));
}

// The source gives no further frame until the link has the message: nothing waits for one.
TEST(Doors, ACommandBetweenFramesReachesTheWireAtOnce) {
  std::latch seen(1), sent(1);
  const auto link = std::make_shared<Link>([&](const EngineSnapshot& snapshot) {
    if (snapshot.flight->mission.state == MissionState::kAborting) {
      sent.count_down();
    } else {
      seen.count_down();
    }
  });
  EngineParts parts;
  parts.link = link;
  parts.source = std::make_shared<LiveSource>(std::vector{MakeBundle(0)}, [&](std::size_t number) {
    if (number == 1) {
      sent.wait();
    }
  });
  Engine engine(std::move(parts), /*threaded=*/true);
  engine.Start();
  seen.wait();
  engine.Post({CommandOrigin::kOperator, WaveOff{}});
  sent.wait();
  // The engine's own message, beside that of the short path.
  std::vector<std::uint64_t> aborts;
  while (aborts.size() < 2) {
    aborts.clear();
    for (const VehicleMessage& message : link->sent()) {
      if (const auto* abort = std::get_if<AbortRequest>(&message)) {
        aborts.push_back(abort->command_id);
      }
    }
    std::this_thread::yield();
  }
  EXPECT_NE(aborts[0], aborts[1]);
  EXPECT_EQ(engine.Latest()->time, MakeBundle(0)->time);
  ASSERT_TRUE(engine.Stop());
}

// "Vehicle on the ground" keeps a wave-off back only as long as the word is new: an engine that
// publishes nothing more knows nothing of what took off since.
TEST(Doors, AWaveOffIsNotKeptBackByAnOldWordOfTheGround) {
  for (const double said_s : {1e6, -5.0}) {  // from now: just now, and five seconds ago
    SCOPED_TRACE(said_s);
    std::latch done(1);
    const auto link = std::make_shared<Link>([](const EngineSnapshot&) {});
    const auto bundle = MakeBundle(0);
    bundle->status = VehicleStatus{};
    bundle->status->time = bundle->time;
    bundle->status->mode = VehicleMode::kLanded;
    bundle->status->on_ground = true;
    bundle->arrival.clock.emplace();
    bundle->arrival.clock->station_s = MonotonicSeconds() + said_s;
    EngineParts parts;
    parts.link = link;
    parts.source = std::make_shared<LiveSource>(std::vector{bundle}, [&](std::size_t number) {
      if (number == 1) {
        done.wait();
      }
    });
    std::optional<Engine> engine(std::in_place, std::move(parts), /*threaded=*/true);
    engine->Start();
    while (!engine->Latest()) {
      std::this_thread::yield();
    }
    ASSERT_EQ(engine->Latest()->flight->mission.why_no_wave_off, "Vehicle on the ground");
    engine->Post({CommandOrigin::kOperator, WaveOff{}});
    const auto refused = [&] {
      const auto& events = engine->Latest()->session->events;
      return events && std::any_of(events->begin(), events->end(), IsRefusal);
    };
    while (!refused()) {  // by the mission itself, whose time stands still
      std::this_thread::yield();
    }
    done.count_down();
    ASSERT_TRUE(engine->Stop());
    engine.reset();  // the thread of the short path has sent what it was told by now
    const auto sent = link->sent();
    EXPECT_EQ(std::count_if(sent.begin(), sent.end(),
                            [](const VehicleMessage& message) {
                              return std::holds_alternative<AbortRequest>(message);
                            }),
              said_s > 0 ? 0 : 1);
  }
}

TEST(Doors, CommandsBeforeTheFirstFrameAreAppliedWithIt) {
  for (const bool threaded : {false, true}) {
    SCOPED_TRACE(threaded);
    std::latch posted(1);
    const auto tape = std::make_shared<Tape>();
    EngineParts parts;
    parts.sink = std::make_unique<TapeSink>(tape);
    parts.source =
        std::make_shared<LiveSource>(std::vector{MakeBundle(0)}, [&](std::size_t number) {
          if (number == 0) {
            posted.wait();
          }
        });
    Engine engine(std::move(parts), threaded);
    if (threaded) {
      engine.Start();
    }
    engine.Post(Bookmark("early"));
    engine.Post({CommandOrigin::kOperator, SetSetting{"slad.max_slope_deg", 7}});
    posted.count_down();
    if (threaded) {
      while (!engine.Latest() || !engine.ended()) {
        std::this_thread::yield();
      }
    } else {
      ASSERT_TRUE(engine.Step());
    }
    ASSERT_TRUE(engine.Stop());
    EXPECT_EQ(engine.Latest()->session->settings.slad.limits.max_slope_deg, 7);
    ASSERT_EQ(tape->items.size(), 1u);
    EXPECT_EQ(tape->items[0].commands.size(), 2u);
    EXPECT_NE(tape->items[0].bundle, nullptr);
  }
}

TEST(Doors, CommandsThatCameWhenNothingFollowsAreRecorded) {
  const auto tape = std::make_shared<Tape>();
  EngineParts parts;
  parts.sink = std::make_unique<TapeSink>(tape);
  parts.source = std::make_shared<LiveSource>(std::vector{MakeBundle(0)}, [](std::size_t) {});
  Engine engine(std::move(parts), /*threaded=*/false);
  ASSERT_TRUE(engine.Step());
  EXPECT_FALSE(engine.Step());
  engine.Post(Bookmark("last"));
  engine.Step();
  ASSERT_TRUE(engine.Stop());
  EXPECT_EQ(tape->notes(), std::vector<std::string>{"last"});
}

TEST(Recorder, ASlowDiskCostsPicturesNeverCommandsMessagesOrSamples) {
  constexpr std::uint64_t kItems = 200;
  std::uint64_t given = 0;
  const auto tape = std::make_shared<Tape>();
  std::latch go(1);
  Recorder recorder(std::make_unique<TapeSink>(tape, &go), /*threaded=*/true);
  std::vector<std::string> notes;
  std::vector<Timestamp> samples;
  std::vector<std::uint64_t> holds;
  for (std::uint64_t number = 0; number < kItems; ++number) {
    // Every third pass stands between two frames.
    RecordItem item;
    item.bundle = number % 3 == 1 ? nullptr : MakeBundle(number, 5);
    given += item.bundle ? 1 : 0;
    item.commands = {Bookmark(std::to_string(number))};
    item.sent = {HoldRequest{number, ""}};
    notes.push_back(std::to_string(number));
    holds.push_back(number);
    for (const ImuSample& sample : item.bundle ? item.bundle->imu : std::vector<ImuSample>()) {
      samples.push_back(sample.time);
    }
    recorder.Record(std::move(item), /*may_wait=*/false);
  }
  go.count_down();
  ASSERT_TRUE(recorder.Close());
  EXPECT_EQ(tape->notes(), notes);
  EXPECT_EQ(tape->imu(), samples);
  std::vector<std::uint64_t> got_holds;
  std::uint64_t frames = 0;
  for (const RecordItem& item : tape->items) {
    frames += item.bundle && item.bundle->stereo ? 1 : 0;
    for (const VehicleMessage& message : item.sent) {
      got_holds.push_back(std::get<HoldRequest>(message).command_id);
    }
  }
  EXPECT_EQ(got_holds, holds);
  EXPECT_GT(recorder.dropped(), 0u);
  EXPECT_EQ(frames + recorder.dropped(), given);
}

}  // namespace
}  // namespace palace
