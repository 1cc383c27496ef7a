#include "gui/widgets/focus.h"

#include <algorithm>

namespace palace {

void Focus::Show(std::string_view name) {
  name_ = name;
  shown_ = !name.empty();
  lands_here_ = false;
}

void Focus::TabLandsOn(std::string_view name) {
  name_ = name;
  shown_ = false;
  lands_here_ = true;
}

void Focus::PressedByMouse(std::string_view name) {
  name_ = name;
  shown_ = lands_here_ = false;
  press_taken_ = true;
}

void Focus::Clear() {
  name_.clear();
  shown_ = lands_here_ = false;
}

bool Focus::Owns(std::string_view keys) const {
  if (!shown_) {
    return false;
  }
  constexpr std::string_view kShift = "Shift+";
  const bool shift = keys.substr(0, kShift.size()) == kShift;
  const std::string_view base = shift ? keys.substr(kShift.size()) : keys;
  if (base == "Enter" || base == "Space") {
    return (keys_ & kPressKeys) != 0 && !shift;
  }
  if (base == "Left" || base == "Right") {
    return (keys_ & kSideKeys) != 0;
  }
  if (base == "Up" || base == "Down") {
    return (keys_ & kUpDownKeys) != 0;
  }
  return (base == "Backspace" || base == "Delete") && (keys_ & kDeleteKeys) != 0;
}

void Focus::BeginFrame() {
  stops_.clear();
  keys_ = 0;
  press_taken_ = escape_taken_ = false;
}

void Focus::Offer(std::string_view name, const TabPlace& place, unsigned keys) {
  stops_.push_back({std::string(name), place.group, std::string(place.list)});
  if (Has(name)) {
    keys_ = keys | (place.list.empty() ? 0U : unsigned{kUpDownKeys});
    if (!place.list.empty()) {
      left_at_[std::string(place.list)] = name_;
    }
  }
}

void Focus::EndFrame(const FocusStep& step) {
  Sort();
  if (step.mouse_pressed && !press_taken_) {
    Clear();
  }
  if (step.tab != 0) {
    StepTab(step.tab);
  } else if (step.up_down != 0) {
    StepInList(step.up_down);
  }
}

void Focus::Sort() {
  std::stable_sort(stops_.begin(), stops_.end(),
                   [](const Stop& a, const Stop& b) { return a.group < b.group; });
}

/// The control at which Tab enters the list that begins at `first`, or that control itself.
std::string Focus::EntryOf(std::size_t first) const {
  const Stop& stop = stops_[first];
  const auto left = left_at_.find(stop.list);
  if (!stop.list.empty() && left != left_at_.end() &&
      std::any_of(stops_.begin(), stops_.end(),
                  [&](const Stop& s) { return s.list == stop.list && s.name == left->second; })) {
    return left->second;
  }
  return stop.name;
}

void Focus::StepTab(int step) {
  std::vector<std::size_t> entries;  // first of each list, and every control outside lists
  int at = -1;
  for (std::size_t i = 0; i < stops_.size(); ++i) {
    const bool inside = i > 0 && !stops_[i].list.empty() && stops_[i].list == stops_[i - 1].list;
    if (!inside) {
      entries.push_back(i);
    }
    if (stops_[i].name == name_ && !name_.empty()) {
      at = static_cast<int>(entries.size()) - 1;
    }
  }
  if (entries.empty()) {
    return;
  }
  const int count = static_cast<int>(entries.size());
  if (at < 0) {
    at = step > 0 ? 0 : count - 1;
  } else if (lands_here_) {
    Show(std::string(name_));
    return;
  } else {
    at = (at + step + count) % count;
  }
  Show(EntryOf(entries[static_cast<std::size_t>(at)]));
}

void Focus::StepInList(int step) {
  const auto at =
      std::find_if(stops_.begin(), stops_.end(), [&](const Stop& stop) { return Has(stop.name); });
  if (at == stops_.end() || at->list.empty()) {
    return;
  }
  const auto index = (at - stops_.begin()) + step;
  if (index < 0 || index >= static_cast<std::ptrdiff_t>(stops_.size())) {
    return;
  }
  const Stop& next = stops_[static_cast<std::size_t>(index)];
  if (next.list == at->list) {
    Show(next.name);
  }
}

}  // namespace palace
