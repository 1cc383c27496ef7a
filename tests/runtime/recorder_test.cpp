// The recorder's thread and its queue: what became of a pass is told, and a disk that stands still
// keeps nobody from ending.
#include "engine/runtime/recorder.h"

#include <latch>
#include <thread>

#include <gtest/gtest.h>

namespace palace {
namespace {

/// A disk that does as `disk` says.
class Sink final : public RecordSink {
 public:
  explicit Sink(std::function<Status()> disk, std::function<void()> close = nullptr)
      : disk_(std::move(disk)), close_(std::move(close)) {}
  Status Record(const RecordItem&) override { return disk_(); }
  Status Close() override {
    if (close_) {
      close_();
    }
    return Ok();
  }
  std::string Path() const override { return "sink"; }

 private:
  std::function<Status()> disk_;
  std::function<void()> close_;
};

TEST(Recorder, TellsWhatBecameOfADecision) {
  for (const bool threaded : {false, true}) {
    SCOPED_TRACE(threaded);
    bool refuses = false, throws = false;
    Recorder recorder(std::make_unique<Sink>([&]() -> Status {
                        if (throws) {
                          throw 42;
                        }
                        return refuses ? Status(UnavailableError("full")) : Ok();
                      }),
                      threaded);
    EXPECT_EQ(recorder.RecordFirst({}, false, 60), Written::kYes);
    refuses = true;
    EXPECT_EQ(recorder.RecordFirst({}, false, 60), Written::kNo);
    EXPECT_EQ(recorder.state().problem, "full");
    throws = true;
    EXPECT_EQ(recorder.RecordFirst({}, false, 60), Written::kNo);
    refuses = throws = false;
    EXPECT_EQ(recorder.RecordFirst({}, false, 60), Written::kYes);
    EXPECT_TRUE(recorder.Close());
    EXPECT_EQ(recorder.RecordFirst({}, false, 60), Written::kNo) << "there is no log any more";
  }
}

TEST(Recorder, ADiskThatStandsStillIsLeftAloneAndSaidSo) {
  for (const bool at_the_end : {false, true}) {
    SCOPED_TRACE(at_the_end);
    std::latch go(1);
    const auto wait = [&] { go.wait(); };
    Recorder recorder(std::make_unique<Sink>(
                          [&] {
                            if (!at_the_end) {
                              wait();
                            }
                            return Ok();
                          },
                          [&] {
                            if (at_the_end) {
                              wait();
                            }
                          }),
                      /*threaded=*/true);
    recorder.Record({}, false);
    // A disk that writes has all the patience that a loaded machine needs.
    EXPECT_EQ(recorder.RecordFirst({}, false, at_the_end ? 60 : 0.01),
              at_the_end ? Written::kYes : Written::kLate);
    const Status closed = recorder.Close(/*patience_s=*/0.05);
    ASSERT_FALSE(closed.ok());
    EXPECT_NE(closed.error().message.find("the disk has stood still"), std::string::npos);
    EXPECT_TRUE(recorder.hung());
    go.count_down();
    EXPECT_TRUE(recorder.Close(60).ok());
    EXPECT_FALSE(recorder.hung());
  }
}

TEST(RecordQueue, WhoWaitsForRoomIsLetGoAtTheEnd) {
  RecordQueue queue;
  std::uint64_t last = 0;
  std::jthread full([&] {
    for (int i = 0; i < 100; ++i) {
      last = queue.Push({}, /*may_wait=*/true);  // nobody takes anything out
    }
  });
  queue.HurryUp();
  full.join();
  EXPECT_EQ(last, 100u);
}

TEST(RecordQueue, RemembersWhatBecameOfTheNewest) {
  RecordQueue queue;
  std::vector<std::uint64_t> tickets;
  for (int i = 0; i < 4; ++i) {
    tickets.push_back(queue.Push({}, false));
  }
  queue.Done(tickets[0], true);
  queue.Done(tickets[2], false);  // the second was joined to it
  EXPECT_EQ(queue.AwaitDone(tickets[0], 0), Written::kYes);
  EXPECT_EQ(queue.AwaitDone(tickets[1], 0), Written::kNo);
  EXPECT_EQ(queue.AwaitDone(tickets[2], 0), Written::kNo);
  EXPECT_EQ(queue.AwaitDone(tickets[3], 0), Written::kLate);
}

}  // namespace
}  // namespace palace
