#include "gui/app/headless.h"

#include <cstdio>

#include "engine/core/log.h"
#include "engine/runtime/flight_summary.h"
#include "gui/app/dispatch.h"
#include "gui/app/input.h"
#include "gui/app/keys.h"
#include "gui/app/report.h"
#include "gui/app/view.h"
#include "gui/platform/imgui_backend.h"
#include "gui/platform/offscreen.h"
#include "gui/platform/screenshot.h"
#include "gui/widgets/imgui_input.h"

namespace palace {
namespace {

constexpr double kFrame_s = 0.1;  // of the UI clock, one engine pass

int Fail(const std::string& message) {
  std::fprintf(stderr, "palace: %s\n", message.c_str());
  return 1;
}

/// One headless run: the parts that live as long as it does.
class HeadlessRun {
 public:
  HeadlessRun(const AppOptions& options, Session& session, ScriptRunner script)
      : options_(options),
        session_(session),
        script_(std::move(script)),
        summarizer_(session.scene) {}

  Status Open() {
    Result<std::unique_ptr<Offscreen>> offscreen =
        Offscreen::Open(options_.width_px, options_.height_px);
    if (!offscreen) {
      return offscreen.error();
    }
    offscreen_ = std::move(*offscreen);
    wanted_scale_ = options_.ui_scale > 0 ? options_.ui_scale : 1;
    state_.scale = wanted_scale_;
    Result<std::unique_ptr<ImGuiBackend>> backend = ImGuiBackend::ForOffscreen(
        *offscreen_, View::FittingScale(options_.width_px, options_.height_px, wanted_scale_));
    if (!backend) {
      return backend.error();
    }
    backend_ = std::move(*backend);
    StartFedInput();
    Result<std::unique_ptr<View>> view = View::Create(options_.theme);
    if (!view) {
      return view.error();
    }
    view_ = std::move(*view);
    return Ok();
  }

  /// Steps engine and user interface until the script is done.
  Status Run() {
    while (!script_.done() && !state_.quit) {
      const bool more = session_.engine->Step();
      if (!more && !session_.engine->error().empty()) {
        return UnavailableError(session_.engine->error());
      }
      const Status drawn = Frame();
      if (!drawn) {
        return drawn;
      }
    }
    // A screenshot asked for by the last line still waits for its frame.
    return state_.screenshots_wanted.empty() ? Ok() : Frame();
  }

  const std::string& script_error() const { return script_.error(); }
  const FlightSummary& summary() const { return summarizer_.summary(); }
  const std::vector<std::string>& screenshots() const { return screenshots_; }

 private:
  Status Frame() {
    time_s_ += kFrame_s;
    const auto snapshot = session_.engine->Latest();
    if (snapshot) {
      summarizer_.Add(*snapshot);
    }
    // A picture shows the window as it was when it was asked for; the script waits for it.
    const bool pixels = !state_.screenshots_wanted.empty();
    const ScriptInput input =
        pixels ? script_.Rest() : script_.Tick(view_->items(), snapshot.get(), time_s_);
    if (input.resize) {
      const Status resized = offscreen_->SetSize(input.resize->first, input.resize->second);
      if (!resized) {
        return resized;
      }
    }
    const int width = offscreen_->width_px(), height = offscreen_->height_px();
    backend_->SetUiScale(View::FittingScale(width, height, state_.scale));
    FeedScriptInput(input, keys_down_);
    backend_->BeginFrame(kFrame_s);
    const ViewFrame frame{width, height, time_s_, 0};
    if (pixels && snapshot) {
      view_->Upload(*snapshot, state_, kFrame_s);
    }
    Intents intents =
        view_->Draw(snapshot.get(), session_.record.get(), state_, backend_->fonts(), frame);
    backend_->EndFrame(pixels);
    const Status saved = pixels ? SaveScreenshots() : Ok();
    intents.insert(intents.end(), input.intents.begin(), input.intents.end());
    if (input.key) {
      const Intents of_key =
          IntentsOfKey(*input.key, snapshot.get(), state_, ImGui::GetIO().WantTextInput);
      intents.insert(intents.end(), of_key.begin(), of_key.end());
    }
    Dispatch(intents, CommandOrigin::kScript, snapshot.get(), input.mouse_down, time_s_,
             *session_.engine, state_);
    return saved;
  }

  Status SaveScreenshots() {
    std::error_code error;
    std::filesystem::create_directories(session_.output_dir, error);
    const ImageRgba picture = offscreen_->ReadPixels();
    for (const std::string& wanted : state_.screenshots_wanted) {
      const std::string name = wanted.empty() ? "screenshot.png" : wanted;
      const Status saved = SavePng(picture, (session_.output_dir / name).string());
      if (!saved) {
        return saved;
      }
      screenshots_.push_back(name);
    }
    state_.screenshots_wanted.clear();
    return Ok();
  }

  const AppOptions& options_;
  Session& session_;
  ScriptRunner script_;
  FlightSummarizer summarizer_;
  std::unique_ptr<Offscreen> offscreen_;
  std::unique_ptr<ImGuiBackend> backend_;
  std::unique_ptr<View> view_;
  UiState state_;
  double wanted_scale_ = 1;
  double time_s_ = 0;
  std::vector<ImGuiKey> keys_down_;
  std::vector<std::string> screenshots_;
};

void PrintAndReport(const AppOptions& options, const Session& session, const HeadlessRun& run) {
  for (const std::string& line : SummaryLines(run.summary())) {
    std::printf("%s\n", line.c_str());
  }
  if (options.report || !run.screenshots().empty()) {
    std::printf("Files: %s\n", session.output_dir.string().c_str());
  }
  if (!options.report) {
    return;
  }
  const Status written = WriteFlightReport(options, session, run.summary(), run.screenshots());
  if (!written) {
    LogWarning(written.error().message);
  }
}

}  // namespace

int RunHeadless(const AppOptions& options, Session& session, std::vector<ScriptLine> script,
                const std::string& script_name) {
  session.source->Control({PlaybackControl::Kind::kSpeed, 0});
  HeadlessRun run(options, session, ScriptRunner(std::move(script), script_name));
  Status done = run.Open();
  if (done) {
    done = run.Run();
  }
  const Status closed = session.engine->Stop();
  if (!done) {
    return Fail(done.error().message);
  }
  PrintAndReport(options, session, run);
  if (!closed) {
    return Fail(closed.error().message);
  }
  return run.script_error().empty() ? 0 : Fail(run.script_error());
}

}  // namespace palace
