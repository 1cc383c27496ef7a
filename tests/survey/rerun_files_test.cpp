// What `palacectl log rerun` writes, from snapshots made by hand: every map once, and a map that is
// judged again as such.
#include "engine/survey/rerun_files.h"

#include <fstream>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "engine/slad/slad.h"
#include "tests/slad/worlds.h"
#include "tests/support/own_path.h"

namespace palace {
namespace {

std::vector<std::string> LinesOf(const std::filesystem::path& path) {
  std::vector<std::string> lines;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    lines.push_back(line);
  }
  return lines;
}

class Rerun : public ::testing::Test {
 protected:
  Rerun() { std::filesystem::remove_all(folder_); }
  ~Rerun() override { std::filesystem::remove_all(folder_); }

  /// A flight over level ground: a new map at each of these times.
  void MapAt(double time_s) {
    time_ = AddSeconds({}, 100 + time_s);
    ElevationMap map = testing::MakeMap(40, 40, 0.15, testing::Flat());
    map.time = time_;
    slad_.Take(std::move(map));
    Judge();
  }
  void Judge() { decision_ = slad_.Decide(settings_, Letters::kOfRecord); }
  EngineSnapshot Seen(double time_s) {
    EngineSnapshot snapshot;
    snapshot.time = AddSeconds({}, 100 + time_s);
    snapshot.terrain.Edit().applied = decision_;
    return snapshot;
  }
  RerunFiles Open(const char* maps) {
    return std::move(RerunFiles::Open(folder_, *ParseMapTimes(maps))).value();
  }
  /// First column of maps.csv.
  std::vector<std::string> Stems() {
    std::vector<std::string> stems;
    for (const std::string& line : LinesOf(folder_ / "maps.csv")) {
      stems.push_back(line.substr(0, line.find(',')));
    }
    stems.erase(stems.begin());
    return stems;
  }

