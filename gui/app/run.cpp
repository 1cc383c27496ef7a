#include "gui/app/run.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <optional>
#include <utility>

#include <imgui.h>

#include "engine/core/files.h"
#include "engine/core/log.h"
#include "engine/core/time.h"
#include "engine/runtime/flight_summary.h"
#include "engine/runtime/limit_sweeper.h"
#include "gui/app/app.h"
#include "gui/app/dispatch.h"
#include "gui/app/exit_code.h"
#include "gui/app/fault_offers.h"
#include "gui/app/input.h"
#include "gui/app/keys.h"
#include "gui/app/refusal_watch.h"
#include "gui/app/report/flight_report.h"
#include "gui/app/surface.h"
#include "gui/app/view.h"
#include "gui/app/window_restarts.h"
#include "gui/panels/fly_panels.h"
#include "gui/platform/open_file.h"
#include "gui/platform/screenshot.h"

namespace palace {
namespace {

constexpr double kLockstepFrame_s = 0.1;  // of the UI clock, one engine pass
constexpr double kMinimisedWait_s = 0.1;
constexpr double kSlowFrame_ms = 20;

/// A step that is repeated by holding its key down; the rest waits for a new press.
bool MayRepeat(const std::string& keys) {
  const auto& table = KeyTable();
  const auto row =
      std::find_if(table.begin(), table.end(), [&](const KeyBinding& b) { return b.keys == keys; });
  return row == table.end() || row->repeats;
}

/// When a command of this frame is asked for: the mouse press under way is one gesture.
Gesture GestureNow(double ui_time_s) {
  const bool held = ImGui::IsMouseDown(0);
  return {ui_time_s, held ? ImGui::GetIO().MouseClickedTime[0] : NAN};
}

/// The world that is simulated here; null: none.
const World* WorldOf(const Session& session) { return session.scene ? &*session.scene : nullptr; }

class StationRun {
 public:
  StationRun(const AppOptions& options, const Termination& termination, Session& session,
             Surface& surface, std::unique_ptr<View> view, const WayOut& after_review,
             std::optional<ScriptRunner> script)
      : options_(options),
        termination_(termination),
        session_(session),
        surface_(surface),
        view_(std::move(view)),
        script_(std::move(script)),
        summarizer_(session.scene),
        start_s_(MonotonicSeconds()) {
    state_.after_review = after_review;
    state_.simulate.offered = FlightsOffered(options);
    state_.simulate.offered.faults = FaultsOffered();
    state_.simulate.choice = ChoiceOf(options);
    state_.scale = options.ui_scale > 0 ? options.ui_scale : surface.natural_scale();
    // A script says where it goes.
    const Workspace first = script_ ? Workspace::kFly : FirstWorkspace(options.source);
    state_.frame.workspace = options.workspace.value_or(first);
  }

  Status Run() {
    while (!state_.quit && !termination_.asked() && !(script_ && script_->done())) {
      const WindowInput input = surface_.Poll(WaitForInput());
      const bool more = !surface_.lockstep() || session_.engine->Step();
      const bool dead = surface_.lockstep() ? !more : session_.engine->Latest() == nullptr;
      if (dead && !session_.engine->error().empty()) {
        return UnavailableError(session_.engine->error());
      }
      if (const Status drawn = FrameSafely(input); !drawn) {
        return drawn;
      }
    }
    // A screenshot asked for by the last line of a script still waits for its frame.
    return surface_.lockstep() && !state_.screenshots_wanted.empty() ? Frame({}) : Ok();
  }

  const std::optional<NextFlight>& next() const { return state_.next; }
  std::vector<ScriptLine> script_left() const {
    return script_ && state_.next ? script_->Left() : std::vector<ScriptLine>();
  }
  std::string script_error() const { return script_ ? script_->error() : std::string(); }
  const FlightSummary& summary() const { return summarizer_.summary(); }
  const std::vector<ApprovalRecord>& approvals() const { return approvals_.all(); }
  const std::vector<std::string>& screenshots() const { return screenshots_; }

