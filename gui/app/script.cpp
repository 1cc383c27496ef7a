#include "gui/app/script.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

namespace palace {
namespace {

constexpr double kDefaultWait_s = 60;
constexpr int kDragFrames = 8;
constexpr int kMostTaps = 200;

/// Verbs, with the least and most words after them.
struct Grammar {
  int least;
  int most;
};
const std::map<std::string, Grammar>& Verbs() {
  static const std::map<std::string, Grammar> verbs = {
      {"wait", {2, 4}},   {"click", {1, 1}},      {"hover", {1, 1}},    {"hold", {2, 2}},
      {"set", {2, 2}},    {"key", {1, 1}},        {"hold_key", {2, 2}}, {"drag", {3, 3}},
      {"expect", {2, 9}}, {"screenshot", {1, 1}}, {"resize", {2, 2}},   {"speed", {1, 1}},
      {"seek", {1, 1}},   {"quit", {0, 0}},       {"tab_to", {1, 1}},   {"down_to", {1, 1}},
  };
  return verbs;
}

std::optional<double> Number(const std::string& word) {
  double value = 0;
  const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (problem != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

/// Which words of a verb must be numbers, counted from 0.
std::vector<std::size_t> NumberWords(const ScriptLine& line) {
  if (line.verb == "hold" || line.verb == "set" || line.verb == "hold_key") return {1};
  if (line.verb == "drag") return {1, 2};
  if (line.verb == "resize") return {0, 1};
  if (line.verb == "speed" || line.verb == "seek") return {0};
  if (line.verb == "wait" && line.words[0] == "seconds") return {1};
  if (line.verb == "wait" && line.words.size() > 2 && line.words[0] != "item") return {2};
  return {};
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
    if ((", " + known + ",").find(", " + choice + ",") == std::string::npos) {
      return "unknown state '" + choice + "'; states are " + known;
    }
  }
  return {};
}

std::string Problem(const ScriptLine& line) {
  const auto verb = Verbs().find(line.verb);
  if (verb == Verbs().end()) {
    return "unknown action '" + line.verb + "'";
  }
  const int words = static_cast<int>(line.words.size());
  if (words < verb->second.least || words > verb->second.most) {
    return "'" + line.verb + "' takes " + std::to_string(verb->second.least) + " to " +
           std::to_string(verb->second.most) + " arguments";
  }
  if ((line.verb == "wait" || line.verb == "expect") && line.words[0] != "state" &&
      line.words[0] != "seconds" && line.words[0] != "item" && line.words[0] != "height" &&
      line.words[0] != "text") {
    return "'" + line.verb + "' takes state, seconds, item, height or text, not '" + line.words[0] +
           "'";
  }
  for (const std::size_t index : NumberWords(line)) {
    if (!Number(line.words[index])) {
      return "'" + line.words[index] + "' is not a number";
    }
  }
  if (line.verb == "set") {
    Settings trial;
    const Status possible = SetSettingValue(trial, line.words[0], *Number(line.words[1]));
    return possible ? std::string() : possible.error().message;
  }
  if ((line.verb == "wait" || line.verb == "expect") && line.words[0] == "state") {
    return UnknownState(line.words[1]);
  }
  return {};
}

std::string StateOf(const EngineSnapshot* snapshot) {
  return snapshot ? MissionStateName(snapshot->flight->mission.state) : "none";
}

/// "HOLD|PROPOSED" matches either.
bool StateMatches(const std::string& wanted, const std::string& state) {
  std::istringstream choices(wanted);
  for (std::string choice; std::getline(choices, choice, '|');) {
    if (choice == state) {
      return true;
    }
  }
  return false;
}

double WordOr(const ScriptLine& line, std::size_t index, double fallback) {
  return index < line.words.size() ? Number(line.words[index]).value_or(fallback) : fallback;
}

}  // namespace

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
  std::error_code none;
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file || std::filesystem::is_directory(path, none)) {
    return UsageError("script " + path + " cannot be read; check the name");
  }
  return ParseScript(text.str(), path);
}

ScriptRunner::ScriptRunner(std::vector<ScriptLine> lines, std::string name)
    : lines_(std::move(lines)), name_(std::move(name)) {}

void ScriptRunner::Fail(const ScriptLine& line, const std::string& found) {
  error_ = name_ + ":" + std::to_string(line.number) + ": '" + line.text + "' failed: " + found;
  done_ = true;
}

ScriptInput ScriptRunner::Tick(const ItemRecord& items, const EngineSnapshot* snapshot,
                               double ui_time_s) {
  now_s_ = ui_time_s;
  if (current_ && current_->seconds > 0 && now_s_ - current_since_s_ < current_->seconds) {
    return current_->input;
  }
  current_.reset();
  if (pending_.empty() && !done_) {
    if (next_ >= lines_.size()) {
      done_ = true;
    } else {
      Begin(lines_[next_], items, snapshot);
    }
  }
  if (pending_.empty()) {
    return Rest();
  }
  current_ = std::move(pending_.front());
  pending_.pop_front();
  current_since_s_ = now_s_;
  mouse_ = current_->input.mouse;
  return current_->input;
}

ScriptInput ScriptRunner::Rest() const {
  ScriptInput rest;
  rest.mouse = mouse_;
  return rest;
}

