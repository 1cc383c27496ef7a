// The window shows verdicts and reaches none: no line under gui compares a limit, or a figure that
// limits are for. What is over a limit is in the snapshot (engine/model/mission/limit_row.h,
// hazard_maps.h). clang-format puts blanks around every comparison and around no template's
// brackets: that is how one is told from the other.
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace palace {
namespace {

namespace fs = std::filesystem;

/// Names of limits, of figures that have one, and of constants in a physical unit.
constexpr const char* kLimits =
    R"(\b(?:settings|slad|GuardLimits|DescentLimits|clear_radius_m|nav_error_m|commit_height_m|)"
    R"(confirm_height_m|max_(?:slope|deviation|step|rock|sigma|left_right|vision)\w*|)"
    R"(min_(?:safe_probability|coherence)|(?:\w+(?:\.|->))limit|k[A-Z]\w*_(?:m|mps|deg|rad|s|px|sigma)|)"
    R"(safe_distance_m|clearance_m|slope_rad|roughness_m|step_m|age_s|height_above_site_m|)"
    R"(distance_to_site_m|time_to_touchdown_s|)"
    R"(safe_probability|unknown_cells|wind_speed_mps|coherence|residual_sigma|row_error_px|)"
    R"(exposure_ratio|glide_deviation_m|off_path_m|from_site_m|descent_rate_mps)\b)";

/// Names that these files compare without reaching a verdict, and why.
const std::set<std::pair<std::string, std::string>> kAllowed = {
    // How a number is written.
    {"gui/widgets/number_text.cpp", "age_s"},
    {"gui/widgets/readout.cpp", "age_s"},
    {"gui/panels/review/review_plots.cpp", "age_s"},
    // Two rings that cover each other are drawn as one.
    {"gui/panels/terrain_views.cpp", "kSamePlace_m"},
    {"gui/widgets/map/camera_overlay.cpp", "clear_radius_m"},
    // A verdict is drawn on the picture of its own map.
    {"gui/panels/terrain_views.cpp", "kVerdictOld_s"},
    {"gui/panels/terrain_views.cpp", "age_s"},
    {"gui/panels/review/review_workspace.cpp", "kVerdictOld_s"},
    // From when on a view of the truth says its age.
    {"gui/panels/simulate/world_views.cpp", "age_s"},
    {"gui/panels/simulate/world_views.cpp", "kNewTruth_s"},
    // Which checks of many are listed; how far a plot reaches.
    {"gui/panels/site_recheck.cpp", "height_above_site_m"},
    {"gui/panels/site_recheck.cpp", "safe_distance_m"},
    {"gui/panels/descent_plots.cpp", "kFuture_s"},
    // Two names of one place in a record and its replay.
    {"gui/panels/review/review_timeline.cpp", "kSameRadius_m"},
    // How long a silence is drawn as a gap.
    {"gui/panels/review/review_timeline.cpp", "kGap_s"},
    {"gui/panels/review/review_plots.cpp", "kMapGap_s"},
    // How long the window waits, or says something.
    {"gui/panels/wave_off.cpp", "kAnswerTime_s"},
    {"gui/panels/approve_words.cpp", "kAnswered_s"},
    // What of a way to another hover is left to be told.
    {"gui/panels/approve_words.cpp", "kTold_m"},
    {"gui/panels/approve_words.cpp", "kTold_deg"},
    // Which corner a click means; what is drawn as a turn, and no way.
    {"gui/panels/search_map.cpp", "kSnap_px"},
    {"gui/panels/search_map_marks.cpp", "kOnTheSpot_m"},
    {"gui/panels/tune/setting_history.cpp", "kGesture_s"},
    {"gui/widgets/hold_button.cpp", "kReleaseMessage_s"},
    // How a scene is drawn.
    {"gui/render/scene_renderer.cpp", "kNoFineFootprint_m"},
    {"gui/render/terrain_renderer.cpp", "kFlat_m"},
    {"gui/render/terrain_renderer.cpp", "kTallest_m"},
    {"gui/render/view_frustum.cpp", "kReach_m"},
    {"gui/app/world_views.cpp", "kSlow_s"},
    {"gui/app/world_views.cpp", "kQuick_s"},
};

struct Finding {
  std::string file;
  std::string text;
};

/// The file without comments, its white space made single blanks.
std::string Flat(const fs::path& path) {
  std::ifstream file(path);
  std::string text;
  for (std::string line; std::getline(file, line);) {
    text += line.substr(0, line.find("//")) + " ";
  }
  return std::regex_replace(text, std::regex(R"(\s+)"), " ");
}

/// The first name in `words` that the file may not compare; empty: none.
std::string NameIn(const std::string& file, const std::string& words) {
  static const std::regex limits(kLimits);
  for (std::sregex_iterator at(words.begin(), words.end(), limits), end; at != end; ++at) {
    if (!kAllowed.count({file, at->str()})) {
      return at->str();
    }
  }
  return {};
}

std::vector<Finding> Comparisons(const std::string& file, const std::string& text) {
  std::vector<Finding> found;
  std::istringstream words(text);
  std::string before, word, after;
  words >> before >> word;
  while (words >> after) {
    const bool compares = word == "<" || word == ">" || word == "<=" || word == ">=";
    if (compares && !(NameIn(file, before) + NameIn(file, after)).empty()) {
      found.push_back({file, before + " " + word + " " + after});
    }
    before = word;
    word = after;
  }
  return found;
}

TEST(LimitRules, TheWindowComparesNoLimit) {
  const fs::path root = PALACE_SOURCE_DIR;
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(root / "gui")) {
    const std::string extension = entry.path().extension();
    if (extension != ".h" && extension != ".cpp") {
      continue;
    }
    ++files;
    const std::string name = fs::relative(entry.path(), root).string();
    for (const Finding& finding : Comparisons(name, Flat(entry.path()))) {
      ADD_FAILURE() << finding.file << " decides by itself: " << finding.text;
    }
  }
  EXPECT_GT(files, 50);
}

// What is unsafe stays so when nobody asks any more.
TEST(LimitRules, NoTextAdvisesToWidenALimit) {
  const std::regex advice(
      R"((widen|loosen|relax|raise|increase|larger|wider) (a |the |your |this |that )?limit)",
      std::regex::icase);
  EXPECT_TRUE(std::regex_search("Fly on or widen a limit.", advice));
  const fs::path root = PALACE_SOURCE_DIR;
  for (const char* folder : {"engine", "gui"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      if (entry.path().extension() == ".cpp" || entry.path().extension() == ".h") {
        EXPECT_FALSE(std::regex_search(Flat(entry.path()), advice)) << entry.path();
      }
    }
  }
}

TEST(LimitRules, TheRuleFindsWhatItIsFor) {
  const char* bad[] = {
      "const bool holds = distance_m >= now->settings.clear_radius_m();",
      "if (hazards.safe_distance_m.at(cell) < needed_m) {",
      "over += row.limit < value ? 1 : 0;",
      "fine = q.row_error_px <= 0.5;",
      "return speed > kMaxWind_mps;",
      "if (age_s > 1.0) {",
      "fine = arrival < kStaleAge_s;",
      "landing && !(height < kSinking_m) && more",
      "d.hazards->reasons == 0 && site.slope_rad.value > limit_rad",
  };
  for (const char* line : bad) {
    EXPECT_EQ(Comparisons("x", line).size(), 1U) << line;
  }
  const char* good[] = {
      "std::vector<LimitRow> limits = SiteLimits(site, settings);",
      "static_cast<float>(slad.max_slope_deg) / 2",
      "over += limit->over ? 1 : 0;",
      "for (std::size_t i = 0; i < rows.size(); ++i) {",
      "const bool on = x < 3;  // max_slope_deg > 4",
  };
  for (const char* line : good) {
    EXPECT_TRUE(Comparisons("x", std::string(line).substr(0, std::string(line).find("//"))).empty())
        << line;
  }
}

}  // namespace
}  // namespace palace
