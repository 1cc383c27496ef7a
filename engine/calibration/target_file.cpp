#define TOML_EXCEPTIONS 0
// toml++ 3.3 asserts that a table header starts with a key ("[?]" in a damaged file aborts), but
// reports the same as an error two lines later. Files are input: never abort on them.
#define TOML_ASSERT(expr) static_assert(true)
#include "engine/calibration/target_file.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <tuple>

#include <toml++/toml.h>

#include "engine/core/files.h"
#include "engine/core/plain_text.h"
#include "engine/core/text.h"
#include "engine/core/toml_text.h"

namespace palace {
namespace {

constexpr int kLeastSide = 3;
constexpr int kMostSide = 200;
constexpr int kLeastPoints = 12;
constexpr double kLeastPitch_m = 0.001;  // boards to hold: a pitch in millimetres lies outside
constexpr double kMostPitch_m = 1;
constexpr double kLeastDot = 0.1;   // of the pitch
constexpr double kMostDot = 0.75;   // a bright ring must remain to measure the background
constexpr double kLeastMark = 1.2;  // of the dots' diameter, to be told from them
constexpr double kMostMark = 2;
constexpr std::size_t kLeastMarks = 3;
constexpr std::size_t kMostMarks = 16;

/// The [target] table. The first error is kept.
class TargetTable {
 public:
  TargetTable(const toml::table& table, std::string name, int line)
      : table_(table), name_(std::move(name)), line_(line) {}

  std::string Text(const char* key) {
    const toml::node* node = Node(key);
    const auto value = node == nullptr ? std::nullopt : node->value_exact<std::string>();
    if (node != nullptr && !value) {
      Fail(key, " must be a text in quotes");
    }
    return value.value_or("");
  }

  double Number(const char* key, double least, double most, const char* remedy) {
    const toml::node* node = Node(key);
    if (node == nullptr) {
      return 0;
    }
    const std::optional<double> number = NumberOfToml(*node);
    if (!number) {
      Fail(key, " must be a number");
      return 0;
    }
    const double value = *number;
    if (!(value >= least && value <= most)) {
      Fail(key, " = " + NumberText(value) + " is outside " + NumberText(least) + " .. " +
                    NumberText(most) + "; " + remedy);
    }
    return value;
  }

  int Whole(const char* key, int least, int most, const char* remedy) {
    const double value = Number(key, least, most, remedy);
    if (!error_ && value != std::floor(value)) {
      Fail(key, " = " + NumberText(value) + " must be a whole number; " + remedy);
    }
    return error_ ? 0 : static_cast<int>(value);
  }

  std::vector<GridPlace> Places(const char* key) {
    const toml::node* node = Node(key);
    std::vector<GridPlace> places;
    const toml::array* list = node == nullptr ? nullptr : node->as_array();
    if (node != nullptr &&
        (list == nullptr || list->size() < kLeastMarks || list->size() > kMostMarks)) {
      Fail(key, " must be a list of 3 to 16 places [column, row], counted from 0");
      return places;
    }
    for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
      const toml::array* pair = (*list)[i].as_array();
      const auto column =
          pair != nullptr && pair->size() == 2 ? (*pair)[0].value_exact<int64_t>() : std::nullopt;
      const auto row = column ? (*pair)[1].value_exact<int64_t>() : std::nullopt;
      if (!row || *column < 0 || *row < 0 || *column >= kMostSide || *row >= kMostSide) {
        Fail(key, ": place " + std::to_string(i + 1) +
                      " must be [column, row], whole numbers counted from 0");
        return places;
      }
      places.push_back({static_cast<int>(*column), static_cast<int>(*row)});
    }
    return places;
  }

  bool Has(const char* key) const { return table_.contains(key); }
  bool IsText(const char* key, std::string_view text) const {
    return table_[key].value<std::string_view>() == text;
  }

  void Fail(const char* key, const std::string& text) {
    const toml::node* node = table_.get(key);
    if (!error_) {
      error_ = InvalidError(
          name_ + ":" +
          std::to_string(node == nullptr ? line_ : static_cast<int>(node->source().begin.line)) +
          ": target." + key + text);
    }
  }

  const std::optional<Error>& error() const { return error_; }

  /// Before anything is read: a key misspelled is a key missing, and the misspelled one has a line.
  void CheckUnknown(const std::vector<std::string>& known) {
    for (const auto& [key, node] : table_) {
      if (std::find(known.begin(), known.end(), key.str()) == known.end()) {
        std::string names;
        for (const std::string& name : known) {
          names += (names.empty() ? "" : ", ") + name;
        }
        Fail(std::string(key.str()).c_str(),
             " is not a key of this kind of target; known here: " + names);
      }
    }
  }

 private:
  const toml::node* Node(const char* key) {
    const toml::node* node = table_.get(key);
    if (node == nullptr) {
      Fail(key, " is missing; add it to [target]");
    }
    return node;
  }

