// Holds the numbers of engine/slad against engine/slad/CALIBRATION.md: none without a row, no row
// without its number, no value that differs, and no bare fraction in the code. That a number was
// measured it cannot prove, only that somebody wrote down how.
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/rules/rule_text.h"

namespace palace {
namespace {

namespace fs = std::filesystem;
// ---- the sources ----

/// As source and table are compared: without blanks, suffixes of floats and an outer pair of
/// braces.
std::string Plain(std::string value) {
  value.erase(std::remove_if(value.begin(), value.end(),
                             [](unsigned char c) { return std::isspace(c) != 0; }),
              value.end());
  value = std::regex_replace(value, std::regex(R"((\d)\.?[fF]\b)"), "$1");
  if (value.size() >= 2 && value.front() == '{' && value.back() == '}') {
    value = value.substr(1, value.size() - 2);
  }
  if (!value.empty() && value.back() == ',') {
    value.pop_back();
  }
  return value;
}

std::vector<std::string> SplitAtCommas(const std::string& text) {
  std::vector<std::string> parts(1);
  int depth = 0;
  for (const char c : text) {
    depth += c == '(' || c == '{' || c == '[' ? 1 : c == ')' || c == '}' || c == ']' ? -1 : 0;
    if (c == ',' && depth == 0) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

struct Constant {
  std::string file, name, value;
};

/// A declaration of numbers that cannot change: constexpr, or const with a name like kThis; also an
/// array of a type of our own that holds nothing but numbers.
const std::regex& Declaration() {
  static const std::regex pattern(
      R"(\b(constexpr|const)\s+(auto|float|double|bool|char|short|int|long|unsigned|std::size_t)"
      R"(|std::ptrdiff_t|std::u?int\d+_t|std::array(?:<\s*(?:float|double|int|std::u?int\d+_t))"
      R"([^>]*>)?|[A-Z]\w*(?=\s+k\w+\s*\[[^\]]*\]\s*=?\s*\{[\s\d.,{}eEfF-]*\};)))"
      R"(\s+((\w+)\s*(?:\[[^\]]*\]\s*)*[={][^;]*);)");
  return pattern;
}

/// A const by another name is a local result.
bool IsConstant(const std::smatch& declaration) {
  return declaration[1] == "constexpr" ||
         std::regex_search(declaration[4].str(), std::regex("^k[A-Z]"));
}

std::vector<Constant> ConstantsOf(const std::string& file, const std::string& text) {
  std::vector<Constant> constants;
  const std::string code = CodeOf(text);
  const std::regex declarator(R"(^\s*(\w+)\s*(?:\[[^\]]*\]\s*)*=?\s*([\s\S]*)$)");
  for (std::sregex_iterator at(code.begin(), code.end(), Declaration()), end; at != end; ++at) {
    for (const std::string& part : SplitAtCommas((*at)[3].str())) {
      std::smatch match;
      if (IsConstant(*at) && std::regex_match(part, match, declarator)) {
        constants.push_back({file, match[1].str(), Plain(match[2].str())});
      }
    }
  }
  return constants;
}

/// Fractions that stand in the code by themselves, but 0.5, whole numbers and powers of ten.
std::set<std::string> BareNumbersOf(const std::string& text) {
  const std::string all = CodeOf(text);
  std::string code = all;
  for (std::sregex_iterator at(all.begin(), all.end(), Declaration()), end; at != end; ++at) {
    if (IsConstant(*at)) {
      code.replace(static_cast<std::size_t>(at->position()), static_cast<std::size_t>(at->length()),
                   std::string(static_cast<std::size_t>(at->length()), ' '));
    }
  }
  std::set<std::string> numbers;
  const std::regex number(R"((^|[^\w.])((?:\d+\.\d*|\.\d+)(?:[eE][-+]?\d+)?|\d+[eE][-+]?\d+))");
  for (std::sregex_iterator at(code.begin(), code.end(), number), end; at != end; ++at) {
    const std::string literal = (*at)[2].str();
    if (!std::regex_match(literal, std::regex(R"(0\.5|\d+\.0*|1[eE][-+]?\d+)"))) {
      numbers.insert(literal);
    }
  }
  return numbers;
}

// ---- the tables ----

using Key = std::pair<std::string, std::string>;  // file and name

struct Tables {
  std::map<Key, std::string> calibrated;  ///< value
  std::set<Key> not_calibrated;
  std::map<std::string, std::set<std::string>> bare;  ///< by file
  Complaints broken;
};

class TableReader {
 public:
  Tables Read(const std::string& text) {
    std::stringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
      ++line_;
      if (line.rfind("## ", 0) == 0) {
        section_ = line.substr(3);
        file_.clear();
      } else if (line.rfind("### `", 0) == 0) {
        file_ = Quoted(line).front();
      } else if (line.rfind("| `", 0) == 0) {
        ReadRow(Cells(line));
      }
    }
    return tables_;
  }

 private:
  void ReadRow(const std::vector<std::string>& cells) {
    if (section_ == "Not calibrated" || section_ == "Bare numbers") {
      const auto names = cells.size() < 3 ? std::vector<std::string>{} : Quoted(cells[1]);
      if (names.empty() || cells[2].empty()) {
        Complain("a row has file, names and a reason");
        return;
      }
      for (const std::string& name : names) {
        if (section_ == "Bare numbers") {
          tables_.bare[Quoted(cells[0]).front()].insert(name);
        } else {
          tables_.not_calibrated.insert({Quoted(cells[0]).front(), name});
        }
      }
      return;
    }
    if (file_.empty()) {
      return;  // of another table
    }
    const bool whole =
        cells.size() == 7 && std::none_of(cells.begin(), cells.end(),
                                          [](const std::string& cell) { return cell.empty(); });
    const auto value = whole ? Quoted(cells[1]) : std::vector<std::string>{};
    if (value.size() != 1) {
      Complain("a row has constant, value, unit, meaning, measurement, -20 % and +20 %");
      return;
    }
    const Key key{file_, Quoted(cells[0]).front()};
    if (!tables_.calibrated.emplace(key, Plain(value.front())).second) {
      Complain(key.second + " has a row already");
    }
  }

  void Complain(const std::string& what) {
    tables_.broken.push_back("CALIBRATION.md:" + std::to_string(line_) + ": " + what);
  }

  Tables tables_;
  std::string section_, file_;
  int line_ = 0;
};

Complaints Compare(const std::vector<Constant>& constants, const Tables& tables) {
  Complaints complaints = tables.broken;
  std::set<Key> seen;
  for (const Constant& constant : constants) {
    const Key key{constant.file, constant.name};
    const std::string where = constant.file + ": " + constant.name + " = " + constant.value;
    seen.insert(key);
    const auto row = tables.calibrated.find(key);
    const bool excused = tables.not_calibrated.count(key) != 0;
    if (row == tables.calibrated.end() && !excused) {
      complaints.push_back(where + " has no row");
    } else if (row != tables.calibrated.end() && row->second != constant.value) {
      complaints.push_back(where + ", but the row says " + row->second);
    } else if (row != tables.calibrated.end() && excused) {
      complaints.push_back(where + " has a row and is \"not calibrated\"");
    }
  }
  for (const auto& [key, value] : tables.calibrated) {
    if (seen.count(key) == 0) {
      complaints.push_back(key.first + ": no constant " + key.second + ", but a row");
    }
  }
  for (const Key& key : tables.not_calibrated) {
    if (seen.count(key) == 0) {
      complaints.push_back(key.first + ": no constant " + key.second + ", but a reason");
    }
  }
  return complaints;
}

// ---- the tree ----

/// Texts of the room's sources by their path inside it.
std::map<std::string, std::string> Sources() {
  const fs::path room = fs::path(PALACE_SOURCE_DIR) / "engine/slad";
  std::map<std::string, std::string> texts;
  for (const auto& entry : fs::recursive_directory_iterator(room)) {
    if (entry.path().extension() == ".h" || entry.path().extension() == ".cpp") {
      texts[fs::relative(entry.path(), room).string()] = ReadText(entry.path());
    }
  }
  return texts;
}

Tables TheTables() {
  return TableReader().Read(ReadText(fs::path(PALACE_SOURCE_DIR) / "engine/slad/CALIBRATION.md"));
}

TEST(Calibration, EveryNumberOfSladHasItsRowAndEveryRowItsNumber) {
  std::vector<Constant> constants;
  for (const auto& [file, text] : Sources()) {
    const auto of_file = ConstantsOf(file, text);
    constants.insert(constants.end(), of_file.begin(), of_file.end());
  }
  EXPECT_GT(constants.size(), 150u);
  EXPECT_EQ(Joined(Compare(constants, TheTables())), "");
}

TEST(Calibration, NoFractionStandsInTheCodeWithoutAName) {
  const Tables tables = TheTables();
  std::map<std::string, std::set<std::string>> found;
  for (const auto& [file, text] : Sources()) {
    if (auto numbers = BareNumbersOf(text); !numbers.empty()) {
      found[file] = std::move(numbers);
    }
  }
  EXPECT_EQ(found, tables.bare);
}

// ---- that the rule can fail ----

constexpr const char* kTable = R"(
### `a.cpp`
| constant | value | unit | meaning | measured | -20 % | +20 % |
|---|---|---|---|---|---|---|
| `kGate` | `3` | sigma | gate | not measured | - | - |
| `kRadii_m` | `0.5, 1.0` | m | radii | not measured | - | - |

## Not calibrated
| file | constants | reason |
|---|---|---|
| `a.cpp` | `kLanes`, `kBits` | sizes |
)";
constexpr const char* kSource = R"(
constexpr float kGate = 3.F;  // constexpr int kInAComment = 1;
static constexpr std::array kRadii_m = {0.5, 1.0};
inline constexpr int kLanes = 8, kBits = 4;
constexpr int Twice(int i) { return 2 * i; }
if constexpr (kLanes == 8) {
}
constexpr std::array<TerrainFlag, 2> kFlags = {kA, kB};
constexpr Kind kKinds[] = {{kA, 1}, {kB, 2}};
const double local = 2 * kGate;
)";

std::string Verdict(const std::string& source, const std::string& table = kTable) {
  return Joined(Compare(ConstantsOf("a.cpp", source), TableReader().Read(table)));
}

TEST(Calibration, ANumberOutsideOfTheTableIsNamed) {
  EXPECT_EQ(Verdict(kSource), "");
  EXPECT_EQ(Verdict(std::string(kSource) + "struct S { static constexpr double kNew_m = 1; };"),
            "a.cpp: kNew_m = 1 has no row\n");
  EXPECT_EQ(Verdict(std::string(kSource) + "static const double kNew_m = 1;"),
            "a.cpp: kNew_m = 1 has no row\n");
  EXPECT_EQ(Verdict(std::string(kSource) + "constexpr Scale kScales[] = {{4, 2.F}, {1, -4}};"),
            "a.cpp: kScales = {4,2},{1,-4} has no row\n");
  EXPECT_EQ(Verdict(std::string(kSource) + "constexpr double kKnots[2] = {\n 1.F,\n 2.F};"),
            "a.cpp: kKnots = 1,2 has no row\n");
}

TEST(Calibration, AnotherValueIsNamed) {
  const std::string moved = std::regex_replace(kSource, std::regex("3\\.F"), "3.5F");
  EXPECT_EQ(Verdict(moved), "a.cpp: kGate = 3.5, but the row says 3\n");
  const std::string longer = std::regex_replace(kSource, std::regex("0\\.5, 1"), "0.5, 2");
  EXPECT_EQ(Verdict(longer), "a.cpp: kRadii_m = 0.5,2.0, but the row says 0.5,1.0\n");
}

TEST(Calibration, ARowWithoutItsNumberIsNamed) {
  const std::string without = std::regex_replace(kSource, std::regex("kGate = 3\\.F"), "kOld = 1");
  EXPECT_EQ(Verdict(without), "a.cpp: kOld = 1 has no row\na.cpp: no constant kGate, but a row\n");
  EXPECT_EQ(Verdict(std::regex_replace(kSource, std::regex(", kBits = 4"), "")),
            "a.cpp: no constant kBits, but a reason\n");
}

TEST(Calibration, ARowThatSaysNothingIsNamed) {
  const std::string silent =
      std::regex_replace(kTable, std::regex("gate \\| not measured"), "gate | ");
  EXPECT_EQ(Verdict(kSource, silent),
            "CALIBRATION.md:5: a row has constant, value, unit, meaning, measurement, -20 % and "
            "+20 %\na.cpp: kGate = 3 has no row\n");
}

TEST(Calibration, BareFractionsAreFound) {
  EXPECT_EQ(BareNumbersOf("x = 0.75F * y + 1.0 - 1e-9 + 0.5 + .25; // 0.3\nf(\"0.4\", 4e-6);"
                          "\nconst double z = 0.2 * x;"),
            (std::set<std::string>{"0.75", ".25", "4e-6", "0.2"}));
  EXPECT_TRUE(BareNumbersOf("constexpr double kX = 0.75, kY = 2.5;\nstatic const float kZ = 0.3F;")
                  .empty());
}

}  // namespace
}  // namespace palace
