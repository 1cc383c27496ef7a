#include "gui/app/keys.h"

#include <algorithm>
#include <functional>

#include "gui/panels/alarm_look.h"
#include "gui/panels/session_words.h"

namespace palace {
namespace {

constexpr double kSmallStep_s = 0.1;
constexpr double kLargeStep_s = 1;
constexpr double kScaleStep = 0.25;
constexpr double kMinSpeed = 0.05, kMaxSpeed = 20;
constexpr double kMinSimulated = 0.1, kMaxSimulated = 50;

struct Context {
  const EngineSnapshot* snapshot;
  const UiState& state;
};
struct Row {
  KeyBinding binding;
  std::function<Intents(const Context&)> intents;
};

Intents Play(PlaybackControl::Kind kind, double value = 0) {
  return {PlaybackControl{kind, value}};
}
Intents Ui(UiAction action) { return {std::move(action)}; }

/// Arrow keys pause first, then move.
Intents SeekBy(const Context& c, double seconds) {
  if (!c.snapshot || !c.snapshot->session->source.can_seek) {
    return {};
  }
  const double to = std::max(0.0, c.snapshot->session->source.position_s + seconds);
  return {PlaybackControl{PlaybackControl::Kind::kPause, 0},
          PlaybackControl{PlaybackControl::Kind::kSeek, to}};
}

Intents ScaleSpeed(const Context& c, double factor) {
  if (!c.snapshot || !CanBePaused(*c.snapshot)) {
    return {};
  }
  const double speed = c.snapshot->session->source.speed;
  const bool simulated = IsSimulation(*c.snapshot);
  return Play(PlaybackControl::Kind::kSpeed,
              std::clamp((speed > 0 ? speed : 1) * factor, simulated ? kMinSimulated : kMinSpeed,
                         simulated ? kMaxSimulated : kMaxSpeed));
}

/// What the keys of the transport ask of a source that obeys them; of one that is alive, nothing.
Intents Play(const Context& c, PlaybackControl::Kind kind, double value = 0) {
  return c.snapshot && CanBePaused(*c.snapshot) ? Play(kind, value) : Intents{};
}

Intents PlayOrPause(const Context& c) {
  return Play(c, c.snapshot && IsPlaying(*c.snapshot) ? PlaybackControl::Kind::kPause
                                                      : PlaybackControl::Kind::kPlay);
}

/// Of the loop of Review; elsewhere nothing.
Intents OfLoop(const Context& c, std::function<UiAction(double at_s)> action) {
  const bool may = c.snapshot && c.state.frame.workspace == Workspace::kReview &&
                   c.snapshot->session->source.can_seek;
  return may ? Ui(action(c.snapshot->session->source.position_s)) : Intents{};
}

/// As the button of that name, where it stands.
Intents HoldThere(const Context& c) {
  if (!c.snapshot || !c.snapshot->session->can_transmit) {
    return {};
  }
  const MissionStatus& m = c.snapshot->flight->mission;
  return IsFlying(m.state) || m.going ? Intents{CommandAction(HoldHere{})} : Intents{};
}

/// As the button of the alarm strip.
Intents AcknowledgeFirst(const Context& c) {
  if (!c.snapshot || FollowsRecord(c.snapshot->session->role)) {
    return {};
  }
  for (const Alarm& alarm : c.snapshot->flight->mission.alarms) {
    if (WaitsForAnswer(alarm) && !IsShelved(c.state.frame, alarm)) {
      return {CommandAction(AcknowledgeAlarm{alarm.id})};
    }
  }
  return {};
}

/// Keys of the views of Simulate; elsewhere they do nothing.
std::vector<Row> WorldViewRows() {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < kWorldEyes; ++i) {
    const auto eye = static_cast<WorldEye>(i);
    rows.push_back({{std::to_string(i + 1), std::string("In Simulate: ") + EyeWords(eye)},
                    [eye](const Context& c) {
                      return c.state.frame.workspace == Workspace::kSimulate
                                 ? Ui(ShowWorldView{eye})
                                 : Intents{};
                    }});
  }
  return rows;
}

std::vector<Row> MakeRows() {
  using K = PlaybackControl::Kind;
  const auto always = [](Intents intents) { return [intents](const Context&) { return intents; }; };
  const auto play = [](K kind, double value = 0) {
    return [=](const Context& c) { return Play(c, kind, value); };
  };
  return {
      {{"Shift+Escape", "Wave off", false, true, true}, always({CommandAction(WaveOff{})})},
      {{"Shift+H", "Hold here: end the descent or the way"}, HoldThere},
      {{"A", "Acknowledge the first alarm that waits for it"}, AcknowledgeFirst},
      {{"F2", "Show Fly", false, false, true}, always(Ui(ShowWorkspace{Workspace::kFly}))},
      {{"F3", "Show Tune", false, false, true}, always(Ui(ShowWorkspace{Workspace::kTune}))},
      {{"F4", "Show Review", false, false, true}, always(Ui(ShowWorkspace{Workspace::kReview}))},
      {{"F5", "Show Diagnose", false, false, true},
       always(Ui(ShowWorkspace{Workspace::kDiagnose}))},
      {{"F6", "Show Simulate", false, false, true},
       [](const Context& c) {
         return c.snapshot && IsSimulation(*c.snapshot) ? Ui(ShowWorkspace{Workspace::kSimulate})
                                                        : Intents{};
       }},
      {{"F1", "Show or close this list", false, true, true},
       [](const Context& c) { return Ui(ShowKeyHelp{!c.state.key_help}); }},
      {{"Escape", "Cancel a hold, close what is open", false, true}, always(Ui(CloseTop{}))},
      {{"Space", "Play or pause, or as Enter"}, PlayOrPause},
      {{"Left", "Step back 0.1 s", true},
       [](const Context& c) { return SeekBy(c, -kSmallStep_s); }},
      {{"Right", "Step forward 0.1 s", true},
       [](const Context& c) { return SeekBy(c, kSmallStep_s); }},
      {{"Shift+Left", "Step back 1 s", true},
       [](const Context& c) { return SeekBy(c, -kLargeStep_s); }},
      {{"Shift+Right", "Step forward 1 s", true},
       [](const Context& c) { return SeekBy(c, kLargeStep_s); }},
      {{"Ctrl+Left", "Previous frame", true}, play(K::kStepBack)},
      {{"Ctrl+Right", "Next frame", true}, play(K::kStepForward)},
      {{",", "Previous frame", true}, play(K::kStepBack)},
      {{".", "Next frame", true}, play(K::kStepForward)},
      {{"Home", "Go to the start"}, play(K::kSeek)},
      {{"End", "Go to the end"},
       [](const Context& c) {
         return c.snapshot && c.snapshot->session->source.duration_s
                    ? Play(K::kSeek, *c.snapshot->session->source.duration_s)
                    : Intents{};
       }},
      {{"[", "Half speed", true}, [](const Context& c) { return ScaleSpeed(c, 0.5); }},
      {{"]", "Double speed", true}, [](const Context& c) { return ScaleSpeed(c, 2); }},
      {{"\\", "Normal speed"}, play(K::kSpeed, 1)},
      {{"I", "In Review: the loop begins here"},
       [](const Context& c) {
         return OfLoop(c, [](double at_s) { return SetLoop{LoopEdge::kIn, at_s}; });
       }},
      {{"O", "In Review: the loop ends here"},
       [](const Context& c) {
         return OfLoop(c, [](double at_s) { return SetLoop{LoopEdge::kOut, at_s}; });
       }},
      {{"L", "In Review: loop on or off"},
       [](const Context& c) { return OfLoop(c, [](double) { return ToggleLoop{}; }); }},
      {{"D", "Deselect the site"},
       [](const Context& c) {
         const bool armed = c.snapshot && c.snapshot->flight->mission.state == MissionState::kArmed;
         return armed ? Intents{CommandAction(DisarmSite{})} : Intents{};
       }},
      {{"Ctrl+N", "End a review: back to flying"},
       [](const Context& c) {
         const bool record = c.snapshot && FollowsRecord(c.snapshot->session->role);
         return record ? Ui(NextFlight{NextFlight::Kind::kFlyAgain}) : Intents{};
       }},
      {{"T", "Show or hide the track view"}, always(Ui(ToggleTrackView{}))},
      {{"B", "Bookmark now"}, always({CommandAction(AddBookmark{})})},
      {{"Ctrl+Z", "Undo the last limit change", true}, always(Ui(UndoSetting{}))},
      {{"Ctrl+Shift+Z", "Redo it", true}, always(Ui(RedoSetting{}))},
      {{"Ctrl+Y", "Redo it", true}, always(Ui(RedoSetting{}))},
      {{"Ctrl+S", "Save the limits as a preset"}, always(Ui(ChoosePreset{PresetChoice::kSave}))},
      {{"F12", "Take a screenshot", false, false, true}, always(Ui(TakeScreenshot{}))},
      {{"Ctrl++", "Larger text", true},
       [](const Context& c) { return Ui(SetUiScale{c.state.scale + kScaleStep}); }},
      {{"Ctrl+-", "Smaller text", true},
       [](const Context& c) { return Ui(SetUiScale{c.state.scale - kScaleStep}); }},
      {{"Ctrl+0", "Normal text size"}, always(Ui(SetUiScale{1}))},
      {{"Ctrl+Q", "Quit", false, false, true}, always(Ui(QuitProgram{}))},
  };
}

const std::vector<Row>& Rows() {
  static const std::vector<Row> rows = [] {
    std::vector<Row> all = MakeRows();
    const std::vector<Row> views = WorldViewRows();
    all.insert(all.end(), views.begin(), views.end());
    return all;
  }();
  return rows;
}

}  // namespace