  const toml::table& table_;
  const std::string name_;
  const int line_;
  std::optional<Error> error_;
};

/// The places moved to begin at (0, 0), sorted: two sets are equal when one is the other shifted.
std::vector<std::pair<int, int>> Shape(std::vector<std::pair<int, int>> places) {
  int column = places[0].first, row = places[0].second;
  for (const auto& place : places) {
    column = std::min(column, place.first);
    row = std::min(row, place.second);
  }
  for (auto& place : places) {
    place = {place.first - column, place.second - row};
  }
  std::sort(places.begin(), places.end());
  return places;
}

bool SomeTurnRepeats(const std::vector<GridPlace>& marks) {
  std::vector<std::pair<int, int>> places;
  for (const GridPlace& mark : marks) {
    places.emplace_back(mark.column, mark.row);
  }
  std::vector<std::pair<int, int>> turned = places;
  for (int quarters = 1; quarters < 4; ++quarters) {
    for (auto& place : turned) {
      place = {place.second, -place.first};
    }
    if (Shape(turned) == Shape(places)) {
      return true;
    }
  }
  return false;
}

void ReadMarks(TargetTable& table, CalibrationTarget& target) {
  if (!table.Has("marks") && !table.Has("mark_diameter_m")) {
    return;
  }
  target.marks = table.Places("marks");
  target.mark_diameter_m =
      table.Number("mark_diameter_m", kLeastMark * target.dot_diameter_m,
                   std::min(kMostMark * target.dot_diameter_m, 0.9 * target.pitch_m),
                   "marks must be 1.2 to 2 times as wide as the other dots and not touch them");
  if (table.error()) {
    return;
  }
  for (std::size_t i = 0; i < target.marks.size(); ++i) {
    const GridPlace& mark = target.marks[i];
    if (mark.column >= target.columns || mark.row >= target.rows) {
      table.Fail("marks", ": [" + std::to_string(mark.column) + ", " + std::to_string(mark.row) +
                              "] is not on the grid of " + std::to_string(target.columns) + " x " +
                              std::to_string(target.rows) + "; count from 0");
    }
    if (std::count(target.marks.begin(), target.marks.end(), mark) > 1) {
      table.Fail("marks", ": [" + std::to_string(mark.column) + ", " + std::to_string(mark.row) +
                              "] stands there twice");
    }
  }
  if (!table.error() && SomeTurnRepeats(target.marks)) {
    table.Fail("marks",
               " look the same when the board is turned; choose places such as [5, 2], [8, 2], "
               "[5, 4]");
  }
}

CalibrationTarget ReadTarget(TargetTable& table) {
  CalibrationTarget target;
  std::vector<std::string> known = {"kind", "columns", "rows", "pitch_m"};
  if (!table.IsText("kind", "chessboard")) {
    known.insert(known.end(), {"dot_diameter_m", "marks", "mark_diameter_m"});
  }
  table.CheckUnknown(known);
  const std::string kind = table.Text("kind");
  if (kind != "dots" && kind != "chessboard") {
    table.Fail("kind", " = \"" + kind + "\" is not known; choose \"dots\" or \"chessboard\"");
  }
  target.kind = kind == "chessboard" ? TargetKind::kChessboard : TargetKind::kDots;
  const char* count =
      target.kind == TargetKind::kDots ? "count the dots" : "count the corners inside the board";
  target.columns = table.Whole("columns", kLeastSide, kMostSide, count);
  target.rows = table.Whole("rows", kLeastSide, kMostSide, count);
  if (!table.error() && target.point_count() < kLeastPoints) {
    table.Fail("rows", ": the target has " + std::to_string(target.point_count()) +
                           " points, 12 are the least");
  }
  target.pitch_m =
      table.Number("pitch_m", kLeastPitch_m, kMostPitch_m, "give metres from point to point");
  if (target.kind == TargetKind::kDots && !table.error()) {
    target.dot_diameter_m =
        table.Number("dot_diameter_m", kLeastDot * target.pitch_m, kMostDot * target.pitch_m,
                     "dots must be 0.1 to 0.75 of pitch_m wide");
    ReadMarks(table, target);
  }
  return target;
}

}  // namespace

Result<CalibrationTarget> ParseTargetText(std::string_view text, const std::string& name) {
  const Result<toml::table> parsed = ParseToml(text, name);
  if (!parsed) {
    return parsed.error();
  }
  const toml::table& root = *parsed;
  for (const auto& [key, node] : root) {
    if (key.str() != "target") {
      return InvalidError(name + ":" + std::to_string(node.source().begin.line) + ": unknown key " +
                          Printable(key.str()) + "; the only table is [target]");
    }
  }
  const toml::node* node = root.get("target");
  const toml::table* table = node == nullptr ? nullptr : node->as_table();
  if (table == nullptr) {
    return InvalidError(name +
                        ":1: table [target] is missing; add it with kind, columns, rows, pitch_m");
  }
  TargetTable reader(*table, name, static_cast<int>(node->source().begin.line));
  const CalibrationTarget target = ReadTarget(reader);
  if (reader.error()) {
    return *reader.error();
  }
  return target;
}

Result<CalibrationTarget> LoadTargetFile(const std::filesystem::path& path) {
  const auto text = ReadTextFile(path);
  if (!text) {
    return text.error();
  }
  return ParseTargetText(*text, path.string());
}

std::string TargetToText(const CalibrationTarget& target) {
  const bool dots = target.kind == TargetKind::kDots;
  std::ostringstream text;
  text.precision(12);
  text << "[target]\nkind = \"" << (dots ? "dots" : "chessboard") << "\"\n"
       << "columns = " << target.columns << (dots ? "" : "  # corners inside the board") << "\n"
       << "rows = " << target.rows << "\n"
       << "pitch_m = " << target.pitch_m << "  # measure it: the baseline scales with it\n";
  if (dots) {
    text << "dot_diameter_m = " << target.dot_diameter_m << "\n";
  }
  if (!target.marks.empty()) {
    text << "marks = [";
    for (std::size_t i = 0; i < target.marks.size(); ++i) {
      text << (i == 0 ? "[" : ", [") << target.marks[i].column << ", " << target.marks[i].row
           << "]";
    }
    text << "]  # places [column, row] of the larger dots, counted from 0\nmark_diameter_m = "
         << target.mark_diameter_m << "\n";
  }
  return text.str();
}

}  // namespace palace
