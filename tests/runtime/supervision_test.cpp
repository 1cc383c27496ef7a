// An engine that throws, hangs or loses its disk: it is told, recorded, started again; a wave-off
// leaves and is recorded whatever happens. Threads wait for each other, never for a clock.
#include <functional>
#include <latch>
#include <mutex>
#include <new>
#include <thread>

#include <gtest/gtest.h>

#include "engine/runtime/engine.h"

namespace palace {
namespace {

std::shared_ptr<FrameBundle> MakeBundle(std::uint64_t number) {
  auto bundle = std::make_shared<FrameBundle>();
  bundle->sequence = number;
  bundle->time = {1'000'000'000 + static_cast<std::int64_t>(number) * 100'000};
  return bundle;
}

struct Tape {
  std::mutex mutex;
  std::vector<RecordItem> items;
  std::vector<std::string> Notes() {
    const std::lock_guard lock(mutex);
    std::vector<std::string> notes;
    for (const RecordItem& item : items) {
      for (const Event& note : item.notes) {
        notes.push_back(note.text);
      }
    }
    return notes;
  }
  int Aborts() {
    const std::lock_guard lock(mutex);
    int aborts = 0;
    for (const RecordItem& item : items) {
      for (const VehicleMessage& message : item.sent) {
        aborts += std::holds_alternative<AbortRequest>(message) ? 1 : 0;
      }
    }
    return aborts;
  }
};

class TapeSink final : public RecordSink {
 public:
  explicit TapeSink(std::shared_ptr<Tape> tape, std::function<void()> before = nullptr)
      : tape_(std::move(tape)), before_(std::move(before)) {}
  Status Record(const RecordItem& item) override {
    if (before_) {
      before_();
    }
    const std::lock_guard lock(tape_->mutex);
    tape_->items.push_back(item);
    return Ok();
  }
  Status Close() override { return Ok(); }
  std::string Path() const override { return "tape"; }

 private:
  std::shared_ptr<Tape> tape_;
  std::function<void()> before_;
};

/// Bundles without end; `before(i)` runs before number i is handed over.
class EndlessSource final : public Source {
 public:
  explicit EndlessSource(std::function<void(std::uint64_t)> before, bool lockstep = true)
      : before_(std::move(before)), lockstep_(lockstep) {}
  Result<std::shared_ptr<const FrameBundle>> Next(std::stop_token stop) override {
    if (before_) {
      before_(next_);
    }
    if (stop.stop_requested()) {
      return Error{ErrorCode::kEnd, "stopped"};
    }
    return std::shared_ptr<const FrameBundle>(MakeBundle(next_++));
  }
  bool IsLockstep() const override { return lockstep_; }
  SourceStatus Status() const override {
    SourceStatus status;
    status.kind = SourceKind::kSimulation;
    return status;
  }
  void Control(const PlaybackControl&) override {}

 private:
  std::function<void(std::uint64_t)> before_;
  const bool lockstep_;
  std::uint64_t next_ = 0;
};

/// A link whose Announce, called by the engine's own thread in each pass, does as it is told: it
/// stands for whatever may go wrong in the engine.
class Link final : public VehicleLink {
 public:
  explicit Link(std::function<void(const EngineSnapshot&)> announced = nullptr)
      : announced_(std::move(announced)) {}
  bool Send(const VehicleMessage& message) override {
    if (on_send) {
      return on_send();
    }
    const std::lock_guard lock(mutex_);
    aborts_ += std::holds_alternative<AbortRequest>(message) ? 1 : 0;
    last_send_s_ = MonotonicSeconds();
    return true;
  }
  std::function<bool()> on_send;  ///< set before the engine starts
  void Announce(const EngineSnapshot& snapshot) override {
    if (announced_) {
      announced_(snapshot);
    }
  }
  int aborts() const {
    const std::lock_guard lock(mutex_);
    return aborts_;
  }
  double last_send_s() const {
    const std::lock_guard lock(mutex_);
    return last_send_s_;
  }

