// What a script may say: a table of actions and their arguments, each with its limits.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "engine/core/files.h"
#include "engine/core/text.h"
#include "engine/faults/fault_text.h"
#include "engine/simulation/vehicle_file.h"
#include "engine/world/scene_library.h"
#include "gui/app/input.h"
#include "gui/app/script.h"

namespace palace {
namespace {

struct Argument {
  enum class Kind { kName, kNumber, kState, kKey, kFile, kWords };
  const char* name;
  Kind kind = Kind::kName;
  double least = 0, most = 0;  ///< of a number
  const char* unit = "";
  bool optional = false;
};

constexpr Argument kItem{"NAME"};
constexpr Argument kState{"STATE", Argument::Kind::kState};
constexpr Argument kKey{"KEY", Argument::Kind::kKey};
constexpr Argument kFile{"FILE", Argument::Kind::kFile};
constexpr Argument kWords{"WORDS", Argument::Kind::kWords};
constexpr Argument kSetting{"SETTING"};
constexpr Argument kWithin{"WITHIN", Argument::Kind::kNumber, 0, 3600, "s", true};

constexpr Argument Number(const char* name, double least, double most, const char* unit) {
  return {name, Argument::Kind::kNumber, least, most, unit};
}

struct Action {
  const char* verb;
  const char* what;  ///< the word after it; empty: none
  std::vector<Argument> arguments;
};

const std::vector<Action>& Actions() {
  static const std::vector<Action> actions = {
      {"wait", "state", {kState, kWithin}},
      {"wait", "seconds", {Number("SECONDS", 0, 3600, "s")}},
      {"wait", "item", {kItem, kWithin}},
      {"wait", "height", {Number("HEIGHT", -100, 1000, "m"), kWithin}},
      {"wait", "time", {Number("SECONDS", 0, 86400, "s"), kWithin}},
      {"expect", "state", {kState}},
      {"expect", "item", {kItem}},
      {"expect", "text", {kItem, kWords}},
      {"expect", "height", {Number("HEIGHT", -100, 1000, "m")}},
      {"click", "", {kItem}},
      {"hover", "", {kItem}},
      {"hold", "", {kItem, Number("SECONDS", 0, 60, "s")}},
      {"drag", "", {kItem, Number("DX", -8000, 8000, "px"), Number("DY", -8000, 8000, "px")}},
      {"set", "", {kSetting, Number("VALUE", -1e9, 1e9, "")}},
      {"key", "", {kKey}},
      {"hold_key", "", {kKey, Number("SECONDS", 0, 60, "s")}},
      {"tab_to", "", {kItem}},
      {"down_to", "", {kItem}},
      {"screenshot", "", {kFile}},
      {"resize", "", {Number("WIDTH", 640, 7680, "px"), Number("HEIGHT", 480, 4320, "px")}},
      {"speed", "", {Number("SPEED", 0, 100, "times real time")}},
      {"fault", "", {Argument{"FAULT"}}},
      {"end_fault", "", {Number("NUMBER", 1, 1000, "")}},
      {"run_to", "", {Number("SECONDS", 0, 86400, "s")}},
      {"seek", "", {Number("SECONDS", 0, 86400, "s")}},
      {"new_flight",
       "",
       {Argument{"SCENARIO"},
        {"SEED", Argument::Kind::kNumber, 0, 999'999, "", true},
        {"VEHICLE", Argument::Kind::kName, 0, 0, "", true}}},
      {"quit", "", {}},
  };
  return actions;
}

std::optional<double> NumberIn(const std::string& word) {
  double value = 0;
  const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (problem != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

/// Every choice of "HOLD|PROPOSED" must be a state.
std::string UnknownState(const std::string& wanted) {
  std::string known;
  for (int i = 0; i <= static_cast<int>(MissionState::kLanded); ++i) {
    known +=
        std::string(known.empty() ? "" : ", ") + MissionStateName(static_cast<MissionState>(i));
  }
  std::istringstream choices(wanted);
  for (std::string choice; std::getline(choices, choice, '|');) {
    if (choice.empty() || (", " + known + ",").find(", " + choice + ",") == std::string::npos) {
      return "unknown state '" + choice + "'; states are " + known;
    }
  }
  return {};
}

/// Why the word is not that argument; empty when it is.
std::string ProblemOf(const Argument& argument, const std::string& word) {
  switch (argument.kind) {
    case Argument::Kind::kNumber: {
      const std::optional<double> value = NumberIn(word);
      if (!value) {
        return std::string(argument.name) + " '" + word + "' is not a number";
      }
      if (*value < argument.least || *value > argument.most) {
        return argument.name +
               WithNumbers(" = %g must lie between %g and %g", *value, argument.least,
                           argument.most) +
               (*argument.unit != '\0' ? " " : "") + argument.unit;
      }
      return {};
    }
    case Argument::Kind::kState:
      return UnknownState(word);
    case Argument::Kind::kKey:
      return IsKey(word) ? ""
                         : "unknown key '" + word + "'; keys are spelt as F1 lists them, Shift+Tab";
    case Argument::Kind::kFile:
      return word.size() > 4 && word.substr(word.size() - 4) == ".png" &&
                     word.find('/') == std::string::npos
                 ? ""
                 : "FILE '" + word + "' must be a name that ends in .png, without a folder";
    case Argument::Kind::kName:
    case Argument::Kind::kWords:
      break;
  }
  return {};
}

/// "NAME SECONDS", "STATE [WITHIN]".
std::string Usage(const Action& action) {
  std::string usage = action.what;
  for (const Argument& argument : action.arguments) {
    usage += usage.empty() ? "" : " ";
    usage += argument.optional ? "[" + std::string(argument.name) + "]" : argument.name;
  }
  return usage.empty() ? "nothing" : usage;
}

/// The action of that verb, and of the word after it; null with the reason.
const Action* FindAction(const ScriptLine& line, std::string& problem) {
  std::string known;
  for (const Action& action : Actions()) {
    if (line.verb != action.verb) {
      continue;
    }
    if (*action.what == '\0' || (!line.words.empty() && line.words[0] == action.what)) {
      return &action;
    }
    known += (known.empty() ? "" : ", ") + std::string(action.what);
  }
  problem = known.empty() ? "unknown action '" + line.verb + "'"
            : line.words.empty()
                ? "'" + line.verb + "' takes one of " + known
                : "'" + line.verb + "' takes one of " + known + ", not '" + line.words[0] + "'";
  return nullptr;
}

bool IsNamed(const std::string& name, const auto& names) {
  std::error_code none;
  return std::find(names.begin(), names.end(), name) != names.end() ||
         std::filesystem::is_regular_file(name, none);
}

/// Why there is no such world or vehicle; empty when there is.
std::string UnknownFlight(const ScriptLine& line) {
  if (!IsNamed(line.words[0], SceneNames())) {
    return "new_flight: there is no scenario '" + line.words[0] + "'; choose one of " + SceneList();
  }
  if (line.words.size() > 2 && !IsNamed(line.words[2], VehicleNames())) {
    return "new_flight: there is no vehicle '" + line.words[2] + "'; name a file, or one of " +
           Joined(VehicleNames());
  }
  return {};
}

std::string Problem(const ScriptLine& line) {
  std::string problem;
  const Action* action = FindAction(line, problem);
  if (action == nullptr) {
    return problem;
  }
  std::size_t at = *action->what == '\0' ? 0 : 1;
  bool open_end = false;
  for (const Argument& argument : action->arguments) {
    if (at >= line.words.size()) {
      if (argument.optional) {
        continue;
      }
      return "'" + line.verb + "' takes " + Usage(*action);
    }
    problem = ProblemOf(argument, line.words[at++]);
    if (!problem.empty()) {
      return line.verb + ": " + problem;
    }
    open_end = argument.kind == Argument::Kind::kWords;
  }
  if (at < line.words.size() && !open_end) {
    return "'" + line.verb + "' takes " + Usage(*action) + ", nothing after it: '" +
           line.words[at] + "'";
  }
  if (line.verb == "new_flight") {
    return UnknownFlight(line);
  }
  if (line.verb == "fault") {
    const Result<Fault> fault = ParseFault(line.words[0]);
    return fault ? std::string() : fault.error().message;
  }
  if (line.verb == "set" && line.words[0].rfind("simulation.", 0) == 0) {
    const Status possible = CheckChange({line.words[0], line.NumberAt(1)});
    return possible ? std::string() : possible.error().message;
  }
  if (line.verb == "set") {
    Settings trial;
    const Status possible = SetSettingValue(trial, line.words[0], line.NumberAt(1));
    return possible ? std::string() : possible.error().message;
  }
  return {};
}

}  // namespace

double ScriptLine::NumberAt(std::size_t index, double otherwise) const {
  return index < words.size() ? NumberIn(words[index]).value_or(otherwise) : otherwise;
}

Result<std::vector<ScriptLine>> ParseScript(std::string_view text, const std::string& name) {
  std::vector<ScriptLine> lines;
  std::istringstream stream{std::string(text)};
  int number = 0;
  for (std::string raw; std::getline(stream, raw);) {
    ++number;
    std::istringstream words(raw.substr(0, raw.find('#')));
    ScriptLine line;
    line.number = number;
    line.text = raw;
    if (!(words >> line.verb)) {
      continue;
    }
    for (std::string word; words >> word;) {
      line.words.push_back(word);
    }
    const std::string problem = Problem(line);
    if (!problem.empty()) {
      return UsageError(name + ":" + std::to_string(number) + ": " + problem);
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

Result<std::vector<ScriptLine>> LoadScript(const std::string& path) {
  const Result<std::string> text = ReadTextFile(path);
  return text ? ParseScript(*text, path) : UsageError("script " + text.error().message);
}

}  // namespace palace
