// A decision is written before it is sent; a wave-off leaves and is recorded whatever hangs.
#include <latch>
#include <new>

#include <gtest/gtest.h>

#include "tests/runtime/engine_doors.h"

namespace palace {
namespace {

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

}  // namespace
}  // namespace palace