 private:
  /// A frame that throws, or whose graphics are gone, ends nothing: keys are obeyed, a wave-off
  /// among them, and the window is made anew.
  Status FrameSafely(const WindowInput& input) {
    std::string stopped;
    try {
      if (!restarts_.waiting() && !surface_.ContextLost()) {
        return Frame(input);
      }
      stopped = restarts_.waiting() ? "" : "the graphics were reset";
    } catch (const std::exception& error) {
      stopped = error.what();
    } catch (...) {
      stopped = "unknown exception";
    }
    ObeyKeys(input);
    if (!restarts_.waiting()) {
      LogError("Window stopped: " + stopped + ". It is opened anew.");
      if (const Status goes_on = restarts_.Stopped(stopped, MonotonicSeconds()); !goes_on) {
        return goes_on;
      }
    }
    // Without a window nobody waits, and the time of a flight is not that of a clock.
    const double now_s = surface_.lockstep() ? INFINITY : MonotonicSeconds();
    return restarts_.TakeTurn(now_s) ? DrawAnew() : Ok();
  }

  void ObeyKeys(const WindowInput& input) {
    Intents intents;
    AddKeys(input, {}, session_.engine->Latest().get(), intents);
    Dispatch(intents, CommandOrigin::kOperator, session_.engine->Latest().get(), {ui_time_s_, NAN},
             *session_.engine, state_);
  }

  Status DrawAnew() {
    view_.reset();
    if (const Status opened = surface_.Reopen(); !opened) {
      return opened;
    }
    Result<std::unique_ptr<View>> view =
        View::Create(options_.theme, WorldOf(session_), session_.body);
    if (!view) {
      return view.error();
    }
    view_ = std::move(*view);
    keys_down_.clear();
    ShowMessage(state_, "The window was opened anew: " + restarts_.reason(), ui_time_s_);
    return Ok();
  }

  /// When drawing is slow (software GL) the window takes a quarter of the time and leaves the rest
  /// to the engine: its frame rate yields first. Input ends the wait.
  double WaitForInput() const {
    if (surface_.minimised() || restarts_.waiting()) {
      return kMinimisedWait_s;
    }
    return frame_ms_ > kSlowFrame_ms && !pointer_.waiting()
               ? std::min(3e-3 * frame_ms_, kMinimisedWait_s)
               : 0;
  }

  /// Moves the UI clock on; returns by how much.
  double Tick() {
    const double before_s = ui_time_s_;
    // Without a window, time is that of the passes; a bus, though, keeps its own.
    const bool by_passes = surface_.lockstep() && session_.source->IsLockstep();
    ui_time_s_ = by_passes ? ui_time_s_ + kLockstepFrame_s : MonotonicSeconds() - start_s_;
    return ui_time_s_ - before_s;
  }

  Status Frame(const WindowInput& window_input) {
    const double started_s = MonotonicSeconds();
    const double dt_s = Tick();
    const auto snapshot = session_.engine->Latest();
    if (snapshot) {
      summarizer_.Add(*snapshot);
      approvals_.Add(*snapshot);
      if (const std::string refused = refusals_.Newest(*snapshot); !refused.empty()) {
        ShowMessage(state_, refused, ui_time_s_);
      }
    }
    // A picture shows the window as it was when it was asked for; the script waits for it.
    const bool photograph = !state_.screenshots_wanted.empty();
    ScriptInput input;
    if (script_) {
      input =
          photograph ? script_->Rest() : script_->Tick(view_->items(), snapshot.get(), ui_time_s_);
    }
    if (input.resize) {
      if (const Status sized = surface_.SetSize(input.resize->first, input.resize->second);
          !sized) {
        return sized;
      }
    }
    if (snapshot && state_.frame.workspace == Workspace::kTune) {
      Sweep(*snapshot, photograph);
    }
    Intents intents = Draw(snapshot.get(), input, window_input, dt_s, photograph);
    const Status saved = photograph ? SaveScreenshots() : Ok();
    // On a graphics card the rest is waiting for the display.
    const double drawn_s = MonotonicSeconds();
    surface_.Present();
    const double ended_s = surface_.DrawsInSoftware() ? MonotonicSeconds() : drawn_s;
    frame_ms_ = surface_.lockstep() ? 0 : (ended_s - started_s) * 1e3;
    AddKeys(window_input, input, snapshot.get(), intents);
    const CommandOrigin origin = script_ ? CommandOrigin::kScript : CommandOrigin::kOperator;
    Dispatch(intents, origin, snapshot.get(), GestureNow(ui_time_s_), *session_.engine, state_);
    RunFaults();
    if (std::exchange(state_.report_wanted, false)) {
      OpenReport();
    }
    return saved;
  }

