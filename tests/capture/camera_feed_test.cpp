// One camera kept going, on a scripted device and a clock that the test moves. No threads.
#include "engine/capture/camera_feed.h"

#include <deque>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "engine/core/random.h"

namespace palace {
namespace {

constexpr double kRate_hz = 10;

Error Lost() { return UnavailableError("/dev/video7: unplugged"); }
Error Damaged() { return InvalidError("/dev/video7: not decodable"); }

/// A camera that gives a picture every 0.1 s of the test's clock, until it is told otherwise.
struct ScriptedCamera {
  double now_s = 100;
  bool plugged = true;
  bool throws = false;
  int width = 8;
  std::deque<Error> errors;  ///< of the next reads
  int opened = 0;
  int open_devices = 0;
  std::vector<double> tries_s;  ///< when it was opened, or tried

  OpenCamera Opener() {
    return [this](const CameraRequest&) -> Result<CameraDevice> {
      tries_s.push_back(now_s);
      if (!plugged) {
        return UnavailableError("/dev/video7: no such camera");
      }
      ++opened;
      ++open_devices;
      const std::shared_ptr<void> closes(nullptr, [this](void*) { --open_devices; });
      CameraDevice device;
      device.rate_hz = kRate_hz;
      device.read = [this, closes]() -> Result<CameraPicture> {
        if (std::exchange(throws, false)) {
          throw std::bad_alloc();
        }
        if (!errors.empty()) {
          const Error error = errors.front();
          errors.pop_front();
          now_s += error.code == ErrorCode::kInvalid ? 1 / kRate_hz : 0;
          return error;
        }
        if (!plugged) {
          return Lost();
        }
        now_s += 1 / kRate_hz;
        return CameraPicture{ImageU8(width, 6), now_s};
      };
      return device;
    };
  }
};

class CameraFeedTest : public testing::Test {
 protected:
  CameraFeedTest()
      : feed_("Camera left", {}, camera_.Opener(), [](const ImageU8& picture) -> Status {
          return picture.width() == 8 ? Ok() : Status(InvalidError("8 x 6 px wanted"));
        }) {}

  CameraFeed::Outcome Step() { return feed_.Step(camera_.now_s); }
  /// Steps until the next picture, letting pauses pass. The number of steps without one.
  int StepsToPicture() {
    for (int steps = 0; steps < 1000; ++steps) {
      const auto outcome = Step();
      if (outcome.picture) {
        return steps;
      }
      camera_.now_s += outcome.pause_s;
    }
    return -1;
  }

  ScriptedCamera camera_;
  CameraFeed feed_;
};

TEST_F(CameraFeedTest, GivesEveryPictureAndItsRate) {
  ASSERT_TRUE(feed_.Start().ok());
  for (int k = 0; k < 20; ++k) {
    const auto outcome = Step();
    ASSERT_TRUE(outcome.picture.has_value()) << k;
    EXPECT_NEAR(outcome.picture->time_s, 100.1 + 0.1 * k, 1e-9) << "the first is that of Start";
  }
  EXPECT_EQ(feed_.counters().frames, 20u);
  EXPECT_NEAR(feed_.counters().rate_hz, kRate_hz, 1e-6);
  EXPECT_EQ(feed_.counters().device_dropped, 0u);
  EXPECT_EQ(feed_.counters().reopens, 0u);
  EXPECT_TRUE(feed_.counters().problem.empty());
}

TEST_F(CameraFeedTest, UnpluggedItIsTriedAgainWithGrowingPausesAndComesBack) {
  ASSERT_TRUE(feed_.Start().ok());
  Step();
  const double newest_s = feed_.newest_s();
  camera_.plugged = false;
  EXPECT_FALSE(Step().picture);
  EXPECT_EQ(camera_.open_devices, 0) << "a lost device is closed, so that it can come back";
  EXPECT_NE(feed_.counters().problem.find("/dev/video7: unplugged"), std::string::npos);
  camera_.tries_s.clear();
  for (int i = 0; i < 8; ++i) {
    camera_.now_s += Step().pause_s;
  }
  ASSERT_GE(camera_.tries_s.size(), 7u);
  const double pauses_s[] = {0.5, 1, 2, 4, 4, 4};
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(camera_.tries_s[i + 1] - camera_.tries_s[i], pauses_s[i], 1e-9) << i;
  }
  EXPECT_EQ(feed_.newest_s(), newest_s) << "its age grows";
  EXPECT_NE(feed_.counters().problem.find("no such camera"), std::string::npos);
  EXPECT_TRUE(std::isnan(feed_.counters().rate_hz));