 private:
  std::function<void(const EngineSnapshot&)> announced_;
  mutable std::mutex mutex_;
  int aborts_ = 0;
  double last_send_s_ = 0;
};

template <typename Condition>
void WaitFor(Condition&& condition) {
  while (!condition()) {
    std::this_thread::yield();
  }
}

bool Shows(const EngineSnapshot& snapshot, AlarmId id) {
  for (const Alarm& alarm : snapshot.flight->mission.alarms) {
    if (alarm.kind == id) {
      return true;
    }
  }
  return false;
}

TEST(Supervision, AnEngineThatThrowsIsStartedAgainThreeTimesAndSaysSo) {
  const auto tape = std::make_shared<Tape>();
  int thrown = 0;
  EngineParts parts;
  parts.source = std::make_shared<EndlessSource>(nullptr);
  parts.sink = std::make_unique<TapeSink>(tape);
  parts.settings.slad.limits.max_slope_deg = 8;
  parts.link = std::make_shared<Link>([&](const EngineSnapshot& snapshot) {
    if (snapshot.sequence % 10 == 9 && ++thrown > 0) {
      throw std::bad_alloc();
    }
  });
  Engine engine(std::move(parts), /*threaded=*/false);
  std::uint64_t sequence = 0;
  for (int stop = 1; stop <= 3; ++stop) {
    while (thrown < stop) {
      ASSERT_TRUE(engine.Step());
    }
    ASSERT_TRUE(engine.Step()) << "it goes on with the next bundle";
    const auto snapshot = engine.Latest();
    EXPECT_GT(snapshot->sequence, sequence);
    sequence = snapshot->sequence;
    EXPECT_EQ(snapshot->flight->mission.state, MissionState::kNoLive);
    EXPECT_EQ(snapshot->session->settings.slad.limits.max_slope_deg, 8) << "the limits in force";
    EXPECT_TRUE(Shows(*snapshot, AlarmId::kEngineStopped));
    ASSERT_TRUE(engine.Step());
    EXPECT_EQ(engine.Complaint(), "");
  }
  while (engine.Step()) {
  }
  EXPECT_EQ(thrown, 4);
  EXPECT_NE(engine.error().find("Engine stopped: std::bad_alloc"), std::string::npos);
  EXPECT_NE(engine.Complaint().find("Engine stopped"), std::string::npos);
  (void)engine.Stop();
  const auto notes = tape->Notes();
  ASSERT_EQ(notes.size(), 4u);
  EXPECT_EQ(notes[0], "Engine stopped: std::bad_alloc");
  // Each bundle is in the record once, and the first of each new start says that it is one.
  std::vector<std::uint64_t> numbers;
  int starts = 0;
  for (const RecordItem& item : tape->items) {
    if (item.bundle) {
      numbers.push_back(item.bundle->sequence);
      starts += item.bundle->discontinuity ? 1 : 0;
    }
  }
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    EXPECT_EQ(numbers[i], i);
  }
  EXPECT_EQ(starts, 3);
}

TEST(Supervision, AnEngineThatThrowsOnItsThreadIsStartedAgain) {
  std::latch again(1);
  bool thrown = false, counted = false;
  EngineParts parts;
  parts.source = std::make_shared<EndlessSource>(nullptr);
  parts.link = std::make_shared<Link>([&](const EngineSnapshot&) {
    if (!thrown) {
      thrown = true;
      throw std::runtime_error("a test");
    }
    if (!counted) {
      counted = true;
      again.count_down();
    }
  });
  Engine engine(std::move(parts), /*threaded=*/true);
  engine.Start();
  again.wait();
  EXPECT_TRUE(engine.Stop());
  EXPECT_EQ(engine.Complaint(), "");
}

TEST(Supervision, ASourceThatThrowsIsAskedAgain) {
  bool thrown = false;
  EngineParts parts;
  std::latch again(1);
  parts.source = std::make_shared<EndlessSource>([&](std::uint64_t number) {
    if (number == 3 && !thrown) {
      thrown = true;
      throw std::bad_alloc();
    }
    if (number == 6) {
      again.count_down();
    }
  });
  Engine engine(std::move(parts), /*threaded=*/true);
  engine.Start();
  again.wait();
  EXPECT_TRUE(engine.Stop());
  EXPECT_EQ(engine.error(), "");
}

TEST(Supervision, ASourceThatThrowsAnythingIsToldShownAndRecorded) {
  bool thrown = false;
  const auto tape = std::make_shared<Tape>();
  std::latch shown(1);
  bool once = false;
  EngineParts parts;
  parts.source = std::make_shared<EndlessSource>([&](std::uint64_t number) {
    if (number == 3 && !std::exchange(thrown, true)) {
      throw 42;  // no std::exception
    }
  });
  parts.sink = std::make_unique<TapeSink>(tape);
  parts.link = std::make_shared<Link>([&](const EngineSnapshot& snapshot) {
    if (Shows(snapshot, AlarmId::kEngineStopped) && !std::exchange(once, true)) {
      shown.count_down();
    }
  });
  Engine engine(std::move(parts), /*threaded=*/true);
  engine.Start();
  shown.wait();
  EXPECT_TRUE(engine.Stop());
  EXPECT_EQ(engine.error(), "");
  ASSERT_GE(tape->Notes().size(), 1u);
  EXPECT_EQ(tape->Notes()[0], "Source stopped: unknown exception");
}

/// What did not leave is no message that was sent.
TEST(Supervision, AWaveOffThatCouldNotBeSentIsRecordedAsThat) {
  for (const int throws : {0, 1, 2}) {
    SCOPED_TRACE(throws);
    const auto link = std::make_shared<Link>();
    link->on_send = [&]() -> bool {
      if (throws == 1) {
        throw std::bad_alloc();
      }
      if (throws == 2) {
        throw 42;
      }
      return false;
    };
    std::vector<std::pair<bool, bool>> told;  // a wave-off, left
    std::latch done(1);
    {
      StopSender sender(link, [&](const VehicleMessage& message, bool left) {
        told.emplace_back(std::holds_alternative<AbortRequest>(message), left);
        done.count_down();
      });
      sender.WaveOff();
      done.wait();
    }
    EXPECT_EQ(told, (std::vector<std::pair<bool, bool>>{{true, false}}));
  }
  const auto tape = std::make_shared<Tape>();
  const auto link = std::make_shared<Link>();
  link->on_send = [] { return false; };
  EngineParts parts;
  parts.source = std::make_shared<EndlessSource>(nullptr);
  parts.sink = std::make_unique<TapeSink>(tape);
  parts.link = link;
  Engine engine(std::move(parts), /*threaded=*/true);
  engine.Start();
  engine.Post({CommandOrigin::kOperator, WaveOff{}});
  const auto says = [&] {
    for (const std::string& note : tape->Notes()) {
      if (note == "A wave-off could not be sent") {
        return true;
      }
    }
    return false;
  };
  WaitFor(says);
  EXPECT_TRUE(engine.Stop());
}

/// I16: a refusing disk is no slow disk, and neither is passed over.
TEST(Supervision, ADecisionThatTheDiskRefusedIsToldInTheRecord) {
  const auto tape = std::make_shared<Tape>();
  bool refuses = false;
  EngineParts parts;
  parts.source = std::make_shared<EndlessSource>(nullptr);
  parts.sink = std::make_unique<TapeSink>(tape, [&] {
    if (refuses) {
      throw std::runtime_error("the disk is full");
    }
  });
  Engine engine(std::move(parts), /*threaded=*/false);
  ASSERT_TRUE(engine.Step());
  refuses = true;
  engine.Post({CommandOrigin::kOperator, AddBookmark{"now"}});
  ASSERT_TRUE(engine.Step());
  refuses = false;
  ASSERT_TRUE(engine.Step());
  const auto notes = tape->Notes();
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0], "A decision was sent that could not be written before: the disk is full");
}

