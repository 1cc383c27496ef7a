// palacectl analyze on elevation models, good and bad: a site on real ground, a reason why there is
// none, or one message that names the file and what to do.
#include <fcntl.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <functional>

#include "tests/scenarios/survey_input.h"
#include "tests/support/survey_files.h"

namespace palace {
namespace {

using Keys = std::vector<std::pair<std::uint16_t, std::uint16_t>>;

const Keys kMetres = {{1024, 1}, {1025, 1}};

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

std::vector<SurveyRow> Models() {
  std::vector<SurveyRow> rows = {
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

TEST_F(SurveyInput, ElevationModelsGiveASiteAReasonOrAMessage) {
  for (const SurveyRow& row : Models()) {
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

/// The bytes are counted before the cells are read, of which this file has few.
TEST_F(SurveyInput, AModelThatThereIsNoRoomForIsToldWithItsBytes) {
  WriteFile("dem.tif", Dem([](TiffFile& t) { t.rows = t.cols = 8192; }));
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{}, {"--set", "slad.mode=thesis"}, {"--cell-m", "3"}}) {
    std::vector<std::string> words = {"analyze", "--elevation", "dem.tif", "--out", "out"};
    words.insert(words.end(), more.begin(), more.end());
    ProcessOptions analyze = Palacectl(words);
    analyze.prepare = [] {
      const rlimit limit{rlim_t{6} << 30, rlim_t{6} << 30};
      return setrlimit(RLIMIT_AS, &limit) == 0;
    };
    const ProcessResult refused = RunProcess(analyze, kLimit_s);
    EXPECT_EQ(refused.exit_code, 1);
    for (const char* part : {"dem.tif: 8192 x 8192 cells: out of memory", " MiB",
                             "or cut the model with gdal_translate -srcwin"}) {
      EXPECT_NE(refused.err.find(part), std::string::npos) << part << ": " << refused.err;
    }
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
  }
}

/// Whoever waits at a terminal sees the stage; a file of messages holds none.
TEST_F(SurveyInput, StagesAreShownOnATerminal) {
  WriteFile("dem.tif", Dem());
  ProcessOptions analyze = Palacectl({"analyze", "--elevation", "dem.tif", "--out", "out"});
  EXPECT_EQ(RunProcess(analyze, kLimit_s).err.find("reading"), std::string::npos);
  const int master = posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_TRUE(master >= 0 && grantpt(master) == 0 && unlockpt(master) == 0);
  analyze.prepare = [name = std::string(ptsname(master))] {
    return dup2(open(name.c_str(), O_RDWR | O_NOCTTY), STDERR_FILENO) >= 0;
  };
  EXPECT_EQ(RunProcess(analyze, kLimit_s).exit_code, 0);
  char shown[4096] = {};
  const ssize_t size = read(master, shown, sizeof shown - 1);
  close(master);
  ASSERT_GT(size, 0);
  for (const char* stage : {"analyze: reading (1 of 3) ...", "judging 40 x 40 cells (2 of 3) ...",
                            "writing (3 of 3) ..."}) {
    EXPECT_NE(std::string(shown).find(stage), std::string::npos) << stage << ": " << shown;
  }
}

}  // namespace
}  // namespace palace
