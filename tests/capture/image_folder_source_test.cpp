#include "engine/capture/image_folder_source.h"

#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "engine/capture/playback_turns.h"
#include "tests/support/own_path.h"

namespace palace {
namespace {

class ImageFolderTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = OwnPath();
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_ / "pictures");
    WriteRig("[images]\nleft = \"pictures/l*.png\"\nright = \"pictures/r*.png\"\nrate_hz = 4\n");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void WriteRig(const std::string& images) {
    std::string text;
    for (const char* side : {"left", "right"}) {
      text += "[" + std::string(side) +
              "]\nwidth = 32\nheight = 32\nfx_px = 40\nfy_px = 40\ncx_px = 15.5\ncy_px = 15.5\n";
    }
    text += "[rig]\nbaseline_m = 1\n[mount]\ntilt_deg = -90\n";
    text += "[pose]\nroll_deg = 0\npitch_deg = 0\nheading_deg = 0\nheight_m = 12\n";
    std::ofstream(folder_ / "rig.toml") << text << images;
  }
  /// The grey value of a picture tells which one it is.
  void WritePicture(const std::string& name, int grey, int width = 32, int height = 32) {
    cv::imwrite((folder_ / "pictures" / name).string(),
                cv::Mat(height, width, CV_8UC1, cv::Scalar(grey)));
  }
  void WritePairs(int count) {
    for (int k = 0; k < count; ++k) {
      WritePicture("l" + std::to_string(k) + ".png", 10 + k);
      WritePicture("r" + std::to_string(k) + ".png", 110 + k);
    }
  }
  std::unique_ptr<ImageFolderSource> Open(bool loop) {
    auto source = ImageFolderSource::Open(folder_ / "rig.toml", loop);
    EXPECT_TRUE(source.ok()) << source.error().message;
    (*source)->Control({PlaybackControl::Kind::kSpeed, 0});
    return std::move(source).value();
  }

  std::filesystem::path folder_;
};

int Grey(const FrameBundle& bundle) { return bundle.stereo->left.at(0, 0); }

