#include "engine/camera/files/poses_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>

#include "engine/camera/files/keyed_text.h"
#include "engine/core/files.h"
#include "engine/core/plain_text.h"
#include "engine/core/text.h"
#include "engine/core/toml_table.h"
#include "engine/core/units.h"

namespace palace {
namespace {

constexpr std::size_t kLargestFile = std::size_t{64} << 20;

struct Column {
  std::string_view name;
  double least = 0;
  double greatest = 0;
  const char* unit = "";
};
/// All but `file`, in the order of Values.
constexpr std::array<Column, 7> kColumns = {{{"time", -1e10, 1e10, "seconds"},
                                             {"north", -1e6, 1e6, "metres"},
                                             {"east", -1e6, 1e6, "metres"},
                                             {"down", -1e5, 1e5, "metres"},
                                             {"roll", -360, 360, "degrees"},
                                             {"pitch", -90, 90, "degrees"},
                                             {"heading", -360, 360, "degrees"}}};
constexpr const char* kAllColumns = "file,time,north,east,down,roll,pitch,heading";
using Values = std::array<double, kColumns.size()>;

std::vector<std::string> SplitAtCommas(std::string_view line) {
  std::vector<std::string> words;
  for (std::size_t from = 0; from <= line.size();) {
    const std::size_t comma = std::min(line.find(',', from), line.size());
    words.emplace_back(Trimmed(line.substr(from, comma - from)));
    from = comma + 1;
  }
  return words;
}

/// The reader of one file: its line under way, and where each column stands in a row.
class Reader {
 public:
  explicit Reader(std::string name) { file_.name = std::move(name); }

  Result<PosesFile> Read(std::string_view text) {
    if (text.substr(0, 3) == "\xEF\xBB\xBF") {
      text.remove_prefix(3);
    }
    for (std::size_t from = 0; from < text.size();) {
      const std::size_t end = std::min(text.find('\n', from), text.size());
      ++line_;
      const std::string_view line = text.substr(from, end - from);
      const std::string_view content = Trimmed(line.substr(0, line.find('#')));
      from = end + 1;
      if (content.empty()) {
        continue;
      }
      const auto words = SplitAtCommas(content);
      if (const Status done = place_.empty() ? ReadHeader(words) : ReadRow(words); !done) {
        return done.error();
      }
    }
    if (place_.empty() || file_.poses.empty()) {
      return InvalidError(file_.name + ": " + (place_.empty() ? "no header row" : "no pose") +
                          "; the file holds " + kAllColumns + " and a row for each left picture");
    }
    return std::move(file_);
  }

 private:
  Error Wrong(const std::string& what) const {
    return InvalidError(file_.name + ":" + std::to_string(line_) + ": " + Printable(what));
  }

  Status ReadHeader(const std::vector<std::string>& words) {
    for (std::size_t k = 0; k < words.size(); ++k) {
      const bool known =
          words[k] == "file" || std::any_of(kColumns.begin(), kColumns.end(),
                                            [&](const Column& c) { return c.name == words[k]; });
      if (!known) {
        return Wrong("unknown column '" + words[k] + "'; the header row is " + kAllColumns);
      }
      if (!place_.emplace(words[k], k).second) {
        return Wrong("column " + words[k] + " stands twice; the header row is " + kAllColumns);
      }
    }
    for (const std::string& name : SplitAtCommas(kAllColumns)) {
      if (!place_.contains(name)) {
        return Wrong("column " + name + " is missing; the header row is " + kAllColumns);
      }
    }
    return Ok();
  }

  Status ReadRow(const std::vector<std::string>& words) {
    if (words.size() != place_.size()) {
      return Wrong(std::to_string(words.size()) + " values, the header row has " +
                   std::to_string(place_.size()) + " columns");
    }
    SurveyedPose pose;
    pose.stem = words[place_.at("file")];
    if (pose.stem.empty()) {
      return Wrong("file is empty; give the left picture's name without folder and ending");
    }
    if (const auto [first, fresh] = line_of_.emplace(pose.stem, line_); !fresh) {
      return Wrong("file = " + pose.stem + " stands in line " + std::to_string(first->second) +
                   " already; each picture has one row");
    }
    Values values{};
    for (std::size_t k = 0; k < kColumns.size(); ++k) {
      const auto value = ReadNumber(kColumns[k], words[place_.at(std::string(kColumns[k].name))]);
      if (!value) {
        return value.error();
      }
      values[k] = *value;
    }
    const auto& [time_s, north_m, east_m, down_m, roll_deg, pitch_deg, heading_deg] = values;
    if (!file_.poses.empty() && std::llround((time_s - file_.poses.back().time_s) * 1e6) < 1) {
      return Wrong("time = " + words[place_.at("time")] + " does not come after the " +
                   NumberText(file_.poses.back().time_s) + " of line " +
                   std::to_string(file_.last_line) +
                   "; rows stand in order of time, at least 0.000001 seconds apart");
    }
    pose.time_s = time_s;
    pose.X_WB.p = {north_m, east_m, down_m};
    EulerAngles attitude;
    attitude.roll_rad = Rad(roll_deg);
    attitude.pitch_rad = Rad(pitch_deg);
    attitude.yaw_rad = Rad(heading_deg);
    pose.X_WB.R = RotationFromEuler(attitude);
    file_.poses.push_back(std::move(pose));
    file_.last_line = line_;
    return Ok();
  }

  Result<double> ReadNumber(const Column& column, const std::string& word) const {
    const std::string told = std::string(column.name) + " = " + word;
    const char* end = word.data() + word.size();
    double value = NAN;
    const auto [next, error] = std::from_chars(
        word.data() + (word.starts_with('+') && !word.starts_with("+-") ? 1 : 0), end, value);
    if (error != std::errc() || next != end) {
      return Wrong(told + " is no number; give " + column.unit + ", from " +
                   NumberText(column.least) + " to " + NumberText(column.greatest));
    }
    if (!(value >= column.least && value <= column.greatest)) {
      return Wrong(told + " is outside " + NumberText(column.least) + " .. " +
                   NumberText(column.greatest) + "; give " + column.unit);
    }
    return value;
  }

  PosesFile file_;
  int line_ = 0;
  std::map<std::string, std::size_t> place_;  ///< of each column in a row; empty before the header
  std::map<std::string, int> line_of_;        ///< of each stem
};

}  // namespace

const SurveyedPose* PosesFile::Find(const std::string& stem) const {
  const auto found = std::find_if(poses.begin(), poses.end(),
                                  [&](const SurveyedPose& pose) { return pose.stem == stem; });
  return found == poses.end() ? nullptr : &*found;
}

Result<PosesFile> LoadPosesFile(const std::filesystem::path& path) {
  const auto text = ReadTextFile(path, kLargestFile);
  if (!text) {
    return text.error();
  }
  return Reader(path.string()).Read(*text);
}

}  // namespace palace