  camera_.plugged = true;
  ASSERT_GE(StepsToPicture(), 0);
  EXPECT_EQ(feed_.counters().reopens, 1u);
  EXPECT_TRUE(feed_.counters().problem.empty());
  EXPECT_EQ(feed_.counters().device_dropped, 0u) << "the time without a camera is no dropped beat";
  camera_.plugged = false;
  Step();
  EXPECT_NEAR(Step().pause_s, 0.25, 1e-9) << "after it came back the pauses begin anew";
}

TEST_F(CameraFeedTest, AStepWithinThePauseTriesNothing) {
  ASSERT_TRUE(feed_.Start().ok());
  Step();
  camera_.plugged = false;
  EXPECT_NEAR(Step().pause_s, 0.25, 1e-9);
  camera_.tries_s.clear();
  camera_.now_s += 0.2;
  EXPECT_NEAR(Step().pause_s, 0.05, 1e-9);
  EXPECT_TRUE(camera_.tries_s.empty());
}

TEST_F(CameraFeedTest, GapsAndDamagedPicturesAreCountedOnce) {
  ASSERT_TRUE(feed_.Start().ok());
  Step();
  Step();
  camera_.now_s += 0.3;  // three beats without a picture
  ASSERT_TRUE(Step().picture);
  EXPECT_EQ(feed_.counters().device_dropped, 3u);
  camera_.errors = {Damaged(), Damaged()};
  ASSERT_TRUE(Step().picture) << "a damaged picture is read over";
  EXPECT_EQ(feed_.counters().device_dropped, 5u);
  EXPECT_EQ(feed_.counters().frames, 4u);
  EXPECT_EQ(camera_.opened, 1);
}

TEST_F(CameraFeedTest, NothingButDamagedPicturesIsALoss) {
  ASSERT_TRUE(feed_.Start().ok());
  Step();
  camera_.errors.assign(1000, Damaged());
  EXPECT_FALSE(Step().picture);
  EXPECT_NE(feed_.counters().problem.find("not decodable"), std::string::npos);
}

TEST_F(CameraFeedTest, AnotherSizeMidStreamIsSaidAndHealsWithTheDevice) {
  ASSERT_TRUE(feed_.Start().ok());
  Step();
  camera_.width = 16;
  EXPECT_FALSE(Step().picture);
  EXPECT_NE(feed_.counters().problem.find("8 x 6 px wanted"), std::string::npos);
  camera_.width = 8;
  EXPECT_GE(StepsToPicture(), 0);
  EXPECT_TRUE(feed_.counters().problem.empty());
}

TEST_F(CameraFeedTest, StartSaysWhatIsWrong) {
  camera_.plugged = false;
  EXPECT_NE(feed_.Start().error().message.find("no such camera"), std::string::npos);
  camera_.plugged = true;
  camera_.width = 16;
  EXPECT_NE(feed_.Start().error().message.find("8 x 6 px wanted"), std::string::npos);
  camera_.width = 8;
  camera_.errors = {Damaged()};
  EXPECT_TRUE(feed_.Start().ok()) << "many cameras begin with a damaged picture";
  EXPECT_EQ(camera_.open_devices, 1);
}

/// Whatever happens to the device: one device open at most, every picture given is counted, and a
/// plugged camera gives pictures again.
TEST_F(CameraFeedTest, RulesInRandomOrder) {
  constexpr std::uint64_t kSeed = 11;
  SCOPED_TRACE("seed 11");
  RandomStream random(kSeed, "feed");
  ASSERT_TRUE(feed_.Start().ok());
  std::uint64_t pictures = 0;
  for (int step = 0; step < 3000; ++step) {
    switch (random.Index(12)) {
      case 0:
        camera_.plugged = false;
        break;
      case 1:
        camera_.plugged = true;
        break;
      case 2:
        camera_.width = random.Index(2) == 0 ? 8 : 16;
        break;
      case 3:
        camera_.errors.push_back(random.Index(2) == 0 ? Lost() : Damaged());
        break;
      default:
        camera_.now_s += 0.05 * random.Index(20);
    }
    const auto outcome = Step();
    pictures += outcome.picture ? 1 : 0;
    ASSERT_LE(camera_.open_devices, 1);
    ASSERT_EQ(feed_.counters().frames, pictures);
    ASSERT_EQ(outcome.picture.has_value(), feed_.counters().problem.empty());
    ASSERT_EQ(outcome.picture.has_value(), outcome.pause_s == 0);
    ASSERT_LE(outcome.pause_s, ReopenPauses{}.longest_s + 1e-9);
  }
  EXPECT_GT(pictures, 50u);
  camera_.plugged = true;
  camera_.width = 8;
  EXPECT_GE(StepsToPicture(), 0);
  EXPECT_EQ(camera_.open_devices, 1);
}

TEST_F(CameraFeedTest, AnExceptionLosesTheCameraForNowAndNothingElse) {
  StepsToPicture();
  camera_.throws = true;
  const CameraFeed::Outcome lost = Step();
  EXPECT_FALSE(lost.picture.has_value());
  EXPECT_NE(feed_.counters().problem.find("std::bad_alloc"), std::string::npos);
  StepsToPicture();
  EXPECT_EQ(feed_.counters().problem, "");
}

}  // namespace
}  // namespace palace
