#include "engine/geodata/column_names.h"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <vector>

namespace palace {
namespace {

constexpr std::size_t kAxes = 3;
constexpr std::array<const char*, kAxes> kAxisWords = {"x or east", "y or north", "z or height"};

template <std::size_t kCount>
bool IsOneOf(const std::string& name, const std::array<std::string_view, kCount>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Of its three; none: another.
std::optional<std::size_t> AxisOf(const std::string& name) {
  static constexpr std::array<std::string_view, 6> kEast = {"x",       "e",   "east",
                                                            "easting", "x_m", "east_m"};
  static constexpr std::array<std::string_view, 6> kNorth = {"y",        "n",   "north",
                                                             "northing", "y_m", "north_m"};
  static constexpr std::array<std::string_view, 14> kUp = {
      "z",   "h",        "up",  "height", "elev",     "elevation", "alt",
      "z_m", "altitude", "hgt", "up_m",   "height_m", "h_m",       "elevation_m"};
  return IsOneOf(name, kEast)    ? std::optional<std::size_t>(0)
         : IsOneOf(name, kNorth) ? std::optional<std::size_t>(1)
         : IsOneOf(name, kUp)    ? std::optional<std::size_t>(2)
                                 : std::nullopt;
}

bool CountsDown(const std::string& name) {
  static constexpr std::array<std::string_view, 5> kDown = {"down", "d", "depth", "down_m",
                                                            "depth_m"};
  return IsOneOf(name, kDown);
}

bool IsMetres(const std::string& unit) {
  static constexpr std::array<std::string_view, 6> kMetres = {"",       "m",     "metre",
                                                              "metres", "meter", "meters"};
  return IsOneOf(unit, kMetres);
}

/// A column's name without its unit.
struct Column {
  std::string name, unit;
};

/// In columns where the line has commas, semicolons or tabs, else at blanks.
std::vector<Column> ColumnsOf(std::string line) {
  line.erase(0, std::min(line.find_first_not_of("#/%! \t\r"), line.size()));
  const bool by_sign = line.find_first_of(",;\t") != std::string::npos;
  std::vector<Column> columns;
  bool in_unit = false, in_word = false;
  for (const char c : line + (by_sign ? "," : " ")) {
    const bool blank = c == ' ' || c == '\r' || c == '"' || c == '\'';
    const bool parts = by_sign ? c == ',' || c == ';' || c == '\t' : blank;
    if (c == '(' || c == '[') {
      // "z (m)": the unit of the word before it.
      if (!in_word && columns.empty()) {
        columns.emplace_back();
      }
      in_unit = true;
    } else if (c == ')' || c == ']') {
      in_unit = false;
    } else if (parts && !in_unit) {
      if (by_sign && !in_word) {
        columns.emplace_back();  // a column without a name
      }
      in_word = false;
    } else if (!blank) {
      if (!in_word && !in_unit) {
        columns.emplace_back();
        in_word = true;
      }
      std::string& text = in_unit ? columns.back().unit : columns.back().name;
      text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    } else if (in_word && by_sign && !in_unit) {
      columns.back().name += ' ';
    }
  }
  for (Column& column : columns) {
    column.name.erase(column.name.find_last_not_of(' ') + 1);
  }
  return columns;
}

}  // namespace

Result<std::optional<PointColumns>> ColumnsNamed(const std::string& line, std::size_t row_numbers,
                                                 bool is_comment) {
  const std::vector<Column> columns = ColumnsOf(line);
  std::array<std::optional<std::size_t>, kAxes> found;
  std::optional<Error> objection;
  const auto object = [&](const std::string& what) {
    objection = objection ? objection : std::optional(InvalidError(what));
  };
  bool down = false;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto axis = CountsDown(columns[i].name) ? std::optional<std::size_t>(kAxes - 1)
                                                  : AxisOf(columns[i].name);
    if (!axis) {
      continue;
    }
    const std::string named =
        "column " + std::to_string(i + 1) + " is named \"" + columns[i].name + "\"";
    if (found[*axis]) {
      object(named + ", column " + std::to_string(*found[*axis] + 1) + " alike; which is " +
             kAxisWords[*axis] + "?");
    }
    if (CountsDown(columns[i].name)) {
      down = true;
      object(named + "; heights must count upwards: write z = -" + columns[i].name);
    } else if (!IsMetres(columns[i].unit)) {
      object(named + " in " + columns[i].unit + "; metres are expected");
    }
    found[*axis] = i;
  }
  const auto known = static_cast<std::size_t>(
      std::count_if(found.begin(), found.end(), [](const auto& at) { return at.has_value(); }));
  const bool fits = columns.size() == row_numbers;
  if (known < kAxes && (is_comment || !fits)) {
    return std::optional<PointColumns>();  // prose
  }
  if (objection && (known == kAxes || down)) {
    return *objection;
  }
  if (known == 0 && row_numbers == kAxes) {
    return std::optional<PointColumns>();
  }
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    if (!found[axis]) {
      return InvalidError("no column is named " + std::string(kAxisWords[axis]) +
                          "; name the columns x, y and z, or leave the heading out where they are "
                          "the first three");
    }
    if (*found[axis] >= row_numbers) {
      return InvalidError("column " + std::to_string(*found[axis] + 1) + ", \"" +
                          columns[*found[axis]].name + "\", has no number in the first row");
    }
  }
  return std::optional(PointColumns{*found[0], *found[1], *found[2]});
}

}  // namespace palace
