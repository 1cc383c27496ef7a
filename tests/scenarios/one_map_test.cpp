// One pair, one map: an experiment's hover, saved as pictures with their poses, gives the same maps
// to `evaluate`, to `palacectl analyze`, to the flight's pipeline over the folder, to a replay of
// what that recorded, and to `palacectl log rerun`.
#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>
#include <sstream>

#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "engine/camera/pinhole.h"
#include "engine/capture/image_folder_source.h"
#include "engine/capture/playback_turns.h"
#include "engine/core/units.h"
#include "engine/experiments/field_trial.h"
#include "engine/journal/flight_recorder.h"
#include "engine/runtime/engine.h"
#include "tests/scenarios/csv_table.h"
#include "tests/scenarios/scenario.h"

namespace palace {
namespace {

constexpr std::uint64_t kSeed = 5;

/// Three frames straight down from 50 ft. The attitude is exactly level: degrees in a file need not
/// round to the same matrix.
HoverView Hover() {
  HoverView view;
  view.width_px = 320;
  view.height_px = 240;
  view.field_of_view_rad = Rad(60);
  view.tilt_rad = Rad(-90);
  view.frames = 3;
  view.attitude_motion_rad = view.attitude_error_rad = 0;
  return view;
}

World Field() {
  World world;
  world.solids = {MakeBox(2.5, -2, 0.5, 0.5, 0.5), MakeBox(-2, 2, 1.0, 2.0, 1.0)};
  return world;
}

std::string BytesIn(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return (std::stringstream() << file.rdbuf()).str();
}

std::string Digits(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

std::string RigToml(const HoverView& view, const std::string& images) {
  const PinholeCamera camera =
      PinholeFromFov(view.width_px, view.height_px, view.field_of_view_rad);
  std::string text;
  for (const char* side : {"left", "right"}) {
    text += "[" + std::string(side) + "]\nwidth = " + std::to_string(camera.width) +
            "\nheight = " + std::to_string(camera.height) + "\nfx_px = " + Digits(camera.fx_px) +
            "\nfy_px = " + Digits(camera.fy_px) + "\ncx_px = " + Digits(camera.cx_px) +
            "\ncy_px = " + Digits(camera.cy_px) + "\n";
  }
  return text + "[rig]\nbaseline_m = " + Digits(view.baseline_m) +
         "\nrectified = true\n[mount]\ntilt_deg = -90\n[images]\n" + images;
}

void SavePicture(const std::filesystem::path& path, const ImageU8& grey) {
  cv::Mat picture(grey.height(), grey.width(), CV_8UC1);
  std::copy(grey.pixels().begin(), grey.pixels().end(), picture.data);
  ASSERT_TRUE(cv::imwrite(path.string(), picture));
}

/// Hashes of the maps of a source, one a map.
std::vector<std::uint64_t> MapsOf(Engine& engine) {
  std::vector<std::uint64_t> maps;
  Timestamp last;
  while (engine.Step()) {
    const auto snapshot = engine.Latest();
    if (snapshot->terrain->applied && snapshot->terrain->applied->map_time != last) {
      last = snapshot->terrain->applied->map_time;
      maps.push_back(snapshot->terrain->applied->map_hash);
    }
  }
  EXPECT_EQ(engine.error(), "");
  EXPECT_TRUE(engine.Stop().ok());
  return maps;
}

class OneMap : public Scenario {
 protected:
  /// Draws the hover and saves it: pictures, RIG.toml, POSES.csv (rows of other pictures between).
  void SetUp() override {
    const HoverView view = Hover();
    auto drawn = LookAtField(Field(), view, StereoSettings{}, kSeed);
    ASSERT_TRUE(drawn.ok());
    frames_ = std::move(*drawn);
    std::string poses = "# surveyed\ntime,file,north,east,down,roll,pitch,heading\n";
    for (std::size_t k = 0; k < frames_.size(); ++k) {
      const SceneView& seen = frames_[k].input.view;
      // Names run against time: the file of poses tells the order.
      const std::string name = std::to_string(frames_.size() - k) + ".png";
      SavePicture(folder_ / ("l" + name), *seen.left);
      SavePicture(folder_ / ("r" + name), *seen.right);
      const Eigen::Vector3d p = seen.range->pose->X_WC.p;
      const double time_s = SecondsBetween({}, seen.range->time);
      poses += Digits(100 + time_s) + ",l" + std::to_string(frames_.size() - k) + "," +
               Digits(p.x()) + "," + Digits(p.y()) + "," + Digits(p.z()) + ",0,0,0\n" +
               Digits(100.05 + time_s) + ",other" + std::to_string(k) + ",0,0,-9,0,0,0\n";
    }
    WriteFile("poses.csv", poses);
    WriteFile("rig.toml", RigToml(view, "left = \"l*.png\"\nright = \"r*.png\"\n"));
    WriteFile("surveyed.toml", RigToml(view,
                                       "left = \"l*.png\"\nright = \"r*.png\"\n"
                                       "poses = \"poses.csv\"\n"));
  }

  /// The experiment's own maps; its clock starts at 0, that of pictures does not.
  std::vector<std::uint64_t> MapsOfExperiment() {
    std::vector<std::uint64_t> maps;
    for (FieldFrame& frame : frames_) {
      auto range = std::make_shared<RangeMap>(*frame.input.view.range);
      range->time = AddSeconds(kRecordedStart, SecondsBetween({}, range->time));
      frame.input.view.range = std::move(range);
    }
    for (std::size_t k = 1; k <= frames_.size(); ++k) {
      maps.push_back(DecideOnField(frames_, Settings{}, static_cast<int>(k))->map_hash);
    }
    return maps;
  }

  /// Hashes of the maps in decisions.csv, one a map, and the stems of the written ones.
  struct Rerun {
    std::vector<std::string> maps, stems;
  };
  Rerun RerunOf(const std::filesystem::path& log, const std::string& out) {
    const ProcessResult result =
        RunProcess(Palacectl({"log", "rerun", log.string(), "--out", out, "--maps", "last"}), 120);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    Rerun rerun;
    for (const auto& row : ReadTable(folder_ / out / "decisions.csv")) {
      const std::string& hash = row.at("map_hash");
      if (!hash.empty() && (rerun.maps.empty() || rerun.maps.back() != hash)) {
        rerun.maps.push_back(hash);
      }
    }
    for (const auto& row : ReadTable(folder_ / out / "maps.csv")) {
      rerun.stems.push_back(row.at("stem"));
    }
    return rerun;
  }

  std::string MapOfAnalyze(std::vector<std::string> options) {
    options.insert(options.begin(), {"analyze", "--left", "l*.png", "--right", "r*.png"});
    options.insert(options.end(), {"--out", "out"});
    const ProcessResult result = RunProcess(Palacectl(options), 120);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    std::ifstream file(folder_ / "out" / "site.json");
    const auto json = nlohmann::json::parse(file, nullptr, false);
    return json.is_object() ? json["map_hash"].get<std::string>() : "";
  }

  std::vector<FieldFrame> frames_;
};

TEST_F(OneMap, EvaluateAnalyzeImagesReplayAndRerunAgreeToTheBit) {
  const std::vector<std::uint64_t> evaluated = MapsOfExperiment();
  ASSERT_EQ(evaluated.size(), 3u);

  EngineParts parts;
  auto source = ImageFolderSource::Open(folder_ / "surveyed.toml", /*loop=*/false);
  ASSERT_TRUE(source.ok()) << source.error().message;
  (*source)->Control({PlaybackControl::Kind::kSpeed, 0});
  parts.source = std::move(*source);
  auto recorder = FlightRecorder::Open(folder_, "flight");
  ASSERT_TRUE(recorder.ok());
  parts.sink = std::move(*recorder);
  Engine pictures(std::move(parts), /*threaded=*/false);
  EXPECT_EQ(MapsOf(pictures), evaluated);

  EngineParts again;
  again.source = OpenLog(folder_ / "flight" / "flight.lcm");
  Engine replayed(std::move(again), /*threaded=*/false);
  EXPECT_EQ(MapsOf(replayed), evaluated);

  EXPECT_EQ(MapOfAnalyze({"--rig", "rig.toml", "--poses", "poses.csv"}),
            std::to_string(evaluated.back()));
  EXPECT_EQ(MapOfAnalyze({"--rig", "surveyed.toml"}), std::to_string(evaluated.back()));

  const Rerun rerun = RerunOf(folder_ / "flight" / "flight.lcm", "again");
  std::vector<std::string> expected;
  for (const std::uint64_t hash : evaluated) {
    expected.push_back(std::to_string(hash));
  }
  EXPECT_EQ(rerun.maps, expected);
  // The files of both verbs are the same too, units included.
  ASSERT_EQ(rerun.stems.size(), 1u);
  for (const char* layer :
       {"elevation", "elevation_sigma", "slope", "roughness", "cost", "safe_distance", "hazard"}) {
    const std::string bytes = BytesIn(folder_ / "out" / (std::string(layer) + ".tif"));
    EXPECT_GT(bytes.size(), 500u) << layer;
    EXPECT_TRUE(bytes == BytesIn(folder_ / "again" / (rerun.stems[0] + "_" + layer + ".tif")))
        << layer;
  }
}

/// Thesis mode fuses nothing, and nobody says that it does.
TEST_F(OneMap, ThesisModeTakesTheLastPairAndSaysSo) {
  const std::string all = MapOfAnalyze({"--rig", "surveyed.toml", "--set", "slad.mode=thesis"});
  std::ifstream file(folder_ / "out" / "site.json");
  const auto json = nlohmann::json::parse(file, nullptr, false);
  EXPECT_EQ(json["pairs"], 3);
  EXPECT_EQ(json["pairs_in_map"], 1);
  std::vector<std::string> stages;  // each once, whatever the number of pairs
  for (const auto& [stage, ms] : json["timing_ms"].items()) {
    stages.push_back(stage);
    EXPECT_GT(ms.get<double>(), 0) << stage;
  }
  EXPECT_THAT(stages, testing::UnorderedElementsAre("read", "rectify", "stereo", "fuse", "decide"));
  const std::string warnings = json["warnings"].dump();
  EXPECT_NE(warnings.find("the map is that of the last of 3 pairs"), std::string::npos) << warnings;
  const std::string page = BytesIn(folder_ / "out" / "report.html");
  EXPECT_NE(page.find("3 pairs, of which thesis mode takes the last"), std::string::npos);
  EXPECT_EQ(page.find("pairs fused"), std::string::npos);
  // The last pair alone, by names that run against time: l1.
  const ProcessResult alone =
      RunProcess(Palacectl({"analyze", "--left", "l1.png", "--right", "r1.png", "--rig",
                            "surveyed.toml", "--set", "slad.mode=thesis", "--out", "alone"}),
                 120);
  ASSERT_EQ(alone.exit_code, 0) << alone.err;
  std::ifstream alone_file(folder_ / "alone" / "site.json");
  EXPECT_EQ(nlohmann::json::parse(alone_file, nullptr, false)["pairs_in_map"], 1);
  EXPECT_TRUE(BytesIn(folder_ / "out" / "elevation.tif") ==
              BytesIn(folder_ / "alone" / "elevation.tif"));
  EXPECT_FALSE(all.empty());
}

}  // namespace
}  // namespace palace
