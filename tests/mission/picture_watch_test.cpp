// What single pairs say against the cameras, and when it stands.
#include "engine/mission/watch/picture_watch.h"

#include <string>

#include <gtest/gtest.h>

#include "engine/mission/limits.h"

namespace palace {
namespace {

// One odd pair is chance, and one good pair is no cure.
TEST(PictureWatch, AFaultStandsAfterThreePairsAndGoesTheSameWay) {
  StereoQuality bad, good;
  bad.suspect_swapped = true;
  bad.row_error_px = good.row_error_px = AlarmLimits::row_error_px;
  PictureWatch watch;
  const auto feed = [&](const StereoQuality& pair) {
    watch.Update(JudgePictures(pair, SessionRole::kLive));
    return watch.standing().words();
  };
  EXPECT_EQ(feed(bad), "");
  EXPECT_EQ(feed(bad), "");
  EXPECT_EQ(feed(good), "");
  const char* const exchanged = "Left and right camera look exchanged";
  for (const char* expected : {"", "", exchanged}) {
    EXPECT_EQ(feed(bad), expected);
  }
  for (const char* expected : {exchanged, exchanged, ""}) {
    EXPECT_EQ(feed(good), expected);
  }
}

// 30 % of a camera's pictures: seldom three in a row, and never twenty without.
TEST(PictureWatch, ACameraThatRepeatsNowAndThenIsNamedAndStaysNamed) {
  StereoQuality repeats, good;
  repeats.left_frozen = true;
  PictureWatch watch;
  const auto feed = [&](const StereoQuality& pair) {
    watch.Update(JudgePictures(pair, SessionRole::kLive));
    return watch.standing().words();
  };
  const char* const named = "Left camera repeats its picture";
  for (int round = 0; round < 10; ++round) {
    for (int k = 0; k < 4; ++k) {
      const std::string words = feed(k == 0 ? repeats : good);
      EXPECT_EQ(words, round >= 2 ? named : "") << round << " " << k;
    }
  }
  for (int k = 0; k < 12; ++k) {
    EXPECT_EQ(feed(good), named) << k << " good ones";
  }
  for (int k = 12; k < 18; ++k) {
    feed(good);
  }
  EXPECT_EQ(feed(good), "");
  for (int k = 0; k < 100; ++k) {
    EXPECT_EQ(feed(k % 6 == 0 ? repeats : good), "") << "one or two of ten are chance";
  }
}

// The camera that fails is named; what a black one shows is not that it repeats itself.
TEST(PictureWatch, NamesTheCamera) {
  struct Row {
    bool left_frozen, right_frozen, left_blank, right_blank;
    const char* words;
  };
  for (const Row& row : {Row{true, false, false, false, "Left camera repeats its picture"},
                         Row{false, true, false, false, "Right camera repeats its picture"},
                         Row{true, true, false, false, "Both cameras repeat their pictures"},
                         Row{false, true, false, true, "Right camera shows nothing"},
                         Row{true, true, true, true, "Both cameras show nothing"}}) {
    StereoQuality quality;
    quality.left_frozen = row.left_frozen;
    quality.right_frozen = row.right_frozen;
    quality.left_blank = row.left_blank;
    quality.right_blank = row.right_blank;
    EXPECT_EQ(JudgePictures(quality, SessionRole::kSimulated).words(), row.words);
    EXPECT_FALSE(JudgePictures(quality, SessionRole::kPictures).frozen());
  }
}

}  // namespace
}  // namespace palace
