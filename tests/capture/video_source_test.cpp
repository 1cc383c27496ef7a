// Filmed pairs, through OpenCV's real decoders, on files that the test writes: Motion JPEG in AVI.
// A uniform picture keeps its grey through that codec to one level or so.
#include "engine/capture/video_source.h"

#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "engine/capture/cameras.h"
#include "engine/core/random.h"
#include "tests/capture/film.h"

namespace palace {
namespace {

constexpr const char* kTwo = "left = \"left.avi\"\nright = \"right.avi\"\n";

class VideoSourceTest : public film::FilmTest {
 protected:
  void WriteFilms(film::Film left = {}, film::Film right = {.first_grey = 120}) const {
    film::Write(folder_ / "left.avi", left);
    film::Write(folder_ / "right.avi", right);
  }
  std::unique_ptr<Source> Open(const std::string& capture = kTwo, bool wait_at_end = false) const {
    auto source = OpenCameras(WriteRig(capture), wait_at_end);
    EXPECT_TRUE(source.ok()) << source.error().message;
    (*source)->Control({PlaybackControl::Kind::kSpeed, 0});
    return std::move(source).value();
  }
  std::string Refusal(const std::string& capture) const {
    const auto source = OpenCameras(WriteRig(capture), false);
    return source.ok() ? "was opened" : source.error().message;
  }
};

std::shared_ptr<const FrameBundle> Next(Source& source) {
  auto bundle = source.Next({});
  return bundle ? *bundle : nullptr;
}

void ExpectGrey(const ImageU8& image, int grey) {
  EXPECT_NEAR(image.at(3, 3), grey, 2);
  EXPECT_NEAR(image.at(image.width() - 4, image.height() - 4), grey, 2);
}

TEST_F(VideoSourceTest, GivesEveryPairInOrderAndEnds) {
  WriteFilms();
  const auto source = Open();
  EXPECT_TRUE(source->IsLockstep());
  for (int k = 0; k < 10; ++k) {
    const auto bundle = Next(*source);
    ASSERT_NE(bundle, nullptr) << k;
    ExpectGrey(bundle->stereo->left, 20 + 10 * k);
    ExpectGrey(bundle->stereo->right, 120 + 10 * k);
    EXPECT_EQ(bundle->time.us, kRecordedStart.us + 40'000 * k) << "25 pictures a second";
    EXPECT_EQ(bundle->stereo->time, bundle->time);
    EXPECT_EQ(bundle->sequence, static_cast<std::uint64_t>(k + 1));
    EXPECT_EQ(bundle->rig->rate_hz, 25);
    EXPECT_FALSE(bundle->discontinuity);
    ASSERT_TRUE(bundle->pose_at_exposure.has_value());
    EXPECT_FALSE(bundle->status) << "there is no vehicle";
  }
  const auto end = source->Next({});
  ASSERT_FALSE(end.ok());
  EXPECT_EQ(end.error().code, ErrorCode::kEnd);
  const SourceStatus status = source->Status();
  EXPECT_EQ(status.kind, SourceKind::kVideo);
  EXPECT_TRUE(status.ended);
  EXPECT_EQ(status.frame_count, 10u);
  ASSERT_EQ(status.cameras.size(), 2u);
  EXPECT_EQ(status.cameras[1].frames, 10u);
  EXPECT_EQ(status.cameras[1].unpaired, 0u);
  EXPECT_EQ(status.cameras[1].problem, "");
}

TEST_F(VideoSourceTest, TheSameFilesGiveTheSameBundles) {
  WriteFilms();
  const auto once = Open(), again = Open();
  for (int k = 0; k < 10; ++k) {
    const auto a = Next(*once), b = Next(*again);
    ASSERT_TRUE(a && b);
    EXPECT_EQ(a->time, b->time);
    EXPECT_EQ(a->stereo->left.pixels(), b->stereo->left.pixels());
    EXPECT_EQ(a->stereo->right.pixels(), b->stereo->right.pixels());
  }
}

TEST_F(VideoSourceTest, ColourBecomesLuma) {
  // BT.601: 0.299 R + 0.587 G + 0.114 B.
  for (const char* name : {"left.avi", "right.avi"}) {
    cv::VideoWriter writer((folder_ / name).string(), cv::CAP_FFMPEG,
                           cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 25, cv::Size(64, 48));
    writer.write(cv::Mat(48, 64, CV_8UC3, cv::Scalar(40, 120, 200)));  // B, G, R
  }
  const auto bundle = Next(*Open());
  ASSERT_NE(bundle, nullptr);
  EXPECT_NEAR(bundle->stereo->left.at(20, 20), 0.299 * 200 + 0.587 * 120 + 0.114 * 40, 4);
}

TEST_F(VideoSourceTest, FilmsOfDifferentRatePairByTime) {
  WriteFilms({.pictures = 10, .rate_hz = 20, .first_grey = 20},
             {.pictures = 5, .rate_hz = 10, .first_grey = 120});
  const auto source = Open();
  for (int k = 0; k < 5; ++k) {
    const auto bundle = Next(*source);
    ASSERT_NE(bundle, nullptr) << k;
    ExpectGrey(bundle->stereo->left, 20 + 20 * k);
    ExpectGrey(bundle->stereo->right, 120 + 10 * k);
    EXPECT_EQ(bundle->time.us, kRecordedStart.us + 100'000 * k);
  }
  EXPECT_EQ(Next(*source), nullptr);
  EXPECT_GE(source->Status().cameras[0].unpaired, 4u);
  EXPECT_EQ(source->Status().cameras[1].unpaired, 0u);
}

TEST_F(VideoSourceTest, OneFilmMayHoldBothHalves) {
  film::Write(folder_ / "both.avi", {.width = 128, .right_half_grey = 120});
  const auto source = Open("left = \"both.avi\"\nside_by_side = true\n");
  for (int k = 0; k < 10; ++k) {
    const auto bundle = Next(*source);
    ASSERT_NE(bundle, nullptr) << k;
    EXPECT_EQ(bundle->stereo->left.width(), 64);
    ExpectGrey(bundle->stereo->left, 20 + 10 * k);
    ExpectGrey(bundle->stereo->right, 120 + 10 * k);
  }
  EXPECT_EQ(Next(*source), nullptr);
}

TEST_F(VideoSourceTest, StepsAndSeeksWhilePaused) {
  WriteFilms({.pictures = 60, .first_grey = 10, .step_grey = 3},
             {.pictures = 60, .first_grey = 10, .step_grey = 3});
  const auto source = Open();
  ASSERT_NE(Next(*source), nullptr);
  source->Control({PlaybackControl::Kind::kPause});
  const auto expect_next = [&](int index, bool jump) {
    const auto bundle = Next(*source);
    ASSERT_NE(bundle, nullptr) << index;
    EXPECT_NEAR(bundle->stereo->left.at(5, 5), 10 + 3 * index, 2) << index;
    EXPECT_EQ(bundle->time.us, kRecordedStart.us + 40'000 * index);
    EXPECT_EQ(bundle->discontinuity, jump) << index;
  };
  source->Control({PlaybackControl::Kind::kStepForward});
  expect_next(1, false);
  source->Control({PlaybackControl::Kind::kStepForward});
  expect_next(2, false);
  source->Control({PlaybackControl::Kind::kStepBack});
  expect_next(1, true);
  source->Control({PlaybackControl::Kind::kSeek, 2.0});
  expect_next(50, true);
  source->Control({PlaybackControl::Kind::kStepBack});
  expect_next(49, true);
  source->Control({PlaybackControl::Kind::kSeek, 0.0});
  expect_next(0, true);
  source->Control({PlaybackControl::Kind::kPlay});
  expect_next(1, false);
  source->Control({PlaybackControl::Kind::kSeek, 1e9});
  expect_next(59, true);
}

TEST_F(VideoSourceTest, LoopBeginsAgainWhileTimeRunsOn) {
  WriteFilms({.pictures = 3}, {.pictures = 3, .first_grey = 120});
  const auto source = Open(std::string(kTwo) + "loop = true\n");
  for (int k = 0; k < 8; ++k) {
    const auto bundle = Next(*source);
    ASSERT_NE(bundle, nullptr) << k;
    ExpectGrey(bundle->stereo->left, 20 + 10 * (k % 3));
    EXPECT_EQ(bundle->time.us, kRecordedStart.us + 40'000 * k);
    EXPECT_EQ(bundle->discontinuity, k == 3 || k == 6) << "the view jumps back";
  }
}

TEST_F(VideoSourceTest, AtTheEndItMayWaitForASeek) {
  WriteFilms({.pictures = 2}, {.pictures = 2, .first_grey = 120});
  const auto source = Open(kTwo, /*wait_at_end=*/true);
  ASSERT_NE(Next(*source), nullptr);
  ASSERT_NE(Next(*source), nullptr);
  std::shared_ptr<const FrameBundle> bundle;
  std::thread reader([&] { bundle = Next(*source); });
  while (!source->Status().ended) {
    std::this_thread::yield();
  }
  source->Control({PlaybackControl::Kind::kSeek, 0});
  reader.join();
  ASSERT_NE(bundle, nullptr);
  ExpectGrey(bundle->stereo->left, 20);
  ASSERT_NE(Next(*source), nullptr);
  std::stop_source stop;
  std::thread stopper([&] { stop.request_stop(); });
  EXPECT_FALSE(source->Next(stop.get_token()).ok());
  stopper.join();
}

TEST_F(VideoSourceTest, WhatIsNoVideoIsSaid) {
  WriteFilms();
  const auto left_is = [&](const std::string& name) {
    return Refusal("left = \"" + name + "\"\nright = \"right.avi\"\n");
  };
  std::ofstream(folder_ / "notes.avi") << std::string(5000, 'x');
  std::ofstream(folder_ / "empty.avi");
  std::filesystem::create_directory(folder_ / "folder.avi");
  std::ofstream(folder_ / "noise.avi", std::ios::binary)
      << std::string("\0\1\2RIFF-less\xff\xfe bytes", 20) + std::string(4000, '\3');
  film::Write(folder_ / "none.avi", {.pictures = 0});
  film::Write(folder_ / "small.avi", {.width = 32, .height = 24});
  const std::pair<const char*, const char*> rows[] = {
      {"missing.avi", "missing.avi: no such video file"},
      {"notes.avi", "notes.avi: this is text, no video"},
      {"empty.avi", "empty.avi: the file is empty"},
      {"folder.avi", "folder.avi: this is no file"},
      {"noise.avi", "noise.avi: this is no video that can be decoded"},
      {"none.avi", "none.avi: "},
      {"small.avi", "small.avi: the picture is 32 x 24 px, RIG.toml says 64 x 48 px"},
  };
  for (const auto& [name, said] : rows) {
    EXPECT_NE(left_is(name).find(said), std::string::npos) << left_is(name);
  }
  EXPECT_NE(Refusal("left = \"http://127.0.0.1:9/x\"\nright = \"http://127.0.0.1:9/y\"\n")
                .find("http://127.0.0.1:9/x: no stream there"),
            std::string::npos)
      << "port 9 of this machine is closed";
  EXPECT_NE(Refusal("left = 254\nright = 255\n").find("/dev/video254: no such camera"),
            std::string::npos);
}

TEST_F(VideoSourceTest, FilmsThatNeverMeetAreRefused) {
  WriteFilms({.pictures = 4}, {.pictures = 4, .first_grey = 120});  // 40 ms apart
  OpenCamera late = [](const CameraRequest& request) -> Result<CameraDevice> {
    auto device = OpenWithOpenCv(request);
    if (device && request.address.find("right") != std::string::npos) {
      device->read = [read = device->read]() -> Result<CameraPicture> {
        auto picture = read();
        if (picture) {
          picture->time_s += 0.015;
        }
        return picture;
      };
    }
    return device;
  };
  const auto source =
      OpenCameras(WriteRig(std::string(kTwo) + "pair_tolerance_ms = 5\n"), false, late);
  ASSERT_FALSE(source.ok());
  EXPECT_NE(source.error().message.find("within 5 ms"), std::string::npos)
      << source.error().message;
  EXPECT_NE(source.error().message.find("pair_tolerance_ms"), std::string::npos);
}

TEST_F(VideoSourceTest, AnotherSizeMidStreamIsAnErrorThatNamesBoth) {
  WriteFilms();
  OpenCamera shrinking = [](const CameraRequest& request) -> Result<CameraDevice> {
    auto device = OpenWithOpenCv(request);
    if (device) {
      device->read = [read = device->read, left = 5]() mutable -> Result<CameraPicture> {
        auto picture = read();
        if (picture && left-- <= 0) {
          picture->grey = ImageU8(32, 24);
        }
        return picture;
      };
    }
    return device;
  };
  auto source = OpenCameras(WriteRig(kTwo), false, shrinking);
  ASSERT_TRUE(source.ok());
  (*source)->Control({PlaybackControl::Kind::kSpeed, 0});
  for (int k = 0; k < 5; ++k) {
    ASSERT_NE(Next(**source), nullptr) << k;
  }
  const auto sixth = (*source)->Next({});
  ASSERT_FALSE(sixth.ok());
  EXPECT_EQ(sixth.error().code, ErrorCode::kInvalid);
  EXPECT_NE(
      sixth.error().message.find("left.avi: the picture is 32 x 24 px, RIG.toml says 64 x 48 px"),
      std::string::npos)
      << sixth.error().message;
}

/// FFmpeg behind OpenCV keeps the first size, whatever follows: no more than that is promised here.
TEST_F(VideoSourceTest, AStreamThatChangesItsSizeGivesThePromisedSizeOrNothing) {
  for (const char* name : {"left.mjpeg", "right.mjpeg"}) {
    std::ofstream film(folder_ / name, std::ios::binary);
    for (int k = 0; k < 12; ++k) {
      const int scale = k < 4 ? 2 : k < 8 ? 1 : 4;
      std::vector<unsigned char> jpeg;
      cv::imencode(".jpg", cv::Mat(24 * scale, 32 * scale, CV_8UC3, cv::Scalar::all(90)), jpeg);
      film.write(reinterpret_cast<const char*>(jpeg.data()),
                 static_cast<std::streamsize>(jpeg.size()));
    }
  }
  const auto source = Open("left = \"left.mjpeg\"\nright = \"right.mjpeg\"\n");
  for (int pairs = 0; pairs < 100; ++pairs) {
    const auto bundle = source->Next({});
    if (!bundle) {
      return;
    }
    ASSERT_EQ((*bundle)->stereo->left.width(), 64);
    ASSERT_EQ((*bundle)->stereo->left.height(), 48);
    ASSERT_EQ((*bundle)->time, AddSeconds(kRecordedStart, pairs / (*bundle)->rig->rate_hz))
        << "without stamps it goes by the beat";
  }
  FAIL() << "no end";
}

TEST_F(VideoSourceTest, AFilmCutShortEndsAndSaysSo) {
  WriteFilms({.pictures = 40, .step_grey = 2}, {.pictures = 40, .step_grey = 2});
  const auto path = folder_ / "left.avi";
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  const auto source = Open();
  int pairs = 0;
  while (Next(*source)) {
    ++pairs;
  }
  EXPECT_GT(pairs, 5);
  EXPECT_LT(pairs, 40);
  const SourceStatus status = source->Status();
  EXPECT_TRUE(status.ended);
}

/// Any damage gives pictures, an end or an error; never a crash, never a picture of another size.
TEST_F(VideoSourceTest, DamagedFilmsNeverCrash) {
  WriteFilms({.pictures = 6}, {.pictures = 6, .first_grey = 120});
  std::ifstream file(folder_ / "left.avi", std::ios::binary);
  const std::string good((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomStream random(seed, "damage");
    std::string bytes = good;
    for (int k = 0; k < 12; ++k) {
      const int range = k < 4 ? 300 : static_cast<int>(bytes.size());  // some in the header
      bytes[static_cast<std::size_t>(random.Index(range))] = static_cast<char>(random.Index(256));
    }
    if (seed % 3 == 0) {
      bytes.resize(static_cast<std::size_t>(random.Index(static_cast<int>(bytes.size()))));
    }
    std::ofstream(folder_ / "left.avi", std::ios::binary) << bytes;
    const auto source = OpenCameras(WriteRig(kTwo), false);
    if (!source) {
      EXPECT_FALSE(source.error().message.empty());
      continue;
    }
    (*source)->Control({PlaybackControl::Kind::kSpeed, 0});
    for (int pairs = 0; pairs < 100; ++pairs) {
      const auto bundle = (*source)->Next({});
      if (!bundle) {
        break;
      }
      ASSERT_EQ((*bundle)->stereo->left.width(), 64);
      ASSERT_EQ((*bundle)->stereo->left.height(), 48);
    }
  }
}

}  // namespace
}  // namespace palace
