#include "gui/app/windowed.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include <imgui.h>

#include "engine/core/log.h"
#include "engine/core/time.h"
#include "engine/runtime/flight_summary.h"
#include "gui/app/dispatch.h"
#include "gui/app/input.h"
#include "gui/app/keys.h"
#include "gui/app/report.h"
#include "gui/app/view.h"
#include "gui/platform/imgui_backend.h"
#include "gui/platform/screenshot.h"
#include "gui/platform/window.h"
#include "gui/widgets/imgui_input.h"

namespace palace {
namespace {

constexpr double kMinimisedWait_s = 0.1;
constexpr double kSlowFrame_ms = 20;
constexpr double kCaptionEm_px = 13;
constexpr double kLeastCaption_pt = 9.7;
constexpr double kScaleStep = 0.25;

/// The smallest step at which a caption is large enough to read on this monitor.
double ScaleForMonitor(double dots_per_inch) {
  double scale = 0.75;
  while (scale < 2.5 && kCaptionEm_px * scale * 72 / dots_per_inch < kLeastCaption_pt) {
    scale += kScaleStep;
  }
  return std::max(1.0, scale);
}

std::string TitleOf(const AppOptions& options) {
  switch (options.source) {
    case SourceChoice::kReplay:
      return "REPLAY " + options.source_path + " - PALACE";
    case SourceChoice::kImages:
      return options.source_path + " - PALACE";
    case SourceChoice::kCameras:
      return "CAMERAS " + options.source_path + " - PALACE";
    case SourceChoice::kConnect:
      return "LIVE " + options.source_path + " - PALACE";
    case SourceChoice::kSimulation:
      return "SIM " + options.scenario + " - PALACE";
  }
  return "PALACE";
}

class WindowedRun {
 public:
  WindowedRun(const AppOptions& options, Session& session, std::optional<ScriptRunner> script)
      : options_(options),
        session_(session),
        script_(std::move(script)),
        summarizer_(session.scene) {}

  Status Open() {
    Result<std::unique_ptr<Window>> window =
        Window::Open(TitleOf(options_), options_.width_px, options_.height_px);
    if (!window) {
      return window.error();
    }
    window_ = std::move(*window);
    state_.scale =
        options_.ui_scale > 0 ? options_.ui_scale : ScaleForMonitor(window_->dots_per_inch());
    Result<std::unique_ptr<ImGuiBackend>> backend = ImGuiBackend::ForWindow(*window_, Scale());
    if (!backend) {
      return backend.error();
    }
    backend_ = std::move(*backend);
    if (script_) {
      StartFedInput();
    }
    Result<std::unique_ptr<View>> view = View::Create(options_.theme);
    if (!view) {
      return view.error();
    }
    view_ = std::move(*view);
    start_s_ = last_s_ = MonotonicSeconds();
    return Ok();
  }

  Status Run() {
    while (!state_.quit && !(script_ && script_->done())) {
      const WindowInput input = window_->PollInput(WaitForInput());
      if (input.close_requested) {
        break;
      }
      if (!session_.engine->error().empty() && !session_.engine->Latest()) {
        return UnavailableError(session_.engine->error());
      }
      const Status drawn = Frame(input);
      if (!drawn) {
        return drawn;
      }
    }
    return Ok();
  }

  std::string script_error() const { return script_ ? script_->error() : std::string(); }
  const FlightSummary& summary() const { return summarizer_.summary(); }
  const std::vector<std::string>& screenshots() const { return screenshots_; }

 private:
  double Scale() const {
    return View::FittingScale(window_->width_px(), window_->height_px(), state_.scale);
  }

  /// When drawing is slow (software GL) the engine gets every other moment: the frame rate of the
  /// window yields first. Input ends the wait.
  double WaitForInput() const {
    if (window_->minimised()) {
      return kMinimisedWait_s;
    }
    return frame_ms_ > kSlowFrame_ms ? std::min(frame_ms_ * 1e-3, kMinimisedWait_s) : 0;
  }

