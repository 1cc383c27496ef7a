// Holds the rows under "Elsewhere" of engine/slad/CALIBRATION.md against the rooms they speak of.
// That no other room has a number that decides, it cannot prove.
#include <functional>
#include <regex>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "tests/rules/rule_text.h"

namespace palace {
namespace {

/// Rows "| `kName` value unit, `kOther` value unit | `file` | .. |" under "Elsewhere": what of them
/// the file does not say. Names that are no constant of the file's own (no k) only need the file.
Complaints ElsewhereComplaints(const std::string& table,
                               const std::function<std::string(const std::string&)>& text_of) {
  Complaints complaints;
  std::stringstream stream(table);
  bool elsewhere = false;
  for (std::string line; std::getline(stream, line);) {
    elsewhere = line.rfind("## ", 0) == 0 ? line.rfind("## Elsewhere", 0) == 0 : elsewhere;
    const auto cells = elsewhere && line.rfind("| ", 0) == 0 ? Cells(line) : Complaints{};
    const auto files = cells.size() < 3 ? Complaints{} : Quoted(cells[1]);
    if (files.empty()) {
      continue;  // the heading
    }
    const std::string code = CodeOf(text_of(files.front()));
    if (code.empty()) {
      complaints.push_back(files.front() + " is not there");
    }
    const std::regex constant(R"(`(k\w+)` (-?[\d.e-]+))");
    for (std::sregex_iterator at(cells[0].begin(), cells[0].end(), constant), end; at != end;
         ++at) {
      const std::string name = (*at)[1].str(), value = (*at)[2].str();
      if (!std::regex_search(code,
                             std::regex("\\b" + name + R"(\s*=\s*)" + value + R"(\s*[,;])"))) {
        complaints.push_back(files.front() + ": no " + name + " = " + value);
      }
    }
  }
  return complaints;
}

TEST(Calibration, WhatOtherRoomsDecideWithIsAsTheTableSays) {
  const std::filesystem::path root = PALACE_SOURCE_DIR;
  EXPECT_EQ(
      Joined(ElsewhereComplaints(ReadText(root / "engine/slad/CALIBRATION.md"),
                                 [&](const std::string& file) { return ReadText(root / file); })),
      "");
  EXPECT_EQ(Joined(ElsewhereComplaints(
                "## Elsewhere\n| constant | where | meaning |\n|---|---|---|\n"
                "| `kA` 0.5 m, `kB` -3 m | `a.cpp` | x |\n| defaults | `gone.h` | x |\n",
                [](const std::string& file) {
                  return file == "a.cpp" ? "constexpr double kA = 0.25, kB = -3;" : "";
                })),
            "a.cpp: no kA = 0.5\ngone.h is not there\n");
}

}  // namespace
}  // namespace palace