  /// Without a window nobody waits for a sweep but a picture, which shows that of its own map.
  void Sweep(const EngineSnapshot& snapshot, bool photograph) {
    const SettingInfo& limit = *FindSetting(state_.tune.swept.limit);
    if (!surface_.lockstep()) {
      sweeper_.Ask(snapshot, limit, ui_time_s_);
      state_.tune.sweep = sweeper_.Latest();
    } else if (const auto request = SweepOf(snapshot, limit); request && photograph) {
      state_.tune.sweep =
          std::make_shared<const LimitSweep>(SweepLimit(*request, [] { return true; }));
    }
  }

  /// Injects and ends what was asked for, and lists what there is for the next frame.
  void RunFaults() {
    const std::vector<std::string> wanted = std::exchange(state_.faults_wanted, {});
    const std::vector<int> ended = std::exchange(state_.faults_ended, {});
    if (!session_.faulted) {
      return;
    }
    for (const std::string& text : wanted) {
      if (const Status injected = Inject(session_.faulted->faults(), text); !injected) {
        ShowMessage(state_, injected.error().message, ui_time_s_);
      }
    }
    for (const int number : ended) {
      session_.faulted->faults().End(number);
    }
    state_.simulate.faults = ListFaults(session_.faulted->faults());
  }

  /// The page as the flight stands now; it is written again at the end.
  void OpenReport() {
    const Status written =
        WriteFlightReport(options_, session_, summary(), approvals(), screenshots_);
    const std::filesystem::path page = session_.output_dir / "report.html";
    const Status opened = written ? OpenFile(page.string()) : written;
    ShowMessage(state_, opened ? "Report: " + page.string() : opened.error().message, ui_time_s_);
  }

  Intents Draw(const EngineSnapshot* snapshot, const ScriptInput& input,
               const WindowInput& window_input, double dt_s, bool photograph) {
    ViewFrame frame{surface_.width_px(), surface_.height_px(), ui_time_s_, frame_ms_};
    frame.window_focused = window_input.focused || script_.has_value();
    frame.complaint = session_.engine->Complaint();
    ImGuiBackend& backend = surface_.backend();
    backend.SetUiScale(View::FittingScale(frame.width_px, frame.height_px, state_.scale));
    std::optional<EngineSnapshot> flown;
    if (snapshot != nullptr && state_.frame.workspace == Workspace::kFly) {
      snapshot = &AsFlown(*snapshot, flown);
    }
    const bool pixels = photograph || !surface_.lockstep();
    if (pixels && snapshot) {
      // Offscreen no frame is drawn between two pictures: the 3-D view is where it glides to.
      view_->Upload(*snapshot, frame, state_, surface_.lockstep() ? INFINITY : dt_s);
    }
    backend.BeginFrame(surface_.lockstep() ? kLockstepFrame_s : 0, [&] {
      if (script_) {
        FeedScriptInput(input, keys_down_);
      } else {
        FeedShortTaps(window_input.keys, keys_down_);
        FeedPointer(window_input.pointer, pointer_);
      }
    });
    Intents intents = view_->Draw(snapshot, session_.record.get(), state_, backend.fonts(), frame);
    backend.EndFrame(view_->background(), pixels);
    return intents;
  }

  /// Appends what the keys of person and script ask for, and the script's own intents.
  void AddKeys(const WindowInput& window_input, const ScriptInput& input,
               const EngineSnapshot* snapshot, Intents& intents) const {
    const bool typing = ImGui::GetIO().WantTextInput;
    if (window_input.close_requested) {
      intents.push_back(UiAction(QuitProgram{}));
    }
    const auto add = [&](const std::string& keys) {
      const Intents of_key = IntentsOfKey(keys, snapshot, state_, typing);
      intents.insert(intents.end(), of_key.begin(), of_key.end());
    };
    for (const KeyEvent& event : window_input.keys) {
      const std::string name = KeyName(event);
      if (event.action == KeyAction::kPress ||
          (event.action == KeyAction::kRepeat && MayRepeat(name))) {
        add(name);
      }
    }
    intents.insert(intents.end(), input.intents.begin(), input.intents.end());
    if (input.key) {
      add(*input.key);
    }
  }