  const std::filesystem::path folder_ = OwnPath();
  Slad slad_;
  Settings settings_;
  Timestamp time_;
  std::shared_ptr<const TerrainDecision> decision_;
};

TEST_F(Rerun, AMapIsWrittenOnceHoweverOftenItIsSeen) {
  RerunFiles files = Open("every 1 s");
  for (const double time_s : {0.0, 0.5, 1.0, 1.5}) {
    MapAt(time_s);
    ASSERT_TRUE(files.Add(Seen(time_s), nullptr).ok());
    ASSERT_TRUE(files.Add(Seen(time_s + 0.1), nullptr).ok());
  }
  ASSERT_TRUE(files.Finish().ok());
  EXPECT_EQ(files.counts().frames, 8u);
  EXPECT_EQ(files.counts().maps, 4u);
  EXPECT_EQ(files.counts().judged_again, 0u);
  EXPECT_EQ(files.counts().written, 3u);  // 0 s, 1 s, and the last
  EXPECT_EQ(Stems(),
            (std::vector<std::string>{"map_000000.000", "map_000001.000", "map_000001.500"}));
  for (const std::string& stem : Stems()) {
    for (const char* layer : {"elevation", "elevation_sigma", "slope", "roughness", "cost",
                              "safe_distance", "hazard"}) {
      EXPECT_TRUE(std::filesystem::exists(folder_ / (stem + "_" + layer + ".tif"))) << layer;
    }
  }
}

TEST_F(Rerun, AMapThatIsJudgedAgainIsNoNewMapAndOverwritesNothing) {
  RerunFiles files = Open("every 1 s");
  MapAt(0);
  ASSERT_TRUE(files.Add(Seen(0), nullptr).ok());
  settings_.slad.limits.max_slope_deg = 3;
  Judge();
  ASSERT_TRUE(files.Add(Seen(0.1), nullptr).ok());
  ASSERT_TRUE(files.Finish().ok());
  EXPECT_EQ(files.counts().maps, 1u);
  EXPECT_EQ(files.counts().judged_again, 1u);
  EXPECT_EQ(files.counts().written, 2u);
  EXPECT_EQ(Stems(), (std::vector<std::string>{"map_000000.000", "map_000000.000_2"}));
  std::set<std::string> hashes;
  for (const std::string& line : LinesOf(folder_ / "maps.csv")) {
    std::stringstream fields(line);
    std::string field;
    for (int i = 0; i < 4; ++i) {
      std::getline(fields, field, ',');
    }
    hashes.insert(field);
  }
  EXPECT_EQ(hashes.size(), 3u) << "the header and two settings";
}

TEST_F(Rerun, MapsWithoutASiteSayWhy) {
  RerunFiles files = Open("last");
  settings_.slad.lander.nav_error_m = 5;  // more room than the map has
  MapAt(0);
  ASSERT_TRUE(files.Add(Seen(0), nullptr).ok());
  ASSERT_TRUE(files.Finish().ok());
  EXPECT_EQ(files.counts().without_site, 1u);
  const auto lines = LinesOf(folder_ / "sites.csv");
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_NE(lines[1].find(decision_->selection.none_reason), std::string::npos) << lines[1];
}

TEST_F(Rerun, FramesWithoutAMapSayWhy) {
  RerunFiles files = Open("last");
  EngineSnapshot none;
  const auto add = [&](int pair) {
    if (pair > 0) {
      none.sensors.Edit().frame = std::make_shared<const StereoFrame>();
    }
    EXPECT_TRUE(files.Add(none, nullptr).ok());
  };
  none.session.Edit().missing_inputs = "VEHICLE_POSE";
  add(1);
  none.session.Edit().missing_inputs = "";
  add(0);
  none.terrain.Edit().stereo_quality.suspect_swapped = true;
  add(1);
  add(1);
  none.session.Edit().diagnostics = {{DiagnosticLevel::kInfo, "stereo", "fine"},
                                     {DiagnosticLevel::kError, "stereo", "cannot match"}};
  add(1);
  none.terrain.Edit().why_no_map = "On the ground no map is made";
  add(1);
  MapAt(0);
  EXPECT_TRUE(files.Add(Seen(0), nullptr).ok());
  EXPECT_EQ(files.counts().why_no_map,
            (std::map<std::string, std::uint64_t>{{"missing for maps: VEHICLE_POSE", 1},
                                                  {"no pair of pictures came with it", 1},
                                                  {"Left and right camera look exchanged", 2},
                                                  {"cannot match", 1},
                                                  {"On the ground no map is made", 1}}));
  EXPECT_EQ(files.counts().maps, 1u);
}

TEST_F(Rerun, ABrokenRunLeavesNoTableThatLooksWhole) {
  {
    RerunFiles files = Open("last");
    MapAt(0);
    ASSERT_TRUE(files.Add(Seen(0), nullptr).ok());
  }
  for (const char* table : {"sites.csv", "decisions.csv", "maps.csv"}) {
    EXPECT_FALSE(std::filesystem::exists(folder_ / table)) << table;
  }
}

TEST_F(Rerun, MapsOfAnEarlierRunGoWithItsTableAndNothingElseDoes) {
  const auto tifs = [&] {
    std::set<std::string> names;
    for (const auto& file : std::filesystem::directory_iterator(folder_)) {
      if (file.path().extension() == ".tif") {
        names.insert(file.path().filename().string());
      }
    }
    return names;
  };
  const auto run = [&](const char* maps) {
    RerunFiles files = Open(maps);
    MapAt(0);
    ASSERT_TRUE(files.Add(Seen(0), nullptr).ok());
    ASSERT_TRUE(files.Finish().ok());
  };
  run("last");
  EXPECT_FALSE(tifs().empty());
  std::ofstream(folder_ / "map_of_mine.tif") << "mine";
  RerunFiles none = std::move(RerunFiles::Open(folder_, {})).value();
  ASSERT_TRUE(none.Finish().ok());
  EXPECT_EQ(tifs(), std::set<std::string>{"map_of_mine.tif"});
}

TEST(MapTimes, AreReadAsAPersonWritesThem) {
  EXPECT_TRUE(ParseMapTimes("last")->last);
  EXPECT_EQ(ParseMapTimes("every 5")->every_s, 5);
  EXPECT_EQ(ParseMapTimes("every 0.5 s")->every_s, 0.5);
  for (const char* wrong :
       {"", "often", "every", "every -1", "every nan s", "every 5 min", "every 1e9"}) {
    EXPECT_FALSE(ParseMapTimes(wrong).ok()) << wrong;
  }
}

}  // namespace
}  // namespace palace