/// Events that a stopped engine told keep their numbers; those it told last are not told anew.
TEST(Supervision, EventsAreNumberedOnOverARestart) {
  std::vector<std::uint64_t> newest;
  EngineParts parts;
  parts.source = std::make_shared<EndlessSource>(nullptr);
  parts.link = std::make_shared<Link>([&](const EngineSnapshot& snapshot) {
    newest.push_back(snapshot.session->events->back().number);
    if (newest.size() == 2) {
      throw std::bad_alloc();  // its snapshot, with the second bookmark, is never published
    }
  });
  Engine engine(std::move(parts), /*threaded=*/false);
  for (const char* note : {"one", "two", "three"}) {
    engine.Post({CommandOrigin::kOperator, AddBookmark{note}});
    ASSERT_TRUE(engine.Step());
  }
  ASSERT_EQ(newest.size(), 3u);
  EXPECT_GT(newest[1], newest[0]);
  EXPECT_GT(newest[2], newest[1]);
  const auto& events = *engine.Latest()->session->events;
  for (std::size_t i = 1; i < events.size(); ++i) {
    EXPECT_GT(events[i].number, events[i - 1].number);
  }
  EXPECT_EQ(events.front().number, 1u);
}

TEST(Supervision, ARecorderThatThrowsIsToldAndTriedAgain) {
  const auto tape = std::make_shared<Tape>();
  int calls = 0;
  EngineParts parts;
  parts.source = std::make_shared<EndlessSource>(nullptr);
  parts.sink = std::make_unique<TapeSink>(tape, [&] {
    if (++calls == 3) {
      throw std::bad_alloc();
    }
  });
  Engine engine(std::move(parts), /*threaded=*/false);
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(engine.Step());
  }
  ASSERT_TRUE(engine.Step());
  EXPECT_FALSE(engine.Latest()->session->recording);
  EXPECT_EQ(engine.Latest()->session->record.problem, "std::bad_alloc");
  ASSERT_TRUE(engine.Step());
  EXPECT_TRUE(engine.Latest()->session->recording);
  EXPECT_TRUE(engine.Stop());
}

