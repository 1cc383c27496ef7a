// palacectl analyze on point clouds, good and bad: a site on real ground, a reason why there is
// none, or one message that names the file and what to do.
#include <cstdio>
#include <fstream>
#include <sstream>

#include "tests/scenarios/survey_input.h"
#include "tests/support/reference_data.h"
#include "tests/support/survey_files.h"

namespace palace {
namespace {

std::string Line(double x, double y, double z, const char* parting = " ", const char* rest = "\n") {
  char text[96];
  std::snprintf(text, sizeof text, "%.3f%s%.3f%s%.3f%s", x, parting, y, parting, z, rest);
  return text;
}
/// 20 x 20 m of level ground, a point every quarter metre.
std::string Meadow(const char* parting = " ", const char* rest = "\n") {
  std::string text;
  for (int i = 0; i < 6400; ++i) {
    text += Line(500000 + i % 80 * 0.25, 4000000 + i / 80 * 0.25, 100, parting, rest);
  }
  return text;
}
std::vector<float> MeadowFloats() {
  std::vector<float> xyz;
  for (int i = 0; i < 6400; ++i) {
    for (const double v : {i % 80 * 0.25, i / 80 * 0.25, 3.0}) {
      xyz.push_back(static_cast<float>(v));
    }
  }
  return xyz;
}
std::string Repeated(const std::string& line, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) {
    text += line;
  }
  return text;
}

std::vector<SurveyRow> Clouds() {
  const std::vector<float> floats = MeadowFloats();
  const std::string binary = "binary_little_endian";
  const std::vector<std::string> quarter = {"--cell-m", "0.25"};
  std::vector<SurveyRow> rows = {
      {"xyz", true, Meadow(), End::kSite},
      {"header_comments_blank_lines", true,
       "x y z\n# made by hand\n\n// more\n" + Meadow() + "\n# end\n", End::kSite},
      {"commas", true, "X,Y,Z\n" + Meadow(","), End::kSite},
      {"semicolons", true, Meadow(";"), End::kSite},
      {"tabs_crlf_extra_columns", true, Meadow("\t", "\t17\tgrass\r\n"), End::kSite},
      {"byte_order_mark", true, "\xEF\xBB\xBF" + Meadow(), End::kSite},
      {"some_nan", true, Meadow() + "nan nan nan\n1 2 inf\n", End::kSite, {"2 of 6402 points"}},
      {"gaps_as_minus_9999",
       true,
       Meadow() + Line(500030, 4000010, -9999),
       End::kSite,
       {"1 of 6401 points"}},
      {"all_minus_9999",
       true,
       Repeated(Line(1, 2, -9999), 9),
       End::kRefused,
       {"cloud.xyz: ", "no point"}},
      {"all_nan", true, Repeated("nan nan nan\n", 9), End::kRefused, {"cloud.xyz: ", "no point"}},
      {"empty", true, "", End::kRefused, {"cloud.xyz: 0 points"}},
      {"header_only", true, "x y z\n", End::kRefused, {"cloud.xyz: 0 points"}},
      {"two_points", true, "1 2 3\n4 5 6\n", End::kRefused, {"cloud.xyz: 2 points"}},
      {"three_points", true, "1 2 3\n1.2 2 3\n1 2.2 3\n", End::kNoSite},
      {"all_in_one_place", true, Repeated("7 8 9\n", 500), End::kNoSite},
      {"two_columns", true, "1 2 3\n1 2\n4 5 6\n", End::kRefused, {"cloud.xyz:2: ", "x y z"}},
      {"a_word", true, "1 2 3\n1 2 high\n", End::kRefused, {"cloud.xyz:2: ", "high"}},
      {"glued_numbers", true, "1 2 3\n1.5.2 2 3\n", End::kRefused, {"cloud.xyz:2: ", "1.5.2"}},
      {"decimal_commas", true, "1,5;2,5;3,5\n", End::kRefused, {"cloud.xyz:1: ", "point"}},
      {"decimal_commas_and_blanks",
       true,
       "0,100 0,000 100,002\n",
       End::kRefused,
       {"cloud.xyz:1: ", "point"}},
      {"one_decimal_comma",
       true,
       "1 2 3\n1.0 2,5 3.0\n",
       End::kRefused,
       {"cloud.xyz:2: ", "point"}},
      {"commas_and_blanks", true, "X, Y, Z\n" + Meadow(", "), End::kSite},
      {"reversed_bounds",
       true,
       Meadow(),
       End::kRefused,
       {"x_min_m = 5", "below its maximum"},
       {"--set", "slad.bounds=given", "--set", "slad.x_min_m=5", "--set", "slad.x_max_m=-5"}},
      {"cut_in_the_last_line",
       true,
       Meadow(" ", " 9 9\n") + "500000.0 4000000.0 10",
       End::kRefused,
       {"cloud.xyz:6401: ", "cut off"}},
      {"noise", true, std::string("\0\1\2\xff", 4) + std::string(3000, '\x9c') + "\n1 2 3\n",
       End::kRefused},
      {"las", true, "LASF" + std::string(400, '\0'), End::kRefused, {"LAS", "PLY"}},
      {"too_many_cells",
       true,
       "0 0 0\n1 1 0\n9000 3 0\n",
       End::kRefused,
       {"4096", "--cell-m"},
       {"--cell-m", "1"}},
      {"beyond_all_bounds",
       true,
       "0 0 0\n1e300 1 0\n-1e300 3 0\n",
       End::kNoSite,
       {"2 of 3 points", "130 000 km", "the points span 0 m"},
       {"--cell-m", "1"}},
      {"ply_ascii",
       true,
       "ply\nformat ascii 1.0\nelement vertex 6400\nproperty double x\nproperty double y\n"
       "property double z\nend_header\n" +
           Meadow(),
       End::kSite,
       {},
       quarter},
      {"ply_binary", true, PlyBytes(floats, binary, 6400), End::kSite, {}, quarter},
      {"ply_big_endian",
       true,
       PlyBytes(floats, "binary_big_endian", 6400),
       End::kRefused,
       {"cloud.xyz:2: ", "binary_little_endian"}},
      {"ply_cut",
       true,
       PlyBytes(floats, binary, 6401),
       End::kRefused,
       {"cut off after 6400 of 6401"}},
      {"ply_ascii_cut",
       true,
       "ply\nformat ascii 1.0\nelement vertex 9\nproperty float x\nproperty float y\n"
       "property float z\nend_header\n1 2 3\n1 2\n",
       End::kRefused,
       {"point 2 of 9"}},
      {"ply_negative_count",
       true,
       "ply\nformat binary_little_endian 1.0\nelement vertex -1\nproperty float x\n"
       "property float y\nproperty float z\nend_header\n",
       End::kRefused,
       {"cloud.xyz:3: ", "count"}},
      {"ply_without_z",
       true,
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nend_header\n"
       "1 2\n3 4\n5 6\n",
       End::kRefused,
       {"x, y, z"}},
      {"ply_cut_in_the_header",
       true,
       "ply\nformat ascii 1.0\nelement ver",
       End::kRefused,
       {"end_header"}}};
  return rows;
}

TEST_F(SurveyInput, CloudsGiveASiteAReasonOrAMessage) {
  for (const SurveyRow& row : Clouds()) {
    Check(row);
  }
}

/// The labelled samples: few objects pass for ground.
TEST_F(SurveyInput, LabelledLidarShowsObjects) {
  const std::filesystem::path data = ReferenceData("isprs_lidar");
  if (!std::filesystem::exists(data / "samp31.xyz")) {
    GTEST_SKIP() << NoReferenceData("isprs_lidar");
  }
  const ProcessResult result =
      RunProcess(Palacectl({"evaluate", "site-lidar", "--data", data, "--out", "out"}), 120);
  EXPECT_EQ(result.exit_code, 0) << result.err << result.out;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/report.html"));
  std::ifstream csv(folder_ / "out/site-lidar.csv");
  int samples = 0;
  for (std::string line; std::getline(csv, line);) {
    std::istringstream words(line);
    std::vector<std::string> column;
    for (std::string word; std::getline(words, word, ',');) {
      column.push_back(word);
    }
    if (column.size() == 12 && column[4] == "PALACE") {
      ++samples;
      EXPECT_GE(std::stod(column[7]), 0.95 * std::stod(column[6])) << column[2] << ": objects";
      EXPECT_LE(std::stod(column[9]) - std::stod(column[10]), 0.12 * std::stod(column[8]))
          << column[2] << ": level ground flagged";
    }
  }
  EXPECT_EQ(samples, 5);
}

}  // namespace
}  // namespace palace