  Status SaveScreenshots() {
    if (const Status made = MakeFolder(session_.output_dir); !made) {
      return made;
    }
    const ImageRgba picture = surface_.ReadPixels();
    for (const std::string& wanted : state_.screenshots_wanted) {
      const std::string name = wanted.empty() ? "screenshot-" + TimeStampName() + ".png" : wanted;
      const Status saved = SavePng(picture, (session_.output_dir / name).string());
      if (!saved && script_) {
        return saved;
      }
      if (!script_) {
        ShowMessage(state_, saved ? "Screenshot saved: " + name : saved.error().message,
                    ui_time_s_);
      }
      if (saved) {
        screenshots_.push_back(name);
      }
    }
    state_.screenshots_wanted.clear();
    return Ok();
  }

  const AppOptions& options_;
  const Termination& termination_;
  Session& session_;
  Surface& surface_;
  std::unique_ptr<View> view_;
  std::optional<ScriptRunner> script_;
  FlightSummarizer summarizer_;
  RefusalWatch refusals_;
  LimitSweeper sweeper_;
  ApprovalRecords approvals_;
  UiState state_;
  double start_s_;
  double ui_time_s_ = 0;
  double frame_ms_ = 0;
  std::vector<ImGuiKey> keys_down_;
  PointerQueue pointer_;
  std::vector<std::string> screenshots_;
  WindowRestarts restarts_;
};

/// Without a window the figures go to the terminal; the report goes beside the log.
void Report(const AppOptions& options, const Session& session, const StationRun& run) {
  if (options.headless) {
    for (const std::string& line : SummaryLines(run.summary())) {
      std::printf("%s\n", line.c_str());
    }
  }
  const bool report = options.headless ? options.report : session.recorded;
  if (options.headless && options.source == SourceChoice::kReplay) {
    std::printf("Sites and maps as data: palacectl log rerun %s --out DIR\n",
                options.source_path.c_str());
    if (const std::string damage = session.source->Status().damage; !damage.empty()) {
      std::printf("The log is damaged: %s; palacectl log verify %s tells where\n", damage.c_str(),
                  options.source_path.c_str());
    }
  }
  if (report || (options.headless && !run.screenshots().empty())) {
    std::printf("Files: %s\n", session.output_dir.string().c_str());
  }
  if (!report) {
    return;
  }
  const Status written =
      WriteFlightReport(options, session, run.summary(), run.approvals(), run.screenshots());
  if (!written) {
    LogWarning(written.error().message);
  }
}

}  // namespace

StationEnd RunStation(const AppOptions& options, const Termination& termination, Session& session,
                      const WayOut& after_review, std::optional<std::vector<ScriptLine>> script,
                      const std::string& script_name) {
  const Result<std::unique_ptr<Surface>> surface = Surface::Open(options);
  Result<std::unique_ptr<View>> view =
      surface ? View::Create(options.theme, WorldOf(session), session.body)
              : Result<std::unique_ptr<View>>(surface.error());
  if (!view) {
    const Status ignored = session.engine->Stop();
    return {FailWith(view.error())};
  }
  std::optional<ScriptRunner> runner;
  if (script) {
    runner.emplace(std::move(*script), script_name);
  }
  if (options.headless) {
    session.source->Control({PlaybackControl::Kind::kSpeed, 0});
  } else {
    session.engine->Start();
  }
  StationRun run(options, termination, session, **surface, std::move(*view), after_review,
                 std::move(runner));
  const Status done = run.Run();
  const Status closed = session.engine->Stop();
  Report(options, session, run);
  int code = 0;
  for (const Status& status : {done, closed}) {
    code = status ? code : FailWith(status.error());
  }
  if (code == 0 && !run.script_error().empty()) {
    code = FailWith(UnavailableError(run.script_error()));
  }
  if (session.engine->hung()) {
    std::fflush(nullptr);
    std::_Exit(code);  // its thread still works on what it has
  }
  return {code != 0 ? code : termination.exit_code(), run.next(), run.script_left(),
          (*surface)->width_px(), (*surface)->height_px()};
}

}  // namespace palace
