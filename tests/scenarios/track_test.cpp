// palacectl track as a person runs it: a folder and a film, what it leaves, and what it says where
// somebody errs. How well it follows is tests/tracking/feature_follower_test.cpp.
#include <gmock/gmock.h>

#include <cmath>
#include <sstream>

#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "engine/capture/picture_file.h"
#include "tests/scenarios/scenario.h"
#include "tests/tracking/ground_world.h"

namespace palace {
namespace {

using testing::HasSubstr;

constexpr int kPictures = 30, kBlackFrom = 12, kBlackTo = 18;
const PinholeCamera kCamera{320, 240, 386, 386, 159.5, 119.5};

class Track : public Scenario {
 protected:
  static constexpr double kLimit_s = 30;

  /// 3 px a picture to the left; black for six pictures.
  static ImageU8 PictureAt(GroundWorld& world, int i) {
    RigidTransform X_WC;
    X_WC.R = CameraRotationFromTilt(Rad(-90));
    X_WC.p = {0, 3 * 10 / kCamera.fx_px * i, -10};
    const bool black = i >= kBlackFrom && i < kBlackTo;
    return black ? ImageU8(kCamera.width, kCamera.height) : world.Render(kCamera, X_WC, 2);
  }
  void WriteFolder(const std::string& name, int count = kPictures) const {
    std::filesystem::create_directories(folder_ / name);
    GroundWorld world(5);
    for (int i = 0; i < count; ++i) {
      char file[32];
      std::snprintf(file, sizeof file, "p_%03d.png", i);
      ASSERT_TRUE(WriteGreyPicture(folder_ / name / file, PictureAt(world, i)));
    }
  }
  void WriteFilm(const std::string& name) const {
    cv::VideoWriter film((folder_ / name).string(), cv::CAP_FFMPEG,
                         cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 25,
                         cv::Size(kCamera.width, kCamera.height));
    ASSERT_TRUE(film.isOpened());
    GroundWorld world(5);
    for (int i = 0; i < kPictures; ++i) {
      ImageU8 picture = PictureAt(world, i);
      cv::Mat colour;
      cv::cvtColor(cv::Mat(picture.height(), picture.width(), CV_8U, picture.pixels().data()),
                   colour, cv::COLOR_GRAY2BGR);
      film.write(colour);
    }
  }
  ProcessResult Run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "track");
    return RunProcess(Palacectl(std::move(arguments)), kLimit_s);
  }
  std::string Read(const std::string& name) const {
    std::ifstream file(folder_ / name);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::vector<std::vector<std::string>> Rows(const std::string& csv) const {
    std::vector<std::vector<std::string>> rows;
    std::istringstream text(Read(csv));
    for (std::string line; std::getline(text, line);) {
      std::istringstream fields(line);
      rows.emplace_back();
      for (std::string field; std::getline(fields, field, ',');) {
        rows.back().push_back(field);
      }
    }
    return rows;
  }
};

TEST_F(Track, AFolderIsFollowedAndWhatHappenedIsTold) {
  WriteFolder("in");
  const ProcessResult done =
      Run({"in", "--feature", "200,120", "--out", "out", "--pictures", "10"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(done.err, "");
  EXPECT_THAT(done.out, HasSubstr("feature 200.0,120.0 px, as given"));
  EXPECT_THAT(done.out, HasSubstr("frame 12: LOST, coherence 0.00, limit 0.70\n"));
  EXPECT_THAT(done.out, HasSubstr("frame 18: re-acquired at 146.0,120.0 px, coherence "));
  EXPECT_THAT(done.out, HasSubstr("\n30 pictures, tracked 24, lost 6, re-acquired 1, "));
  EXPECT_THAT(done.out, testing::EndsWith(" ms a picture\n"));
  const auto rows = Rows("out/track.csv");
  ASSERT_EQ(rows.size(), kPictures + 1u);
  EXPECT_EQ(rows[0][0] + "," + rows[0][1] + "," + rows[0][2], "frame,time_s,x_px");
  for (int i = 0; i < kPictures; ++i) {
    const auto& row = rows[static_cast<std::size_t>(i) + 1];
    EXPECT_EQ(row[0], std::to_string(i));
    EXPECT_EQ(row[1], "") << "files have no time";
    const bool black = i >= kBlackFrom && i < kBlackTo;
    EXPECT_EQ(row[5], black ? "LOST" : i == kBlackTo ? "re-acquired" : "followed") << i;
    EXPECT_NEAR(std::stod(row[2]), 200 - 3 * i, black ? 1 : 0.2) << i;
  }
  for (const char* file : {"frame_000000.png", "frame_000010.png", "frame_000012.png",
                           "frame_000018.png", "frame_000020.png", "frame_000029.png"}) {
    const auto picture = ReadGreyPicture(folder_ / "out" / file);
    ASSERT_TRUE(picture.ok()) << picture.error().message;
    EXPECT_EQ(picture->width(), kCamera.width);
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/frame_000011.png"));
  const std::string page = Read("out/report.html");
  EXPECT_THAT(page, HasSubstr("30 pictures, tracked 24, lost 6, re-acquired 1, "));
  EXPECT_THAT(page, HasSubstr("limit 0.70"));
  EXPECT_THAT(page, HasSubstr("<svg"));
  EXPECT_THAT(page, HasSubstr("data:image/jpeg"));
  const ProcessResult again = Run({"in", "--out", "out"});
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_THAT(again.err, HasSubstr("out holds a track already; choose another --out"));
}

TEST_F(Track, AFilmIsFollowedFromThePlaceThatIsSelected) {
  WriteFilm("film.avi");
  const ProcessResult done = Run({"film.avi", "--out", "out"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr(" px, selected; the place most like it"));
  const auto rows = Rows("out/track.csv");
  ASSERT_EQ(rows.size(), kPictures + 1u);
  EXPECT_NEAR(std::stod(rows[11][1]), 0.4, 1e-3);
  EXPECT_NEAR(std::stod(rows[11][2]), std::stod(rows[1][2]) - 30, 0.5);
  const ProcessResult some = Run({"film.avi", "--frames", "5"});
  EXPECT_EQ(some.exit_code, 0) << some.err;
  EXPECT_THAT(some.out, HasSubstr("\n5 pictures, tracked 5, lost 0, re-acquired 0, "));
}

TEST_F(Track, MistakesAreNamedWithTheRemedy) {
  WriteFolder("in", 2);
  WriteFolder("mixed", 2);
  ASSERT_TRUE(WriteGreyPicture(folder_ / "mixed/q.png", ImageU8(64, 48, 9)));
  std::filesystem::create_directories(folder_ / "empty");
  std::filesystem::create_directories(folder_ / "even");
  ASSERT_TRUE(WriteGreyPicture(folder_ / "even/a.png", ImageU8(320, 240, 90)));
  WriteFile("notes.avi", "no film");
  const struct {
    std::vector<std::string> arguments;
    int exit_code;
    const char* said;
  } rows[] = {
      {{}, 2, "SOURCE is required"},
      {{"none.avi"}, 1, "none.avi: no such video file; check the name"},
      {{"notes.avi"}, 1, "notes.avi: this is text, no video"},
      {{"empty"}, 1, "empty: holds no pictures; give a folder of PNG, JPEG, TIFF or PGM files"},
      {{"even"}, 1, "even: the first picture, 320 x 240 px, has no place for a template of 41 px"},
      {{"even", "--feature", "160,120"}, 2, "feature 160,120: the picture is too even there"},
      {{"mixed"}, 1, "mixed: frame 2 is 64 x 48 px, the first was 320 x 240 px"},
      {{"/dev/video99"}, 1, "/dev/video99: no such camera"},
      {{"in", "--feature", "319,120"},
       2,
       "feature 319,120: a template of 41 px needs x 20 to 299 px, y 20 to 219 px in a picture of "
       "320 x 240 px"},
      {{"in", "--feature", "12"}, 2, "--feature 12: must be X,Y in pixels, e.g. 320,240"},
      {{"in", "--feature", "nan,3"}, 2, "--feature nan,3: must be X,Y in pixels"},
      {{"in", "--template", "40"}, 2, "template 40 px: must be odd, 11 to 101 px"},
      {{"in", "--template", "201"}, 2, "--template"},
      {{"in", "--search", "1"}, 2, "--search"},
      {{"in", "--min-coherence", "nan"}, 2, "--min-coherence: nan is not within 0.1 to 0.99"},
      {{"in", "--frames", "0"}, 2, "--frames"},
      {{"in", "--pictures", "2"}, 2, "--pictures needs --out"},
      {{"in", "--size", "big"}, 2, "--size big: must be WIDTHxHEIGHT"},
      {{"in", "--out", "notes.avi/x"}, 1, "notes.avi"},
      {{"in", "--fast"}, 2, "track has no option --fast"}};
  for (const auto& row : rows) {
    const ProcessResult done = Run(row.arguments);
    EXPECT_EQ(done.exit_code, row.exit_code) << row.said << "\n" << done.out << done.err;
    EXPECT_THAT(done.err, HasSubstr(row.said));
    EXPECT_THAT(done.err, testing::StartsWith("palacectl"));
  }
}

/// Whole, then with the last part of its bytes gone: as when a card was pulled.
TEST_F(Track, AFilmThatEndsBeforeItsCountSaysSo) {
  WriteFilm("film.avi");
  const ProcessResult whole = Run({"film.avi", "--out", "whole"});
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  EXPECT_EQ(whole.err.find("cut short"), std::string::npos) << whole.err;
  const std::string bytes = Read("film.avi");
  WriteFile("cut.avi", bytes.substr(0, bytes.size() / 2));
  const ProcessResult cut = Run({"cut.avi", "--out", "cut"});
  EXPECT_EQ(cut.exit_code, 0) << cut.err;
  EXPECT_THAT(cut.err, HasSubstr("of the 30 pictures that it announces; it may be cut short"));
  EXPECT_THAT(Read("cut/report.html"), HasSubstr("of the 30 pictures that it announces"));
  const ProcessResult asked = Run({"cut.avi", "--frames", "5", "--out", "five"});
  EXPECT_EQ(asked.err.find("cut short"), std::string::npos) << asked.err;
}

}  // namespace
}  // namespace palace
