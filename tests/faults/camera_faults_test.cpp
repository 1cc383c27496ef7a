#include "engine/faults/camera_faults.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>

#include "tests/faults/fault_rig.h"

namespace palace {
namespace {

constexpr double kFrom_s = 0.5;

/// Ten frames of 0.1 s under one fault that begins at 0.5 s.
std::vector<std::shared_ptr<const StereoFrame>> Struck(FaultKind kind,
                                                       std::optional<ChannelId> channel = {},
                                                       double value = NAN) {
  CameraFaults faults(7);
  std::vector<std::shared_ptr<const StereoFrame>> frames;
  for (int i = 0; i < 10; ++i) {
    frames.push_back(faults.Apply(BundleOfEverything(i).stereo,
                                  {{kind, channel, value, kFrom_s - 1e-9}}, 0.1 * i));
  }
  return frames;
}

ImageU8 Left(int i) { return BundleOfEverything(i).stereo->left; }
ImageU8 Right(int i) { return BundleOfEverything(i).stereo->right; }

int Different(const ImageU8& a, const ImageU8& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    count += a.pixels()[i] != b.pixels()[i] ? 1 : 0;
  }
  return count;
}

TEST(CameraFaults, LeaveFramesBeforeTheFaultAndTheOtherCameraAlone) {
  for (std::size_t k = 0; k <= static_cast<std::size_t>(FaultKind::kCameraLate); ++k) {
    const auto frames = Struck(static_cast<FaultKind>(k), ChannelId::kCameraRight);
    for (int i = 0; i < 10; ++i) {
      const StereoFrame& frame = *frames[static_cast<std::size_t>(i)];
      EXPECT_EQ(frame.left.pixels(), Left(i).pixels()) << FaultKindTable()[k].name << " " << i;
      if (i != 5) {  // the first frozen picture is the picture itself
        EXPECT_EQ(frame.right.pixels() == Right(i).pixels(), i < 5) << FaultKindTable()[k].name;
      }
      EXPECT_EQ(frame.time, BundleOfEverything(i).stereo->time);
    }
  }
}

TEST(CameraFaults, FrozenRepeatsThePictureOfTheFirstMoment) {
  const auto exact = Struck(FaultKind::kCameraFrozen);
  const auto pixel = Struck(FaultKind::kCameraFrozenPixel);
  const auto noise = Struck(FaultKind::kCameraFrozenNoise, {}, 1);
  for (std::size_t i = 6; i < 10; ++i) {
    EXPECT_EQ(exact[i]->left.pixels(), Left(5).pixels());
    EXPECT_EQ(exact[i]->right.pixels(), Right(5).pixels());
    EXPECT_LE(Different(pixel[i]->left, Left(5)), 1);
    EXPECT_GT(Different(noise[i]->left, Left(5)), 300);
    for (std::size_t p = 0; p < noise[i]->left.pixels().size(); ++p) {
      EXPECT_LE(std::abs(noise[i]->left.pixels()[p] - Left(5).pixels()[p]), 1);
    }
  }
  EXPECT_NE(pixel[6]->left.pixels(), pixel[8]->left.pixels());
}

TEST(CameraFaults, AnotherFreezeFreezesAnotherPicture) {
  CameraFaults faults(7);
  const std::vector<Fault> twice = {{.kind = FaultKind::kCameraFrozen, .from_s = 0.2, .to_s = 0.4},
                                    {.kind = FaultKind::kCameraFrozen, .from_s = 0.6}};
  std::shared_ptr<const StereoFrame> frame;
  for (int i = 0; i < 10; ++i) {
    frame = faults.Apply(BundleOfEverything(i).stereo, twice, 0.1 * i + 1e-9);
  }
  EXPECT_EQ(frame->left.pixels(), Left(6).pixels());
}

TEST(CameraFaults, BlackDarkAndBrightAreThat) {
  const auto mean = [](const ImageU8& picture) {
    double sum = 0;
    for (const std::uint8_t grey : picture.pixels()) {
      sum += grey;
    }
    return sum / static_cast<double>(picture.pixels().size());
  };
  EXPECT_EQ(mean(Struck(FaultKind::kCameraBlack)[8]->right), 0);
  const ImageU8 dark = Struck(FaultKind::kCameraDark)[8]->right;
  EXPECT_LT(mean(dark), 5);
  EXPECT_GT(Different(dark, ImageU8(dark.width(), dark.height())), 300) << "noise stays";
  EXPECT_GT(mean(Struck(FaultKind::kCameraOverexposed)[8]->left), 190);
}

TEST(CameraFaults, ARepeatedPictureIsTheOneShownBefore) {
  CameraFaults faults(7);
  const std::vector<Fault> third = {
      {.kind = FaultKind::kCameraRepeated, .channel = ChannelId::kCameraLeft, .value = 30}};
  constexpr int kFrames = 1000;
  int repeated = 0;
  ImageU8 shown;
  for (int i = 0; i < kFrames; ++i) {
    const auto frame = faults.Apply(BundleOfEverything(i).stereo, third, 0.1 * i);
    EXPECT_EQ(frame->right.pixels(), Right(i).pixels());
    EXPECT_EQ(frame->time, BundleOfEverything(i).stereo->time) << "stamps advance";
    if (frame->left.pixels() == Left(i).pixels()) {
      shown = frame->left;
    } else {
      EXPECT_EQ(frame->left.pixels(), shown.pixels()) << i;
      ++repeated;
    }
  }
  EXPECT_NEAR(repeated, 0.3 * kFrames, 4 * std::sqrt(0.3 * 0.7 * kFrames));
}

TEST(CameraFaults, DirtStaysWhereItIsAndTakesTwoThirdsOfTheLightFromItsShare) {
  for (const double percent : {0.0, 10.0, 37.5, 100.0}) {
    const auto frames = Struck(FaultKind::kCameraDirt, ChannelId::kCameraLeft, percent);
    std::vector<bool> covered;
    for (const int i : {6, 9}) {
      const ImageU8& dirty = frames[static_cast<std::size_t>(i)]->left;
      std::vector<bool> now;
      for (std::size_t p = 0; p < dirty.pixels().size(); ++p) {
        now.push_back(dirty.pixels()[p] != Left(i).pixels()[p]);
        if (now.back()) {
          EXPECT_EQ(dirty.pixels()[p], std::lround(Left(i).pixels()[p] / 3.0));
        }
      }
      EXPECT_EQ(std::count(now.begin(), now.end(), true),
                std::lround(percent / 100 * static_cast<double>(now.size())));
      EXPECT_TRUE(covered.empty() || covered == now);
      covered = now;
    }
    EXPECT_EQ(frames[9]->right.pixels(), Right(9).pixels());
  }
}

TEST(CameraFaults, GlareGrowsEvenlyToTheRightEdge) {
  const ImageU8 glaring = Struck(FaultKind::kCameraGlare, ChannelId::kCameraLeft, 93)[9]->left;
  for (int y = 0; y < glaring.height(); ++y) {
    for (int x = 0; x < glaring.width(); ++x) {
      EXPECT_EQ(glaring.at(x, y), Left(9).at(x, y) + 3 * x) << "93 grey levels over 31 steps";
    }
  }
  const ImageU8 blinding = Struck(FaultKind::kCameraGlare, {}, 255)[9]->right;
  EXPECT_EQ(blinding.at(blinding.width() - 1, 0), 255);
}

TEST(CameraFaults, LateContentKeepsItsStampAndSwappedCamerasChangePlaces) {
  const auto late = Struck(FaultKind::kCameraLate, ChannelId::kCameraLeft, 0.3);
  EXPECT_EQ(late[8]->left.pixels(), Left(5).pixels());
  EXPECT_EQ(late[8]->right.pixels(), Right(8).pixels());
  const auto swapped = Struck(FaultKind::kCamerasSwapped);
  EXPECT_EQ(swapped[8]->left.pixels(), Right(8).pixels());
  EXPECT_EQ(swapped[8]->right.pixels(), Left(8).pixels());
}

}  // namespace
}  // namespace palace
