// Live cameras: threads, pairing and status, on devices whose every picture the test hands over and
// on a clock that the test moves. Waits are for events, never for time.
#include "engine/capture/camera_source.h"

#include <atomic>
#include <condition_variable>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "tests/capture/film.h"

namespace palace {
namespace {

constexpr Timestamp kStart{5'000'000'000};
constexpr double kMonotonicStart_s = 1000;

/// A port that a camera may be plugged into; its reads wait for what the test hands over.
class Port {
 public:
  void Give(int grey, double time_s, int width = film::kWidth, int height = film::kHeight) {
    Put(CameraPicture{ImageU8(width, height, static_cast<std::uint8_t>(grey)), time_s});
  }
  void Fail() { Put(UnavailableError("the cable is out")); }
  void Unplug() {
    const std::lock_guard lock(mutex_);
    plugged_ = false;
    items_.push_back(UnavailableError("the cable is out"));
    changed_.notify_all();
  }
  void Plug() {
    const std::lock_guard lock(mutex_);
    plugged_ = true;
    items_.clear();
    changed_.notify_all();
  }
  /// Nothing waits here any more.
  void Close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    changed_.notify_all();
  }
  bool Waits() {
    const std::lock_guard lock(mutex_);
    return waiting_ && items_.empty();
  }
  int open_devices() const { return *open_devices_; }

  Result<CameraDevice> Open() {
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return plugged_ || closed_; });
      if (closed_) {
        return UnavailableError("closed");
      }
    }
    ++*open_devices_;
    const std::shared_ptr<void> closes(nullptr, [n = open_devices_](void*) { --*n; });
    CameraDevice device;
    device.rate_hz = 25;
    device.read = [this, closes] { return Read(); };
    return device;
  }

 private:
  void Put(Result<CameraPicture> item) {
    const std::lock_guard lock(mutex_);
    items_.push_back(std::move(item));
    changed_.notify_all();
  }
  Result<CameraPicture> Read() {
    std::unique_lock lock(mutex_);
    waiting_ = true;
    changed_.wait(lock, [&] { return !items_.empty() || closed_; });
    waiting_ = false;
    if (items_.empty()) {
      return UnavailableError("closed");
    }
    Result<CameraPicture> item = std::move(items_.front());
    items_.pop_front();
    return item;
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Result<CameraPicture>> items_;
  bool plugged_ = true;
  bool closed_ = false;
  bool waiting_ = false;
  const std::shared_ptr<std::atomic<int>> open_devices_ = std::make_shared<std::atomic<int>>(0);
};

/// Waits for what another thread will do.
template <typename Condition>
void Until(const Condition& condition) {
  while (!condition()) {
    std::this_thread::yield();
  }
}

class CameraSourceTest : public film::FilmTest {
 protected:
  void TearDown() override {
    for (auto& [name, port] : ports_) {
      port.Close();
    }
    source_.reset();
    for (auto& [name, port] : ports_) {
      Until([&, &p = port] { return p.open_devices() == 0; });
    }
    FilmTest::TearDown();
  }

  Port& left() { return ports_["/dev/video1"]; }
  Port& right() { return ports_["/dev/video2"]; }
  CameraSourceOptions Options() {
    CameraSourceOptions options;
    options.open = [this](const CameraRequest& r) { return ports_[r.address].Open(); };
    options.now_s = [this] { return now_s_.load(); };
    options.start = kStart;
    options.heartbeat_s = 1000;  // none, unless a test asks
    options.stop_within_s = 1000;
    options.pauses = {0, 0};  // an unplugged port itself waits until it is plugged
    return options;
  }
  Result<std::unique_ptr<CameraSource>> TryOpen(
      const CameraSourceOptions& options, const std::string& capture = "left = 1\nright = 2\n",
      bool pose = true) {
    auto cameras = LoadRigCameras(WriteRig(capture, pose));
    return cameras ? CameraSource::Open(*cameras, options) : cameras.error();
  }
  /// Both cameras give their first picture and the first pair is taken.
  void Open(const CameraSourceOptions& options) {
    left().Give(10, kMonotonicStart_s);
    right().Give(110, kMonotonicStart_s);
    auto source = TryOpen(options);
    ASSERT_TRUE(source.ok()) << source.error().message;
    source_ = std::move(source).value();
    ASSERT_NE(Next()->stereo, nullptr);
  }
  std::shared_ptr<const FrameBundle> Next() {
    auto bundle = source_->Next({});
    EXPECT_TRUE(bundle.ok()) << bundle.error().message;
    return bundle ? *bundle : nullptr;
  }

