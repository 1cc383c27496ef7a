// What the scenarios of survey files share: a file, how analyze must end on it, and what it must
// say.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "engine/core/version.h"
#include "tests/scenarios/scenario.h"

namespace palace {

/// How analyze ends.
enum class End { kSite, kNoSite, kRefused };
struct SurveyRow {
  std::string name;
  bool cloud;
  std::string bytes;
  End end;
  std::vector<std::string> said{};  ///< parts of stderr, or of the reason for no site
  std::vector<std::string> options{};
};

class SurveyInput : public Scenario {
 protected:
  static constexpr double kLimit_s = 60;

  void Check(const SurveyRow& row) {
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

}  // namespace palace