TEST(Supervision, AHangingEngineIsNamedAndAWaveOffLeavesAndIsRecorded) {
  std::latch hangs(1), go(1);
  bool once = false;
  const auto tape = std::make_shared<Tape>();
  const auto link = std::make_shared<Link>([&](const EngineSnapshot& snapshot) {
    if (snapshot.sequence == 3 && !once) {
      once = true;
      hangs.count_down();
      go.wait();
    }
  });
  EngineParts parts;
  parts.source = std::make_shared<EndlessSource>(nullptr);
  parts.sink = std::make_unique<TapeSink>(tape);
  parts.link = link;
  Engine engine(std::move(parts), /*threaded=*/true);
  engine.Start();
  hangs.wait();
  WaitFor([&] { return !engine.Complaint().empty(); });
  EXPECT_NE(engine.Complaint().find("Engine has not answered for 1.0 s, limit 1 s."),
            std::string::npos)
      << engine.Complaint();
  const double pressed_s = MonotonicSeconds();
  engine.Post({CommandOrigin::kOperator, WaveOff{}});
  WaitFor([&] { return link->aborts() > 0; });
  std::printf("wave-off of a hanging engine on the wire after %.2f ms\n",
              1e3 * (link->last_send_s() - pressed_s));
  WaitFor([&] { return tape->Aborts() > 0; });
  // It does not end, so it is left alone; the log is closed.
  const Status stopped = engine.Stop();
  EXPECT_FALSE(stopped);
  EXPECT_TRUE(engine.hung());
  go.count_down();
  (void)engine.Stop();
  EXPECT_FALSE(engine.hung());
}

TEST(Supervision, AWaveOffWaitsNeitherForADiskNorForPictures) {
  std::latch disk(1), silent(1), go(1);
  const auto tape = std::make_shared<Tape>();
  const auto link = std::make_shared<Link>();
  EngineParts parts;
  parts.source = std::make_shared<EndlessSource>(
      [&](std::uint64_t number) {
        if (number == 5) {
          silent.count_down();
          go.wait();  // all pictures and messages stop
        }
      },
      /*lockstep=*/false);
  parts.sink = std::make_unique<TapeSink>(tape, [&] { disk.wait(); });
  parts.link = link;
  Engine engine(std::move(parts), /*threaded=*/true);
  engine.Start();
  silent.wait();
  engine.Post({CommandOrigin::kOperator, WaveOff{}});
  // Both copies leave while the disk has not taken a byte.
  WaitFor([&] { return link->aborts() >= 2; });
  disk.count_down();
  WaitFor([&] { return tape->Aborts() >= 2; });
  go.count_down();
  (void)engine.Stop();
}

// I16, over the order in which disk and link see a command.
TEST(Supervision, WhatWasDecidedIsWrittenBeforeItIsSent) {
  const auto tape = std::make_shared<Tape>();
  std::vector<std::size_t> written_when_announced;
  EngineParts parts;
  parts.source = std::make_shared<EndlessSource>(nullptr);
  parts.sink = std::make_unique<TapeSink>(tape);
  std::latch done(1);
  parts.link = std::make_shared<Link>([&](const EngineSnapshot& snapshot) {
    if (snapshot.session->events && !snapshot.session->events->empty() &&
        snapshot.session->events->back().text == "now") {
      const std::lock_guard lock(tape->mutex);
      for (const RecordItem& item : tape->items) {
        if (!item.commands.empty()) {
          written_when_announced.push_back(item.commands.size());
        }
      }
      done.count_down();
      throw std::runtime_error("one look is enough");
    }
  });
  Engine engine(std::move(parts), /*threaded=*/true);
  engine.Start();
  engine.Post({CommandOrigin::kOperator, AddBookmark{"now"}});
  done.wait();
  (void)engine.Stop();
  EXPECT_EQ(written_when_announced, std::vector<std::size_t>{1});
}

TEST(EngineWatch, RestartsThreeTimesFiveSecondsApart) {
  EngineWatch watch;
  EXPECT_EQ(watch.Stopped("Engine", "x", 100), 100);
  watch.Started(100);
  EXPECT_EQ(watch.Stopped("Engine", "x", 101), 105);
  EXPECT_NE(watch.Complaint(103).find("starts again in 2 s"), std::string::npos);
  watch.Started(105);
  EXPECT_EQ(watch.Stopped("Engine", "x", 500), 500);
  watch.Started(500);
  EXPECT_FALSE(watch.Stopped("Engine", "y", 900).has_value());
  EXPECT_NE(watch.Complaint(900).find("Engine stopped: y. It was started again 3 times"),
            std::string::npos);
}

TEST(EngineWatch, APassIsSaidToHangOnlyBeyondItsLimit) {
  EngineWatch watch;
  EXPECT_EQ(watch.Complaint(50), "");
  watch.Begin(50);
  EXPECT_EQ(watch.Complaint(51), "");
  EXPECT_NE(watch.Complaint(51.5).find("1.5 s, limit 1 s"), std::string::npos);
  watch.End();
  EXPECT_EQ(watch.Complaint(99), "");
}

}  // namespace
}  // namespace palace