  std::map<std::string, Port> ports_;
  std::atomic<double> now_s_ = kMonotonicStart_s;
  std::unique_ptr<CameraSource> source_;
};

TEST_F(CameraSourceTest, GivesPairsWithTimesAndPose) {
  Open(Options());
  EXPECT_FALSE(source_->IsLockstep());
  now_s_ = kMonotonicStart_s + 0.05;
  left().Give(20, kMonotonicStart_s + 0.040);
  right().Give(120, kMonotonicStart_s + 0.043);
  const auto bundle = Next();
  EXPECT_EQ(bundle->sequence, 2u);
  EXPECT_EQ(bundle->stereo->time.us, kStart.us + 40'000) << "the left picture's arrival";
  EXPECT_EQ(bundle->time.us, kStart.us + 50'000) << "the clock's, when the pair was taken";
  EXPECT_EQ(bundle->stereo->left.at(0, 0), 20);
  EXPECT_EQ(bundle->stereo->right.at(0, 0), 120);
  ASSERT_TRUE(bundle->pose_at_exposure.has_value());
  EXPECT_EQ(bundle->pose_at_exposure->X_WB.p.z(), -12);
  EXPECT_EQ(bundle->pose_at_exposure->time, bundle->stereo->time);
  EXPECT_EQ(bundle->rig->rate_hz, 25) << "as the cameras say";
  EXPECT_FALSE(bundle->status) << "there is no vehicle";
  const SourceStatus status = source_->Status();
  EXPECT_EQ(status.kind, SourceKind::kCameras);
  ASSERT_EQ(status.cameras.size(), 2u);
  EXPECT_EQ(status.cameras[0].name, "Camera left");
  EXPECT_EQ(status.cameras[1].frames, 2u);
  EXPECT_NEAR(status.cameras[1].age_s, 0.007, 1e-9);
}

TEST_F(CameraSourceTest, WithoutAPoseThereIsNone) {
  left().Give(10, kMonotonicStart_s);
  right().Give(110, kMonotonicStart_s);
  auto source = TryOpen(Options(), "left = 1\nright = 2\n", /*pose=*/false);
  ASSERT_TRUE(source.ok());
  source_ = std::move(source).value();
  const auto bundle = Next();
  EXPECT_FALSE(bundle->pose_at_exposure);
  EXPECT_TRUE(bundle->poses.empty());
}

TEST_F(CameraSourceTest, TheNewestPairWins) {
  Open(Options());
  for (int k = 1; k <= 3; ++k) {
    left().Give(10 + k, kMonotonicStart_s + 0.04 * k);
    right().Give(110 + k, kMonotonicStart_s + 0.04 * k);
  }
  Until([&] {
    const auto cameras = source_->Status().cameras;
    return cameras[0].frames == 4 && cameras[1].frames == 4;
  });
  EXPECT_EQ(Next()->stereo->left.at(0, 0), 13);
}

TEST_F(CameraSourceTest, PicturesWithoutAPartnerAreCounted) {
  Open(Options());
  left().Give(11, kMonotonicStart_s + 0.04);  // right misses this one
  left().Give(12, kMonotonicStart_s + 0.08);
  right().Give(112, kMonotonicStart_s + 0.08);
  EXPECT_EQ(Next()->stereo->left.at(0, 0), 12);
  const auto cameras = source_->Status().cameras;
  EXPECT_EQ(cameras[0].unpaired, 1u);
  EXPECT_EQ(cameras[1].unpaired, 0u);
  EXPECT_EQ(cameras[1].device_dropped, 1u) << "its beat is 25 Hz";
}

TEST_F(CameraSourceTest, AnUnpluggedCameraIsToldAgesAndComesBack) {
  CameraSourceOptions options = Options();
  options.heartbeat_s = 0;
  options.open = [this](const CameraRequest& r) { return ports_[r.address].Open(); };
  left().Give(10, kMonotonicStart_s);
  right().Give(110, kMonotonicStart_s);
  auto source = TryOpen(options);
  ASSERT_TRUE(source.ok());
  source_ = std::move(source).value();
  Until([&] { return Next()->stereo != nullptr; });

  right().Unplug();
  Until([&] { return !source_->Status().cameras[1].problem.empty(); });
  EXPECT_EQ(source_->Status().cameras[1].problem, "the cable is out; trying again");
  EXPECT_TRUE(source_->Status().cameras[0].problem.empty());
  for (const double later_s : {0.5, 3.0}) {
    now_s_ = kMonotonicStart_s + later_s;
    left().Give(11, now_s_);
    Until([&] { return left().Waits(); });
    const auto bundle = Next();
    EXPECT_EQ(bundle->stereo, nullptr) << "one picture is no pair";
    EXPECT_EQ(bundle->time, AddSeconds(kStart, later_s)) << "so that ages grow";
    EXPECT_NEAR(source_->Status().cameras[1].age_s, later_s, 1e-6);
  }

  right().Plug();
  right().Give(112, kMonotonicStart_s + 3.04);
  left().Give(12, kMonotonicStart_s + 3.04);
  std::shared_ptr<const FrameBundle> bundle;
  Until([&] { return (bundle = Next())->stereo != nullptr; });
  EXPECT_EQ(bundle->stereo->right.at(0, 0), 112);
  const auto cameras = source_->Status().cameras;
  EXPECT_EQ(cameras[1].reopens, 1u);
  EXPECT_TRUE(cameras[1].problem.empty());
  EXPECT_EQ(right().open_devices(), 1);
}

TEST_F(CameraSourceTest, StopEndsAWait) {
  Open(Options());
  std::stop_source stop;
  std::thread stopper([&] { stop.request_stop(); });
  const auto bundle = source_->Next(stop.get_token());
  stopper.join();
  ASSERT_FALSE(bundle.ok());
  EXPECT_EQ(bundle.error().code, ErrorCode::kEnd);
}

TEST_F(CameraSourceTest, ACameraThatBlocksIsLeftBehind) {
  CameraSourceOptions options = Options();
  options.stop_within_s = 0;
  Open(options);
  Until([&] { return left().Waits() && right().Waits(); });
  source_.reset();  // returns although both reads still wait
  EXPECT_TRUE(left().Waits());
  left().Give(11, kMonotonicStart_s + 1);  // one wakes up later: it finds everything it touches
  right().Close();
  Until([&] { return left().open_devices() == 0 && right().open_devices() == 0; });
}

TEST_F(CameraSourceTest, OneDeviceMayGiveBothHalves) {
  ImageU8 both(2 * film::kWidth, film::kHeight, 30);
  for (int y = 0; y < both.height(); ++y) {
    std::fill(both.row(y) + film::kWidth, both.row(y) + both.width(), std::uint8_t{130});
  }
  CameraSourceOptions options = Options();
  options.open = [this, both](const CameraRequest& request) -> Result<CameraDevice> {
    EXPECT_EQ(request.width, 2 * film::kWidth);
    CameraDevice device;
    device.read = [both, opened = ports_[request.address].Open(),
                   first = true]() mutable -> Result<CameraPicture> {
      if (opened && !std::exchange(first, false)) {
        return opened->read();
      }
      return opened ? Result<CameraPicture>(CameraPicture{both, kMonotonicStart_s})
                    : opened.error();
    };
    return device;
  };
  auto source = TryOpen(options, "left = 1\nside_by_side = true\n");
  ASSERT_TRUE(source.ok()) << source.error().message;
  source_ = std::move(source).value();
  const auto bundle = Next();
  EXPECT_EQ(bundle->stereo->left.width(), film::kWidth);
  EXPECT_EQ(bundle->stereo->left.at(film::kWidth - 1, 5), 30);
  EXPECT_EQ(bundle->stereo->right.at(0, 5), 130);
  EXPECT_EQ(bundle->rig->rate_hz, 30) << "nobody says";
}

TEST_F(CameraSourceTest, OpeningSaysWhatIsWrong) {
  const auto message = [&](const std::string& capture) {
    const auto source = TryOpen(Options(), capture);
    return source.ok() ? std::string() : source.error().message;
  };
  left().Give(10, 0, 32, 24);
  const std::string size = message("left = 1\nright = 2\n");
  EXPECT_NE(size.find("/dev/video1: the picture is 32 x 24 px, RIG.toml says 64 x 48 px"),
            std::string::npos)
      << size;
  left().Give(10, 0);
  right().Give(10, 0, 63, 48);
  EXPECT_NE(message("left = 1\nright = 2\n").find("/dev/video2: the picture is 63 x 48"),
            std::string::npos);
  left().Give(10, 0, 64, 48);
  EXPECT_NE(message("left = 1\nside_by_side = true\n").find("says 128 x 48 px; both halves"),
            std::string::npos);
  EXPECT_NE(message("left = 1\nright = \"right.avi\"\n").find("two files or two live cameras"),
            std::string::npos);
  EXPECT_NE(message("left = 1\nright = 2\nloop = true\n").find("loop is for video files"),
            std::string::npos);
  EXPECT_NE(message("left = \"ftp://a\"\nright = 2\n").find("capture.left: ftp://"),
            std::string::npos);
}

}  // namespace
}  // namespace palace
