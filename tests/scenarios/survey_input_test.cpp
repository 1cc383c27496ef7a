// palacectl analyze on survey files, good and bad: a site on real ground, a reason why there is
// none, or one message that names the file and what to do.
#include <cmath>
#include <functional>

#include <nlohmann/json.hpp>

#include "engine/core/version.h"
#include "tests/scenarios/scenario.h"
#include "tests/scenarios/survey_files.h"
#include "tests/support/reference_data.h"

namespace palace {
namespace {

using Keys = std::vector<std::pair<std::uint16_t, std::uint16_t>>;

constexpr double kLimit_s = 60;
const Keys kMetres = {{1024, 1}, {1025, 1}};

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

/// Level ground at 100 m, 40 x 40 cells of half a metre; `change` may spoil it.
std::string Dem(const std::function<void(TiffFile&)>& change = {}, const Keys& keys = kMetres) {
  TiffFile tiff;
  tiff.cols = tiff.rows = 40;
  tiff.scale = {0.5, 0.5, 0};
  tiff.cells = BytesOf(std::vector<float>(1600, 100.0F));
  if (change) {
    change(tiff);
  }
  return TiffBytes(tiff, keys);
}
template <typename T>
std::string DemOf(T height, std::uint16_t format) {
  return Dem([&](TiffFile& t) {
    t.cells = BytesOf(std::vector<T>(1600, height));
    t.bits = 8 * sizeof(T);
    t.format = format;
  });
}
std::string DemWithHole(float in_hole, const std::string& no_data) {
  return Dem([&](TiffFile& t) {
    std::vector<float> cells(1600, 100.0F);
    for (int i = 0; i < 1600; ++i) {
      if (i % 40 < 20) {
        cells[static_cast<std::size_t>(i)] = in_hole;
      }
    }
    t.cells = BytesOf(cells);
    t.no_data = no_data;
  });
}

enum class End { kSite, kNoSite, kRefused };
struct Row {
  std::string name;
  bool cloud;
  std::string bytes;
  End end;
  std::vector<std::string> said{};  ///< parts of stderr, or of the reason for no site
  std::vector<std::string> options{};
};

std::vector<Row> Clouds() {
  const std::vector<float> floats = MeadowFloats();
  const std::string binary = "binary_little_endian";
  const std::vector<std::string> quarter = {"--cell-m", "0.25"};
  std::vector<Row> rows = {
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
       End::kRefused,
       {"4096"},
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

std::vector<Row> Models() {
  std::vector<Row> rows = {
      {"float", false, Dem(), End::kSite},
      {"cells_of_the_settings",
       false,
       Dem(),
       End::kSite,
       {"slad.cell_m = 0.3", "--cell-m"},
       {"--set", "slad.cell_m=0.3"}},
      {"bounds_of_the_settings",
       false,
       Dem(),
       End::kSite,
       {"slad.bounds", "whole"},
       {"--set", "slad.bounds=given"}},
      {"finer_than_the_model",
       false,
       Dem(),
       End::kNoSite,
       {"finer than the model's cells of 0.5 m"},
       {"--cell-m", "0.2"}},
      {"double", false, DemOf<double>(100, 3), End::kSite},
      {"int16", false, DemOf<std::int16_t>(100, 2), End::kSite},
      {"uint8", false, DemOf<std::uint8_t>(100, 1), End::kSite},
      {"uint32", false, DemOf<std::uint32_t>(100, 1), End::kSite},
      {"no_data_number", false, DemWithHole(-32767, "-32767"), End::kSite},
      {"no_data_nan", false, DemWithHole(NAN, "nan"), End::kSite},
      {"no_data_untold", false, DemWithHole(-9999, ""), End::kSite, {"800 cells", "no-data"}},
      {"largest_float_untold", false, DemWithHole(-3.4e38F, ""), End::kSite, {"800 cells"}},
      {"all_no_data", false, DemOf<float>(NAN, 3), End::kNoSite, {"100 % unknown"}},
      {"all_minus_9999", false, DemOf<float>(-9999, 3), End::kNoSite, {"100 % unknown"}},
      {"one_cell", false, Dem([](TiffFile& t) {
         t.cols = t.rows = 1;
         t.cells = BytesOf<float>({5});
       }),
       End::kNoSite},
      {"one_row", false, Dem([](TiffFile& t) {
         t.rows = 1;
         t.cells = BytesOf(std::vector<float>(40, 5));
       }),
       End::kNoSite},
      {"one_long_row", false, Dem([](TiffFile& t) {
         t.rows = 1;
         t.cols = 3000;
         t.cells = BytesOf(std::vector<float>(3000, 5));
       }),
       End::kNoSite},
      {"one_long_column", false, Dem([](TiffFile& t) {
         t.rows = 3000;
         t.cols = 1;
         t.cells = BytesOf(std::vector<float>(3000, 5));
       }),
       End::kNoSite},
      {"matrix_north_up", false, Dem([](TiffFile& t) {
         t.scale = t.tie = {};
         t.matrix = {0.5, 0, 0, 1000, 0, -0.5, 0, 2000, 0, 0, 0, 0, 0, 0, 0, 1};
       }),
       End::kSite},
      {"rotated",
       false,
       Dem([](TiffFile& t) {
         t.scale = t.tie = {};
         t.matrix = {0.4, 0.3, 0, 1000, 0.3, -0.4, 0, 2000, 0, 0, 0, 0, 0, 0, 0, 1};
       }),
       End::kRefused,
       {"dem.tif", "rotated", "gdalwarp"}},
      {"south_up",
       false,
       Dem([](TiffFile& t) {
         t.scale = t.tie = {};
         t.matrix = {0.5, 0, 0, 1000, 0, 0.5, 0, 2000, 0, 0, 0, 0, 0, 0, 0, 1};
       }),
       End::kRefused,
       {"dem.tif", "north up", "gdalwarp"}},
      {"degrees", false, Dem({}, {{1024, 2}, {1025, 1}}), End::kRefused, {"degrees", "gdalwarp"}},
      {"degrees_untold",
       false,
       Dem(
           [](TiffFile& t) {
             t.scale = {0.0001, 0.0001, 0};
             t.tie = {0, 0, 0, 8.5, 47.4, 0};
           },
           {}),
       End::kRefused,
       {"degrees", "gdalwarp"}},
      {"feet",
       false,
       Dem({}, {{1024, 1}, {1025, 1}, {3072, 32767}, {3076, 9003}}),
       End::kRefused,
       {"feet", "gdalwarp"}},
      {"heights_in_feet",
       false,
       Dem({}, {{1024, 1}, {1025, 1}, {4099, 9002}}),
       End::kRefused,
       {"heights in feet", "0.3048"}},
      {"oblong_cells",
       false,
       Dem([](TiffFile& t) {
         t.scale = {0.5, 1, 0};
       }),
       End::kRefused,
       {"not square", "gdalwarp"}},
      {"tiny_cells",
       false,
       Dem([](TiffFile& t) {
         t.scale = {1e-6, 1e-6, 0};
       }),
       End::kRefused,
       {"0.001", "gdalwarp"}},
      {"cells_of_nothing",
       false,
       Dem([](TiffFile& t) {
         t.scale = {0, 0, 0};
       }),
       End::kRefused,
       {"dem.tif"}},
      {"cells_of_nan",
       false,
       Dem([](TiffFile& t) {
         t.scale = {NAN, NAN, 0};
       }),
       End::kRefused,
       {"dem.tif"}},
      {"corner_nowhere",
       false,
       Dem([](TiffFile& t) { t.tie = {0, 0, 0, NAN, 2000, 0}; }),
       End::kRefused,
       {"corner"}},
      {"no_place",
       false,
       Dem([](TiffFile& t) { t.scale = {}; }),
       End::kRefused,
       {"tie point", "gdal_translate"}},
      {"three_bands",
       false,
       Dem([](TiffFile& t) { t.bands = 3; }),
       End::kRefused,
       {"one-band", "gdal_translate"}},
      {"half_floats",
       false,
       Dem([](TiffFile& t) { t.bits = 16; }),
       End::kRefused,
       {"gdal_translate"}},
      {"too_large",
       false,
       Dem([](TiffFile& t) { t.cols = 100000; }),
       End::kRefused,
       {"100000 x 40", "8192"}},
      {"text", false, "this is no picture\n", End::kRefused, {"dem.tif", "not a TIFF"}},
      {"empty", false, "", End::kRefused, {"dem.tif", "not a TIFF"}}};
  const std::string whole = Dem();
  for (const std::size_t share : {5, 40, 95}) {
    rows.push_back({"cut_at_" + std::to_string(share) + "_percent",
                    false,
                    whole.substr(0, whole.size() * share / 100),
                    End::kRefused,
                    {"dem.tif"}});
  }
  rows.push_back({"cells_missing",
                  false,
                  Dem([](TiffFile& t) { t.rows = 4000; }),
                  End::kRefused,
                  {"dem.tif", "damaged"}});
  return rows;
}

class SurveyInput : public Scenario {
 protected:
  void Check(const Row& row) {
    SCOPED_TRACE(row.name);
    const std::filesystem::path file = WriteFile(row.cloud ? "cloud.xyz" : "dem.tif", row.bytes);
    std::vector<std::string> words = {"analyze", row.cloud ? "--points" : "--elevation",
                                      file.filename(), "--out", "out_" + row.name};
    words.insert(words.end(), row.options.begin(), row.options.end());
    const ProcessResult result = RunProcess(Palacectl(words), kLimit_s);
    EXPECT_FALSE(result.timed_out);
    EXPECT_EQ(result.signal, 0);
    const std::filesystem::path out = folder_ / ("out_" + row.name);
    if (row.end == End::kRefused) {
      EXPECT_TRUE(result.exit_code == 1 || result.exit_code == 2) << result.exit_code;
      EXPECT_EQ(result.out, "");
      EXPECT_FALSE(std::filesystem::exists(out));
      EXPECT_EQ(result.err.rfind("palacectl", 0), 0u) << result.err;
    } else {
      EXPECT_EQ(result.exit_code, 0) << result.err;
      std::ifstream json_file(out / "site.json");
      const auto json = nlohmann::json::parse(json_file, nullptr, false);
      ASSERT_TRUE(json.is_object());
      EXPECT_EQ(json["status"], row.end == End::kSite ? "found" : "none");
      EXPECT_NE(result.out.find(row.end == End::kSite ? "landing site at" : "no landing site: "),
                std::string::npos)
          << result.out;
      EXPECT_EQ(json["input"], nlohmann::json::array({file.filename().string()}));
      EXPECT_EQ(json["version"], kProgramVersion);
      EXPECT_TRUE(std::filesystem::exists(out / "report.html"));
      for (const auto& site : json["candidates"]) {
        EXPECT_GE(site["clearance_m"].get<double>(), 0);
        EXPECT_TRUE(site["height_m"].is_number());
      }
    }
    for (const std::string& part : row.said) {
      EXPECT_NE((result.err + result.out).find(part), std::string::npos)
          << "'" << part << "' is not in: " << result.err << result.out;
    }
  }
};

TEST_F(SurveyInput, CloudsGiveASiteAReasonOrAMessage) {
  for (const Row& row : Clouds()) {
    Check(row);
  }
}

TEST_F(SurveyInput, ElevationModelsGiveASiteAReasonOrAMessage) {
  for (const Row& row : Models()) {
    Check(row);
  }
}

/// A half without data holds no site, whatever its value.
TEST_F(SurveyInput, NoSiteLiesInAGap) {
  for (const char* no_data : {"-32767", ""}) {
    WriteFile("dem.tif", DemWithHole(*no_data != 0 ? -32767.0F : -9999.0F, no_data));
    const ProcessResult result =
        RunProcess(Palacectl({"analyze", "--elevation", "dem.tif", "--out", "out"}), kLimit_s);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    std::ifstream json_file(folder_ / "out/site.json");
    const auto json = nlohmann::json::parse(json_file, nullptr, false);
    ASSERT_GE(json["candidates"].size(), 1u);
    for (const auto& site : json["candidates"]) {
      EXPECT_GE(site["east_m"].get<double>(), 1010 + 2.3);
    }
  }
}

TEST_F(SurveyInput, NamesThatAreNoUtf8AreNamed) {
  WriteFile("d\xE9m.tif", Dem());
  const ProcessResult result =
      RunProcess(Palacectl({"analyze", "--elevation", "d\xE9m.tif", "--out", "out"}), kLimit_s);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::ifstream json_file(folder_ / "out/site.json");
  EXPECT_TRUE(nlohmann::json::parse(json_file, nullptr, false).is_object());
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
