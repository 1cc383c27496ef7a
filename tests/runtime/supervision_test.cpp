// An engine, a source or a recorder that throws is told, recorded and started again.
#include <latch>
#include <new>

#include <gtest/gtest.h>

#include "tests/runtime/engine_doors.h"

namespace palace {
namespace {

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

}  // namespace
}  // namespace palace