void ScriptRunner::Begin(const ScriptLine& line, const ItemRecord& items,
                         const EngineSnapshot* snapshot) {
  if (!started_) {
    started_ = true;
    start_s_ = now_s_;
    taps_ = 0;
  }
  ScriptInput input;
  input.mouse = mouse_;
  if (line.verb == "wait") {
    Wait(line, items, snapshot);
  } else if (line.verb == "expect") {
    Expect(line, items, snapshot);
  } else if (line.verb == "click" || line.verb == "hover" || line.verb == "hold" ||
             line.verb == "drag") {
    Point(line, items);
  } else if (line.verb == "tab_to" || line.verb == "down_to") {
    MoveFocus(line, items);
  } else if (line.verb == "quit") {
    done_ = true;
  } else {
    if (line.verb == "key") {
      input.key = line.words[0];
      pending_.push_back({input});
      input.key.reset();  // let go: the same key may be pressed again
    } else if (line.verb == "hold_key") {
      input.hold_key = line.words[0];
      pending_.push_back({input, *Number(line.words[1])});
      input.hold_key.reset();
    } else if (line.verb == "set") {
      input.intents.emplace_back(CommandAction(SetSetting{line.words[0], *Number(line.words[1])}));
    } else if (line.verb == "screenshot") {
      input.intents.emplace_back(UiAction(TakeScreenshot{line.words[0]}));
    } else if (line.verb == "resize") {
      input.resize = {static_cast<int>(*Number(line.words[0])),
                      static_cast<int>(*Number(line.words[1]))};
    } else {
      const auto kind =
          line.verb == "seek" ? PlaybackControl::Kind::kSeek : PlaybackControl::Kind::kSpeed;
      input.intents.emplace_back(PlaybackControl{kind, *Number(line.words[0])});
    }
    pending_.push_back({input});
    Next();
  }
}

void ScriptRunner::MoveFocus(const ScriptLine& line, const ItemRecord& items) {
  const Item* focus = items.Find("focus");
  const std::string at = focus ? focus->text : "nothing";
  if (at == line.words[0]) {
    Next();
    return;
  }
  const std::string key = line.verb == "tab_to" ? "Tab" : "Down";
  if (++taps_ > kMostTaps) {
    Fail(line, key + " does not reach it; the focus is on " + at);
    return;
  }
  ScriptInput input;
  input.mouse = mouse_;
  input.key = key;
  pending_.push_back({input});
  pending_.push_back({Rest()});  // the ring is drawn one frame later
}

void ScriptRunner::Wait(const ScriptLine& line, const ItemRecord& items,
                        const EngineSnapshot* snapshot) {
  const std::string& what = line.words[0];
  bool met = false;
  double limit_s = WordOr(line, 2, kDefaultWait_s);
  std::string found;
  if (what == "seconds") {
    met = now_s_ - start_s_ >= *Number(line.words[1]);
    limit_s = INFINITY;
  } else if (what == "state") {
    found = "the state is " + StateOf(snapshot);
    met = StateMatches(line.words[1], StateOf(snapshot));
  } else if (what == "height") {
    const double height = snapshot ? snapshot->flight->mission.height_above_site_m : NAN;
    found = "the height above the site is " + std::to_string(height) + " m";
    met = height <= Number(line.words[1]).value_or(-INFINITY);
  } else {
    const Item* item = items.Find(line.words[1]);
    found = item ? "it is disabled: " + item->text : "nothing of that name is on the screen";
    met = item != nullptr && item->enabled;
  }
  if (met) {
    Next();
  } else if (now_s_ - start_s_ > limit_s) {
    Fail(line, found + " after " + std::to_string(static_cast<int>(limit_s)) + " s");
  }
}

void ScriptRunner::Expect(const ScriptLine& line, const ItemRecord& items,
                          const EngineSnapshot* snapshot) {
  const std::string& what = line.words[0];
  if (what == "state" && !StateMatches(line.words[1], StateOf(snapshot))) {
    return Fail(line, "the state is " + StateOf(snapshot));
  }
  if (what == "item" || what == "text") {
    const Item* item = items.Find(line.words[1]);
    if (item == nullptr) {
      return Fail(line, "nothing of that name is on the screen");
    }
    std::string wanted;
    for (std::size_t i = 2; i < line.words.size(); ++i) {
      wanted += (i > 2 ? " " : "") + line.words[i];
    }
    if (item->text.find(wanted) == std::string::npos) {
      return Fail(line, "it reads '" + item->text + "'");
    }
  }
  Next();
}

void ScriptRunner::Point(const ScriptLine& line, const ItemRecord& items) {
  const Item* item = items.Find(line.words[0]);
  if (item == nullptr) {
    return Fail(line, "nothing of that name is on the screen");
  }
  if (!item->enabled && line.verb != "hover") {
    return Fail(line, "it is disabled: " + item->text);
  }
  const ImVec2 centre = item->rect.centre();
  if (line.verb == "hover") {
    ScriptInput input;
    input.mouse = centre;
    pending_.push_back({input});
  } else if (line.verb == "drag") {
    Press(centre,
          {centre.x + static_cast<float>(*Number(line.words[1])),
           centre.y + static_cast<float>(*Number(line.words[2]))},
          0);
  } else {
    Press(centre, centre, line.verb == "hold" ? *Number(line.words[1]) : 0);
  }
  Next();
}

void ScriptRunner::Press(ImVec2 from, ImVec2 to, double seconds) {
  ScriptInput input;
  input.mouse = from;
  pending_.push_back({input});  // arrive first: a press is only taken where the mouse already is
  input.mouse_down = true;
  pending_.push_back({input, seconds});
  if (from.x != to.x || from.y != to.y) {
    for (int i = 1; i <= kDragFrames; ++i) {
      const float t = static_cast<float>(i) / kDragFrames;
      input.mouse = {from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)};
      pending_.push_back({input});
    }
  }
  input.mouse_down = false;
  pending_.push_back({input});
}

}  // namespace palace
