// As in every file that includes toml++: no exceptions, and a damaged file never aborts.
#define TOML_EXCEPTIONS 0
#define TOML_ASSERT(expr) static_assert(true)
#include "engine/runtime/settings_io.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>
#include <sstream>

#include <toml++/toml.h>

#include "engine/core/files.h"
#include "engine/core/plain_text.h"
#include "engine/core/text.h"
#include "engine/core/toml_text.h"
#include "engine/core/units.h"

namespace palace {
namespace {

std::string At(const std::string& name, const toml::node& node) {
  return name + ":" + std::to_string(node.source().begin.line) + ": ";
}

std::string Shortest(double value) {
  char text[40];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

/// What may stand in place of an unknown name: the settings of its group, or the groups.
std::string KnownSettings(const std::string& name) {
  const std::string group = name.substr(0, name.find('.') + 1);
  std::vector<std::string> names, groups;
  for (const SettingInfo& info : SettingTable()) {
    const std::string of = info.name.substr(0, info.name.find('.') + 1);
    if (!group.empty() && of == group) {
      names.push_back(info.name);
    }
    if (std::find(groups.begin(), groups.end(), of) == groups.end()) {
      groups.push_back(of);
    }
  }
  return names.empty() ? "names begin with one of: " + Joined(groups) : "known: " + Joined(names);
}

/// The number a word stands for, e.g. "thesis".
std::optional<double> ValueOfWord(const SettingInfo& info, std::string_view word) {
  const auto it = std::find(info.words.begin(), info.words.end(), word);
  if (it == info.words.end()) {
    return std::nullopt;
  }
  return static_cast<double>(it - info.words.begin());
}

/// As it stands in the file, on one line and no longer than a reader needs to find it.
std::string Written(const toml::node& node) {
  constexpr std::size_t kMost = 40;
  std::ostringstream out;
  node.visit([&out](const auto& value) { out << value; });
  std::string text = out.str();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return Printable(text.size() > kMost ? text.substr(0, kMost) + "..." : text);
}

Result<double> NumberOf(const SettingInfo& info, const toml::node& node) {
  if (const auto word = node.value_exact<std::string>()) {
    if (const auto value = ValueOfWord(info, *word)) {
      return *value;
    }
    return InvalidError(info.name + " = \"" + Printable(*word) + "\" is not " +
                        (info.words.empty() ? "a number" : "one of: " + Joined(info.words)));
  }
  if (!info.words.empty()) {
    return InvalidError(info.name + " = " + Written(node) +
                        " is not one of: " + Joined(info.words));
  }
  if (const std::optional<double> number = NumberOfToml(node)) {
    return *number;
  }
  return InvalidError(info.name + " = " + Written(node) + " is not a number");
}

Status SetUpVector(Settings& settings, const toml::node& node) {
  const toml::array* array = node.as_array();
  Eigen::Vector3d up = Eigen::Vector3d::Zero();
  if (array == nullptr || array->size() != 3) {
    return InvalidError("slad.up_vector_ned = " + Written(node) +
                        " is not three numbers, e.g. [0, 0, -1]");
  }
  for (int i = 0; i < 3; ++i) {
    up[i] = NumberOfToml(*array->get(static_cast<std::size_t>(i))).value_or(NAN);
  }
  constexpr double kLongest = 1e6;  // a direction; squares of longer ones overflow
  if (!(up.cwiseAbs().maxCoeff() <= kLongest) || up.norm() < 1e-9 || up.z() >= 0) {
    return InvalidError("slad.up_vector_ned = " + Written(node) +
                        " must be three numbers from -1e6 to 1e6 that point up (the third below "
                        "0)");
  }
  up.normalize();
  const double tilt = std::atan2(std::hypot(up.x(), up.y()), -up.z());
  const double azimuth = std::atan2(up.y(), up.x());
  const Status done = SetSettingValue(settings, "slad.up_tilt_deg", Deg(tilt));
  return done ? SetSettingValue(settings, "slad.up_azimuth_deg",
                                azimuth < 0 ? Deg(azimuth) + 360 : Deg(azimuth))
              : done;
}

Status ApplyKey(Settings& settings, const std::string& key, const toml::node& node) {
  if (key == "slad.up_vector_ned") {
    return SetUpVector(settings, node);
  }
  const SettingInfo* info = FindSetting(key);
  if (info == nullptr) {
    return InvalidError("unknown key '" + Printable(key) + "'");
  }
  const Result<double> value = NumberOf(*info, node);
  return value ? SetSettingValue(settings, key, *value) : Status(value.error());
}

}  // namespace

Status CheckSettings(const Settings& settings, const std::string& name) {
  const SladSettings& s = settings.slad;
  if (s.grid.bounds == BoundsMode::kGiven &&
      (s.grid.x_min_m >= s.grid.x_max_m || s.grid.y_min_m >= s.grid.y_max_m)) {
    return InvalidError(
        name + ": slad.x_min_m = " + Shortest(s.grid.x_min_m) +
        ", x_max_m = " + Shortest(s.grid.x_max_m) + ", y_min_m = " + Shortest(s.grid.y_min_m) +
        ", y_max_m = " + Shortest(s.grid.y_max_m) + ": each minimum must lie below its maximum");
  }
  return Ok();
}

Result<Settings> ParseSettings(std::string_view text, const std::string& name,
                               const Settings& base) {
  const Result<toml::table> parsed = ParseToml(text, name);
  if (!parsed) {
    return parsed.error();
  }
  const toml::table& root = *parsed;
  Settings settings = base;
  for (const auto& [section, content] : root) {
    const toml::table* table = content.as_table();
    if (table == nullptr) {
      return InvalidError(At(name, content) + "'" + Printable(section.str()) +
                          "' stands outside a section; sections are [slad] [stereo] [tracking] "
                          "[mission]");
    }
    for (const auto& [key, node] : *table) {
      const std::string full = std::string(section.str()) + "." + std::string(key.str());
      const Status applied = ApplyKey(settings, full, node);
      if (!applied) {
        return InvalidError(At(name, node) + applied.error().message);
      }
    }
  }
  const Status bounds = CheckSettings(settings, name);
  return bounds ? Result<Settings>(settings) : Result<Settings>(bounds.error());
}

Result<Settings> LoadSettingsFile(const std::filesystem::path& path, const Settings& base) {
  const Result<std::string> text = ReadTextFile(path);
  return text ? ParseSettings(*text, path.string(), base)
              : Result<Settings>({text.error().code, "settings file " + text.error().message});
}

Result<Settings> ApplySettingText(const Settings& base, std::string_view assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos) {
    return UsageError("setting '" + std::string(assignment) + "' must read name=value");
  }
  const std::string name(assignment.substr(0, equals));
  const std::string text(assignment.substr(equals + 1));
  const SettingInfo* info = FindSetting(name);
  if (info == nullptr) {
    return UsageError("unknown setting '" + name + "'; " + KnownSettings(name));
  }
  std::optional<double> value = ValueOfWord(*info, text);
  if (!value) {
    double number = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (problem != std::errc() || end != text.data() + text.size()) {
      return UsageError(name + " = '" + text + "' is not " +
                        (info->words.empty() ? "a number" : "one of: " + Joined(info->words)));
    }
    value = number;
  }
  Settings settings = base;
  const Status done = SetSettingValue(settings, name, *value);
  if (!done) {
    return UsageError(done.error().message);
  }
  return settings;
}

std::string SettingsToToml(const Settings& settings) {
  std::string text = "# PALACE settings. Angles in degrees, lengths in metres.\n";
  // The table is ordered for screens; TOML wants each section once.
  for (const std::string section : {"slad", "stereo", "tracking", "mission"}) {
    text += "\n[" + section + "]\n";
    for (const SettingInfo& info : SettingTable()) {
      if (info.name.rfind(section + ".", 0) != 0) {
        continue;
      }
      const double value = GetSetting(settings, info.name);
      text += info.name.substr(section.size() + 1) + " = ";
      text += info.words.empty() ? Shortest(value)
                                 : '"' + info.words[static_cast<std::size_t>(value)] + '"';
      text += info.words.empty() ? "  # " + Shortest(info.min) + " to " + Shortest(info.max) + "\n"
                                 : "  # " + Joined(info.words) + "\n";
    }
  }
  return text;
}

Result<Settings> SettingsOfCommandLine(const Settings& base, const std::filesystem::path& file,
                                       const std::vector<std::string>& assignments) {
  Result<Settings> settings = file.empty() ? base : LoadSettingsFile(file, base);
  if (!settings) {
    return UsageError("--settings: " + settings.error().message);
  }
  for (const std::string& assignment : assignments) {
    settings = ApplySettingText(*settings, assignment);
    if (!settings) {
      return UsageError("--set " + assignment + ": " + settings.error().message);
    }
  }
  if (const Status good = CheckSettings(*settings, "--set"); !good) {
    return UsageError(good.error().message);
  }
  return settings;
}

Status SaveSettingsFile(const std::filesystem::path& path, const Settings& settings) {
  return WriteTextFile(path, SettingsToToml(settings));
}

}  // namespace palace