const std::vector<KeyBinding>& KeyTable() {
  static const std::vector<KeyBinding> table = [] {
    std::vector<KeyBinding> bindings;
    for (const Row& row : Rows()) {
      bindings.push_back(row.binding);
    }
    // Bound by the controls themselves (gui/widgets/interact.h): the one with the ring has them.
    bindings.push_back({"Tab", "Next control; the sites come first", true});
    bindings.push_back({"Shift+Tab", "Previous control", true});
    bindings.push_back({"Up", "Previous row of a list", true});
    bindings.push_back({"Down", "Next row of a list", true});
    bindings.push_back({"Enter", "Press the control, arm the site"});
    bindings.push_back({"Enter held", "Approve, with the ring on the button"});
    bindings.push_back({"Arrows", "Step a limit, a map's pin, the 3-D view"});
    bindings.push_back({"Shift+Arrows", "Ten steps"});
    bindings.push_back({"Backspace", "Reset the limit with the ring"});
    return bindings;
  }();
  return table;
}

Intents IntentsOfKey(std::string_view keys, const EngineSnapshot* snapshot, const UiState& state,
                     bool text_field_active) {
  const auto row = std::find_if(Rows().begin(), Rows().end(),
                                [&](const Row& r) { return r.binding.keys == keys; });
  if (row == Rows().end()) {
    return {};
  }
  if ((text_field_active && !row->binding.works_while_typing) ||
      ((state.key_help || state.leave_asked) && !row->binding.works_in_popup) ||
      state.focus.Owns(keys)) {
    return {};
  }
  return row->intents({snapshot, state});
}

}  // namespace palace