TEST_F(ImageFolderTest, DeliversPairsInOrderWithPoseAndTime) {
  WritePairs(3);
  const auto source = Open(false);
  EXPECT_TRUE(source->IsLockstep());
  for (int k = 0; k < 3; ++k) {
    const auto bundle = source->Next({});
    ASSERT_TRUE(bundle.ok()) << bundle.error().message;
    EXPECT_EQ(Grey(**bundle), 10 + k);
    EXPECT_EQ((*bundle)->stereo->right.at(31, 23), 110 + k);
    EXPECT_EQ((*bundle)->sequence, static_cast<std::uint64_t>(k + 1));
    EXPECT_EQ((*bundle)->time.us, 1'000'000'000'000 + k * 250'000);
    EXPECT_EQ((*bundle)->stereo->time, (*bundle)->time);
    ASSERT_TRUE((*bundle)->pose_at_exposure.has_value());
    EXPECT_EQ((*bundle)->pose_at_exposure->X_WB.p.z(), -12);
    EXPECT_EQ((*bundle)->pose_at_exposure->time, (*bundle)->time);
    EXPECT_FALSE((*bundle)->status) << "a folder of pictures has no vehicle to speak of";
    EXPECT_TRUE((*bundle)->laser.empty());
  }
  const auto end = source->Next({});
  ASSERT_FALSE(end.ok());
  EXPECT_EQ(end.error().code, ErrorCode::kEnd);
  EXPECT_TRUE(source->Status().ended);
  EXPECT_EQ(source->Status().frame_count, 3U);
  EXPECT_EQ(source->Status().duration_s, 0.75);
}

TEST_F(ImageFolderTest, LoopHoldsTheLastPairWhileTimeAdvances) {
  WritePairs(2);
  const auto source = Open(true);
  Timestamp last;
  for (int k = 0; k < 5; ++k) {
    const auto bundle = source->Next({});
    ASSERT_TRUE(bundle.ok());
    EXPECT_EQ(Grey(**bundle), k == 0 ? 10 : 11);
    // Neither "frame 5 of 2" nor "00:01.0 of 00:00.5" may be read of it.
    EXPECT_EQ(source->Status().frame_index, k == 0 ? 1u : 2u);
    EXPECT_LE(source->Status().position_s, source->Status().duration_s);
    EXPECT_EQ((*bundle)->sequence, static_cast<std::uint64_t>(k + 1));
    EXPECT_LT(last, (*bundle)->stereo->time);
    last = (*bundle)->stereo->time;
  }
}

TEST_F(ImageFolderTest, StepsAndSeeksWhilePaused) {
  WritePairs(5);
  const auto source = Open(false);
  ASSERT_TRUE(source->Next({}).ok());
  source->Control({PlaybackControl::Kind::kPause});
  EXPECT_TRUE(source->Status().paused);
  const auto next = [&] {
    const auto bundle = source->Next({});
    return bundle.ok() ? Grey(**bundle) : -1;
  };
  source->Control({PlaybackControl::Kind::kStepForward});
  EXPECT_EQ(next(), 11);
  source->Control({PlaybackControl::Kind::kStepForward});
  EXPECT_EQ(next(), 12);
  source->Control({PlaybackControl::Kind::kStepBack});
  EXPECT_EQ(next(), 11);
  source->Control({PlaybackControl::Kind::kSeek, 1.0});
  EXPECT_EQ(next(), 14);
  source->Control({PlaybackControl::Kind::kSeek, 0});
  EXPECT_EQ(next(), 10);
  source->Control({PlaybackControl::Kind::kPlay});
  EXPECT_EQ(next(), 11);
}

TEST_F(ImageFolderTest, StopEndsAWait) {
  WritePairs(1);
  const auto source = Open(true);
  source->Control({PlaybackControl::Kind::kPause});
  std::stop_source stop;
  std::thread stopper([&] { stop.request_stop(); });
  const auto bundle = source->Next(stop.get_token());
  stopper.join();
  ASSERT_FALSE(bundle.ok());
  EXPECT_EQ(bundle.error().code, ErrorCode::kEnd);
}

TEST_F(ImageFolderTest, ErrorsNameTheFile) {
  const auto message = [&] {
    const auto source = ImageFolderSource::Open(folder_ / "rig.toml", false);
    return source.ok() ? std::string() : source.error().message;
  };
  EXPECT_NE(message().find("pictures/l*.png"), std::string::npos) << message();
  WritePicture("l0.png", 10);
  WritePicture("l1.png", 10);
  WritePicture("r0.png", 10);
  EXPECT_NE(message().find("2 left and 1 right"), std::string::npos) << message();
  WritePicture("r1.png", 10);
  WritePicture("r0.png", 10, 16, 12);
  EXPECT_NE(message().find("r0.png"), std::string::npos) << message();
  WritePicture("l0.png", 10, 16, 12);
  EXPECT_NE(message().find("16 x 12"), std::string::npos) << message();
  std::ofstream(folder_ / "pictures/l0.png") << "no picture";
  EXPECT_NE(message().find("l0.png"), std::string::npos) << message();
  WriteRig("");
  EXPECT_NE(message().find("[images] is missing"), std::string::npos) << message();
}

TEST_F(ImageFolderTest, ASurveyTellsOrderTimesAndPoses) {
  WritePairs(3);
  WriteRig(
      "[images]\nleft = \"pictures/l*.png\"\nright = \"pictures/r*.png\"\n"
      "rate_hz = 4\nposes = \"poses.csv\"\n");
  std::ofstream(folder_ / "poses.csv") << "file,time,north,east,down,roll,pitch,heading\n"
                                          "l2,50,1,0,-20,0,0,90\nl9,51,0,0,-20,0,0,0\n"
                                          "l0,52.5,2,0,-21,0,0,0\nl1,60,3,0,-22,0,0,0\n";
  const auto source = Open(true);
  EXPECT_EQ(source->Status().duration_s, 15) << "with the last pair";
  source->Control({PlaybackControl::Kind::kSeek, 2.5});
  ASSERT_TRUE(source->Next({}).ok());
  EXPECT_EQ(source->Status().position_s, 2.5);
  EXPECT_EQ(source->Status().frame_index, 2u);
  source->Control({PlaybackControl::Kind::kSeek, 0});
  const struct {
    int grey;
    double time_s, north_m;
  } rows[] = {{12, 0, 1}, {10, 2.5, 2}, {11, 10, 3}, {11, 15, 3}};  // the last pair is held
  for (const auto& row : rows) {
    const auto bundle = source->Next({});
    ASSERT_TRUE(bundle.ok()) << bundle.error().message;
    EXPECT_EQ(Grey(**bundle), row.grey);
    EXPECT_EQ((*bundle)->stereo->time, AddSeconds(kRecordedStart, row.time_s));
    EXPECT_EQ((*bundle)->pose_at_exposure->time, (*bundle)->time);
    EXPECT_EQ((*bundle)->pose_at_exposure->X_WB.p.x(), row.north_m);
    EXPECT_EQ((*bundle)->rig->rate_hz, 0.2) << "the mean of the survey";
  }
}

TEST_F(ImageFolderTest, ASurveyThatDoesNotFitThePicturesIsRefused) {
  WritePairs(3);
  WriteRig(
      "[images]\nleft = \"pictures/l*.png\"\nright = \"pictures/r*.png\"\n"
      "poses = \"poses.csv\"\n");
  const auto message = [&] {
    const auto source = ImageFolderSource::Open(folder_ / "rig.toml", false);
    return source.ok() ? std::string() : source.error().message;
  };
  EXPECT_NE(message().find("poses.csv"), std::string::npos) << message();
  std::ofstream(folder_ / "poses.csv") << "file,time,north,east,down,roll,pitch,heading\n"
                                          "l2,50,1,0,-20,0,0,90\nl9,51,0,0,-20,0,0,0\n";
  for (const char* part : {"poses.csv:3: ", "file = l0", "2 of 3 left pictures", "2 rows"}) {
    EXPECT_NE(message().find(part), std::string::npos) << message();
  }
  std::filesystem::rename(folder_ / "pictures/l1.png", folder_ / "pictures/l0.bmp");
  WriteRig(
      "[images]\nleft = \"pictures/l*\"\nright = \"pictures/r*.png\"\n"
      "poses = \"poses.csv\"\n");
  EXPECT_NE(message().find("have one stem"), std::string::npos) << message();
}

TEST_F(ImageFolderTest, AWrongSizeLaterIsAnErrorOfThatPair) {
  WritePairs(2);
  WritePicture("l1.png", 10, 64, 48);
  WritePicture("r1.png", 10, 64, 48);
  const auto source = Open(false);
  EXPECT_TRUE(source->Next({}).ok());
  const auto bundle = source->Next({});
  ASSERT_FALSE(bundle.ok());
  EXPECT_EQ(bundle.error().code, ErrorCode::kInvalid);
  EXPECT_NE(bundle.error().message.find("l1.png"), std::string::npos) << bundle.error().message;
}

}  // namespace
}  // namespace palace
