// Stereo cameras without a vehicle, through the program: films that the test renders and writes,
// and what is said of cameras that cannot be used. Live devices are scripted in tests/capture.
#include <array>
#include <sstream>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "engine/camera/pinhole.h"
#include "engine/world/ray_pictures.h"
#include "tests/scenarios/scenario.h"

namespace palace {
namespace {

constexpr double kHeight_m = 15.24;  // 50 ft
constexpr double kNadir_rad = -1.57079632679489662;
constexpr int kPictures = 24;
constexpr double kRate_hz = 10;

class Cameras : public Scenario {
 protected:
  Cameras() : camera_(PinholeFromFov(640, 480, 0.785398163397448)) {}

  /// Lossless, so that what is measured is not the codec.
  void WriteFilm(const std::string& name, const std::vector<ImageU8>& pictures) const {
    const ImageU8& first = pictures.front();
    cv::VideoWriter writer((folder_ / name).string(), cv::CAP_FFMPEG,
                           cv::VideoWriter::fourcc('F', 'F', 'V', '1'), kRate_hz,
                           cv::Size(first.width(), first.height()));
    ASSERT_TRUE(writer.isOpened());
    for (const ImageU8& picture : pictures) {
      cv::Mat colour;
      cv::cvtColor(cv::Mat(picture.height(), picture.width(), CV_8UC1,
                           const_cast<std::uint8_t*>(picture.pixels().data())),
                   colour, cv::COLOR_GRAY2BGR);
      writer.write(colour);
    }
  }
  /// A ground with five boxes, seen from 50 ft, with fresh sensor noise in every picture.
  void WriteFilms() const {
    World world;
    for (const auto& [north_m, east_m, side_m, height_m] : {std::array{-2.5, -2.0, 1.0, 0.6},
                                                            {2.5, 3.0, 0.8, 0.5},
                                                            {-3.0, 2.5, 0.5, 0.35},
                                                            {3.2, -3.0, 0.6, 0.4},
                                                            {0.5, -4.0, 0.4, 0.3}}) {
      world.solids.push_back(MakeBox(north_m, east_m, side_m, side_m, height_m));
    }
    const StereoView view = ViewFrom(world, camera_, kHeight_m, kNadir_rad, 2);
    std::vector<ImageU8> left, right;
    for (std::uint64_t k = 0; k < kPictures; ++k) {
      left.push_back(Expose(view.left_grey, {}, 100 + 2 * k));
      right.push_back(Expose(view.right_grey, {}, 101 + 2 * k));
    }
    WriteFilm("left.avi", left);
    WriteFilm("right.avi", right);
  }
  std::string RigText(bool pose) const {
    std::ostringstream text;
    for (const char* side : {"left", "right"}) {
      text << "[" << side << "]\nwidth = 640\nheight = 480\nfx_px = " << camera_.fx_px
           << "\nfy_px = " << camera_.fy_px << "\ncx_px = 319.5\ncy_px = 239.5\n";
    }
    text << "[rig]\nbaseline_m = 1\n[mount]\ntilt_deg = -90\n";
    if (pose) {
      text << "[pose]\nroll_deg = 0\npitch_deg = 0\nheading_deg = 0\nheight_m = " << kHeight_m
           << "\n";
    }
    text << "[capture]\nleft = \"left.avi\"\nright = \"right.avi\"\n";
    return text.str();
  }

  const PinholeCamera camera_;
};

TEST_F(Cameras, AFilmedPairIsMappedAndCannotBeApproved) {
  WriteFilms();
  WriteFile("rig.toml", RigText(true));
  WriteFile("look.script",
            "wait state PROPOSED 20\n"
            "expect text mode VIDEO\n"
            "expect text approve No vehicle in a video\n"
            "expect text alarm No alarms\n"
            "screenshot fly.png\n"
            "click tab/Diagnose\n"
            "wait seconds 0.3\n"
            "expect text camera/right unpaired 0, dropped 0, reopened 0\n"
            "screenshot diagnose.png\n"
            "quit\n");
  const ProcessResult result = RunProcess(
      Palace({"--headless", "--cameras", "rig.toml", "--script", "look.script", "--record", "rec"}),
      120);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const auto flights = FlightsIn(folder_ / "rec");
  ASSERT_EQ(flights.size(), 1u) << result.out;
  for (const char* name : {"fly.png", "diagnose.png"}) {
    EXPECT_TRUE(std::filesystem::exists(flights[0] / name)) << name;
  }
  EXPECT_FALSE(std::filesystem::exists(flights[0] / "flight.lcm")) << "films are on disk already";
}

TEST_F(Cameras, WithoutAPoseItSaysWhatItCannotDo) {
  WriteFilms();
  WriteFile("rig.toml", RigText(false));
  WriteFile("look.script",
            "wait seconds 2\n"
            "expect state SEARCH\n"
            "expect text alarm Attitude and height unknown\n"
            "quit\n");
  const ProcessResult result = RunProcess(
      Palace({"--headless", "--cameras", "rig.toml", "--script", "look.script", "--record", "rec"}),
      120);
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(Cameras, PairsForCalibrationAreTaken) {
  WriteFilms();
  WriteFile("rig.toml", RigText(false));
  const std::vector<std::string> words = {"capture", "--rig", "rig.toml",  "--out", "pairs",
                                          "--count", "3",     "--every-s", "0.5"};
  const ProcessResult result = RunProcess(Palacectl(words), 60);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "pair 1 of 3\npair 2 of 3\npair 3 of 3\n");
  // 0.5 s are five pictures: fresh noise, so the second pair is not the first.
  const auto picture = [&](const char* name) {
    return cv::imread((folder_ / "pairs" / name).string(), cv::IMREAD_GRAYSCALE);
  };
  const cv::Mat first = picture("left_000.png"), second = picture("left_001.png");
  ASSERT_EQ(first.size(), cv::Size(640, 480));
  ASSERT_EQ(picture("right_002.png").size(), first.size());
  EXPECT_GT(cv::norm(first, second, cv::NORM_INF), 0);
  const ProcessResult again = RunProcess(Palacectl(words), 60);
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_NE(again.err.find("choose another --out"), std::string::npos) << again.err;
}

TEST_F(Cameras, TheDefaultScriptOutlivesTheFilm) {
  WriteFilms();
  WriteFile("rig.toml", RigText(true));
  const ProcessResult result =
      RunProcess(Palace({"--headless", "--cameras", "rig.toml", "--record", "rec"}), 120);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const auto flights = FlightsIn(folder_ / "rec");
  ASSERT_EQ(flights.size(), 1u) << result.out;
  EXPECT_TRUE(std::filesystem::exists(flights[0] / "04-diagnose.png"));
}

}  // namespace
}  // namespace palace
