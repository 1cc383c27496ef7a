// Focus: the control that the keyboard works, and the order in which Tab goes through them.
//
// Controls offer themselves each frame, as they are drawn. Tab and Shift+Tab go through the groups,
// lowest first, and within one as drawn. The controls of a list are one stop: Tab enters it where
// it was left, Up and Down go through it. The ring is shown once a key has moved the focus and
// hidden by the mouse; without the ring no key reaches a control.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace palace {

/// Groups of Tab: what is decided on, what is looked at, what every workspace has.
enum TabGroup { kDecisionTabs, kViewTabs, kFrameTabs };

/// Where the controls drawn now stand in the order of Tab.
struct TabPlace {
  TabGroup group = kDecisionTabs;
  std::string_view list{};  ///< empty: each control is a stop of its own
};

/// Keys that a control answers to while it has the focus, as bits.
enum FocusKeys : unsigned {
  kPressKeys = 1,   ///< Enter and Space
  kSideKeys = 2,    ///< Left and Right, with Shift too
  kUpDownKeys = 4,  ///< Up and Down, with Shift too
  kDeleteKeys = 8,  ///< Backspace and Delete
};

/// What the keyboard asked of the focus in one frame.
struct FocusStep {
  int tab = 0;      ///< +1: Tab, -1: Shift+Tab
  int up_down = 0;  ///< +1: Down, -1: Up
  bool mouse_pressed = false;
};

class Focus {
 public:
  /// Name of the control with the ring; empty: none.
  std::string_view shown() const { return shown_ ? std::string_view(name_) : std::string_view(); }
  bool Has(std::string_view name) const { return shown_ && name == name_; }
  /// Gives a control the ring.
  void Show(std::string_view name);
  /// The next Tab lands on this control; no ring until then.
  void TabLandsOn(std::string_view name);
  /// A mouse press on a control: Tab goes on from there.
  void PressedByMouse(std::string_view name);
  void Clear();

  /// The focused control takes this key in this frame; the key table leaves it alone. Keys are
  /// spelled as there: "Enter", "Shift+Left".
  bool Owns(std::string_view keys) const;
  /// A hold took the Escape of this frame; nothing else does.
  void TakeEscape() { escape_taken_ = true; }
  bool escape_taken() const { return escape_taken_; }

  // ---- once a frame, by the canvas and by Interact ------------------------------------------
  void BeginFrame();
  void Offer(std::string_view name, const TabPlace& place, unsigned keys);
  void EndFrame(const FocusStep& step);

 private:
  struct Stop {
    std::string name;
    TabGroup group = kDecisionTabs;
    std::string list;
  };
  void Sort();
  void StepTab(int step);
  void StepInList(int step);
  std::string EntryOf(std::size_t first) const;

  std::string name_;
  bool shown_ = false;
  bool lands_here_ = false;
  bool press_taken_ = false;
  bool escape_taken_ = false;
  unsigned keys_ = 0;
  std::vector<Stop> stops_;
  std::map<std::string, std::string> left_at_;  // list -> the control it was left at
};

}  // namespace palace
