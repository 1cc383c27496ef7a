// Scripts: drive the real window by item name, one action a line (README, "Scripts").
#pragma once

#include <cmath>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/result.h"
#include "engine/model/snapshot.h"
#include "gui/app/intent.h"
#include "gui/widgets/ui_frame.h"

namespace palace {

/// One checked line of a script.
struct ScriptLine {
  int number = 0;
  std::string verb;
  std::vector<std::string> words;
  std::string text;  ///< as written, for messages
  /// The word of that index, which was checked to be a number; where it was left out, `otherwise`.
  double NumberAt(std::size_t index, double otherwise = NAN) const;
};

/// Checks every line before anything runs: unknown verbs, missing, bad or surplus arguments are
/// errors that name file, line, argument, value and limit. '#' starts a comment.
Result<std::vector<ScriptLine>> ParseScript(std::string_view text, const std::string& name);
Result<std::vector<ScriptLine>> LoadScript(const std::string& path);

/// The input a script makes for one frame.
struct ScriptInput {
  ImVec2 mouse{-1, -1};
  bool mouse_down = false;
  std::optional<std::string> key;       ///< pressed this frame, e.g. "Space", "Shift+Escape"
  std::optional<std::string> hold_key;  ///< kept down this frame
  Intents intents;                      ///< of `set`, `seek`, `run_to`, `speed` and `screenshot`
  std::optional<std::pair<int, int>> resize;
};

/// Runs one script against the window, a frame at a time. Times are those of the UI clock.
class ScriptRunner {
 public:
  ScriptRunner(std::vector<ScriptLine> lines, std::string name);

  /// To be called before each frame with what the last frame drew.
  ScriptInput Tick(const ItemRecord& items, const EngineSnapshot* snapshot, double ui_time_s);
  /// What to feed while a picture is being taken: the mouse stays, nothing else happens.
  ScriptInput Rest() const;
  bool done() const { return done_; }
  /// The lines that were not begun: another flight goes on with them.
  std::vector<ScriptLine> Left() const;
  /// Set when a line failed: file, line, text and what was found instead.
  const std::string& error() const { return error_; }

 private:
  /// One input, kept for a time; 0: for one frame.
  struct Gesture {
    ScriptInput input;
    double seconds = 0;
  };
  void Begin(const ScriptLine& line, const ItemRecord& items, const EngineSnapshot* snapshot);
  void Wait(const ScriptLine& line, const ItemRecord& items, const EngineSnapshot* snapshot);
  void Expect(const ScriptLine& line, const ItemRecord& items, const EngineSnapshot* snapshot);
  void Point(const ScriptLine& line, const ItemRecord& items);
  /// Presses Tab, or Down in a list, until the item has the focus.
  void MoveFocus(const ScriptLine& line, const ItemRecord& items);
  void Press(ImVec2 from, ImVec2 to, double seconds);
  void Fail(const ScriptLine& line, const std::string& found);
  /// Once it is not there for longer than the screen may take to draw it.
  void FailAbsent(const ScriptLine& line);
  void Next() {
    ++next_;
    started_ = false;
  }

  std::vector<ScriptLine> lines_;
  std::string name_;
  std::size_t next_ = 0;
  bool started_ = false;
  int taps_ = 0;  // pressed for the line under way
  double start_s_ = 0;
  double now_s_ = 0;
  std::deque<Gesture> pending_;     // what is left of the gesture under way
  std::optional<Gesture> current_;  // kept for its time
  double current_since_s_ = 0;
  ImVec2 mouse_{-1, -1};
  bool done_ = false;
  std::string error_;
};

/// The mission a scripted operator flies when nobody says otherwise.
std::string_view DefaultMissionScript();
/// What a headless run without a script does with a log, pictures or a bus: looks, photographs,
/// ends.
std::string_view DefaultViewScript();

}  // namespace palace