  Status Frame(const WindowInput& window_input) {
    const double now_s = MonotonicSeconds();
    const double dt_s = now_s - last_s_;
    last_s_ = now_s;
    const double ui_time_s = now_s - start_s_;
    const auto snapshot = session_.engine->Latest();
    if (snapshot) {
      summarizer_.Add(*snapshot);
    }
    backend_->SetUiScale(Scale());
    if (snapshot) {
      view_->Upload(*snapshot, state_, dt_s);
    }
    ScriptInput input;
    if (script_) {
      input = state_.screenshots_wanted.empty()
                  ? script_->Tick(view_->items(), snapshot.get(), ui_time_s)
                  : script_->Rest();
      if (input.resize) {
        window_->SetSize(input.resize->first, input.resize->second);
      }
    }
    backend_->BeginFrame(0, [&] {
      if (script_) {
        FeedScriptInput(input, keys_down_);
      }
    });
    const ViewFrame frame{window_->width_px(), window_->height_px(), ui_time_s, frame_ms_};
    Intents intents =
        view_->Draw(snapshot.get(), session_.record.get(), state_, backend_->fonts(), frame);
    backend_->EndFrame();
    const Status saved = SaveScreenshots();
    frame_ms_ = (MonotonicSeconds() - now_s) * 1e3;
    window_->SwapBuffers();
    const bool typing = ImGui::GetIO().WantTextInput;
    for (const KeyEvent& key : window_input.keys) {
      AddKey(key, snapshot.get(), typing, intents);
    }
    const CommandOrigin origin = script_ ? CommandOrigin::kScript : CommandOrigin::kOperator;
    if (script_) {
      intents.insert(intents.end(), input.intents.begin(), input.intents.end());
      if (input.key) {
        const Intents of_key = IntentsOfKey(*input.key, snapshot.get(), state_, typing);
        intents.insert(intents.end(), of_key.begin(), of_key.end());
      }
    }
    Dispatch(intents, origin, snapshot.get(), ImGui::IsMouseDown(0), ui_time_s, *session_.engine,
             state_);
    return saved;
  }

  void AddKey(const KeyEvent& event, const EngineSnapshot* snapshot, bool typing,
              Intents& intents) const {
    if (event.action == KeyAction::kRelease) {
      return;
    }
    const std::string name = KeyName(event);
    if (event.action == KeyAction::kRepeat) {
      for (const KeyBinding& binding : KeyTable()) {
        if (binding.keys == name && !binding.repeats) {
          return;
        }
      }
    }
    const Intents of_key = IntentsOfKey(name, snapshot, state_, typing);
    intents.insert(intents.end(), of_key.begin(), of_key.end());
  }

  Status SaveScreenshots() {
    if (state_.screenshots_wanted.empty()) {
      return Ok();
    }
    std::error_code error;
    std::filesystem::create_directories(session_.output_dir, error);
    const ImageRgba picture = window_->ReadPixels();
    for (const std::string& wanted : state_.screenshots_wanted) {
      const std::string name = wanted.empty() ? "screenshot-" + TimeStampName() + ".png" : wanted;
      const Status saved = SavePng(picture, (session_.output_dir / name).string());
      if (!saved && script_) {
        return saved;
      }
      if (!script_) {
        ShowMessage(state_, saved ? "Screenshot saved: " + name : saved.error().message,
                    last_s_ - start_s_);
      }
      screenshots_.push_back(name);
    }
    state_.screenshots_wanted.clear();
    return Ok();
  }

  const AppOptions& options_;
  Session& session_;
  std::optional<ScriptRunner> script_;
  FlightSummarizer summarizer_;
  std::unique_ptr<Window> window_;
  std::unique_ptr<ImGuiBackend> backend_;
  std::unique_ptr<View> view_;
  UiState state_;
  double start_s_ = 0;
  double last_s_ = 0;
  double frame_ms_ = 0;
  std::vector<ImGuiKey> keys_down_;
  std::vector<std::string> screenshots_;
};

}  // namespace

int RunWindowed(const AppOptions& options, Session& session,
                std::optional<std::vector<ScriptLine>> script, const std::string& script_name) {
  std::optional<ScriptRunner> runner;
  if (script) {
    runner.emplace(std::move(*script), script_name);
  }
  WindowedRun run(options, session, std::move(runner));
  Status done = run.Open();
  if (done) {
    session.engine->Start();
    done = run.Run();
  }
  const Status closed = session.engine->Stop();
  if (done && session.recorded) {
    const Status written = WriteFlightReport(options, session, run.summary(), run.screenshots());
    if (!written) {
      LogWarning(written.error().message);
    }
    std::printf("Files: %s\n", session.output_dir.string().c_str());
  }
  for (const Status& status : {done, closed}) {
    if (!status) {
      std::fprintf(stderr, "palace: %s\n", status.error().message.c_str());
      return status.error().code == ErrorCode::kUsage ? 2 : 1;
    }
  }
  if (!run.script_error().empty()) {
    std::fprintf(stderr, "palace: %s\n", run.script_error().c_str());
    return 1;
  }
  return 0;
}

}  // namespace palace
