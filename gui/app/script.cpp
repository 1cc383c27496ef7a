#include "gui/app/script.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "engine/core/text.h"
#include "engine/simulation/vehicle_file.h"

namespace palace {
namespace {

constexpr double kDefaultWait_s = 60;
constexpr double kDrawn_s = 0.5;  // until what a click opens is on the screen
constexpr int kDragFrames = 8;
constexpr int kMostTaps = 200;

std::string StateOf(const EngineSnapshot* snapshot) {
  return snapshot ? MissionStateName(snapshot->flight->mission.state) : "none";
}

/// Above the site; NaN while there is none.
double HeightOf(const EngineSnapshot* snapshot) {
  return snapshot ? snapshot->flight->mission.height_above_site_m : NAN;
}

std::string HeightWords(const EngineSnapshot* snapshot) {
  const double height_m = HeightOf(snapshot);
  return std::isfinite(height_m) ? WithNumbers("the height above the site is %.1f m", height_m)
                                 : std::string("the height above the site is not known");
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

}  // namespace

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

std::vector<ScriptLine> ScriptRunner::Left() const {
  return {lines_.begin() + static_cast<std::ptrdiff_t>(std::min(next_, lines_.size())),
          lines_.end()};
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
      pending_.push_back({input, line.NumberAt(1)});
      input.hold_key.reset();
    } else if (line.verb == "set" && FindSimulationRow(line.words[0]) != nullptr) {
      input.intents.emplace_back(SimulationChange{line.words[0], line.NumberAt(1)});
    } else if (line.verb == "set") {
      input.intents.emplace_back(CommandAction(SetSetting{line.words[0], line.NumberAt(1)}));
    } else if (line.verb == "fault") {
      input.intents.emplace_back(UiAction(InjectFault{line.words[0]}));
    } else if (line.verb == "end_fault") {
      input.intents.emplace_back(UiAction(EndFault{static_cast<int>(line.NumberAt(0))}));
    } else if (line.verb == "new_flight") {
      const FlightChoice choice{line.words[0], static_cast<std::uint64_t>(line.NumberAt(1, 1)),
                                line.words.size() > 2 ? line.words[2] : kDefaultVehicle};
      input.intents.emplace_back(
          UiAction(NextFlight{.kind = NextFlight::Kind::kFlyAgain, .choice = choice}));
    } else if (line.verb == "screenshot") {
      input.intents.emplace_back(UiAction(TakeScreenshot{line.words[0]}));
    } else if (line.verb == "resize") {
      input.resize = {static_cast<int>(line.NumberAt(0)), static_cast<int>(line.NumberAt(1))};
    } else {
      const auto kind = line.verb == "seek"     ? PlaybackControl::Kind::kSeek
                        : line.verb == "run_to" ? PlaybackControl::Kind::kRunTo
                                                : PlaybackControl::Kind::kSpeed;
      input.intents.emplace_back(PlaybackControl{kind, line.NumberAt(0)});
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
  double limit_s = line.NumberAt(2, kDefaultWait_s);
  std::string found;
  if (what == "seconds") {
    met = now_s_ - start_s_ >= line.NumberAt(1);
    limit_s = INFINITY;
  } else if (what == "state") {
    found = "the state is " + StateOf(snapshot);
    met = StateMatches(line.words[1], StateOf(snapshot));
  } else if (what == "height") {
    found = HeightWords(snapshot);
    met = HeightOf(snapshot) <= line.NumberAt(1);
  } else if (what == "time") {
    const double time_s = snapshot ? snapshot->session->source.position_s : 0;
    found = WithNumbers("the time is %.1f s", time_s);
    met = time_s >= line.NumberAt(1) - 1e-6;
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
  if (what == "height" && !(HeightOf(snapshot) <= line.NumberAt(1))) {
    return Fail(line, HeightWords(snapshot));
  }
  if (what == "item" || what == "text") {
    const Item* item = items.Find(line.words[1]);
    if (item == nullptr) {
      return FailAbsent(line);
    }
    if (what == "item" && !item->enabled) {
      return Fail(line, "it is disabled: " + item->text);
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

void ScriptRunner::FailAbsent(const ScriptLine& line) {
  if (now_s_ > start_s_ + kDrawn_s) {
    Fail(line, "nothing of that name is on the screen");
  }
}

void ScriptRunner::Point(const ScriptLine& line, const ItemRecord& items) {
  const Item* item = items.Find(line.words[0]);
  if (item == nullptr) {
    return FailAbsent(line);
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
          {centre.x + static_cast<float>(line.NumberAt(1)),
           centre.y + static_cast<float>(line.NumberAt(2))},
          0);
  } else {
    Press(centre, centre, line.verb == "hold" ? line.NumberAt(1) : 0);
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
