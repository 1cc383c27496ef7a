// A whole frame of the window, offscreen: with a snapshot that is new (pictures, maps and the 3-D
// view are uploaded and drawn anew), and with the one of the frame before. Until the pixels stand;
// nothing is read back.
#include <benchmark/benchmark.h>

#include <memory>
#include <string>

#include "gui/app/view.h"
#include "gui/platform/imgui_backend.h"
#include "gui/platform/offscreen.h"
#include "gui/render/gl.h"
#include "tests/support/fake_snapshot.h"

namespace palace {
namespace {

constexpr double kFrame_s = 1.0 / 60;

void DrawWindow(benchmark::State& state, MissionState mission, int width_px, int height_px,
                bool is_new) {
  auto offscreen = Offscreen::Open(width_px, height_px);
  if (!offscreen) {
    state.SkipWithError(offscreen.error().message.c_str());
    return;
  }
  auto backend = ImGuiBackend::ForOffscreen(**offscreen, 1);
  auto view = View::Create("dark", nullptr);
  if (!backend || !view) {
    state.SkipWithError((backend ? view.error() : backend.error()).message.c_str());
    return;
  }
  state.SetLabel(reinterpret_cast<const char*>(glGetString(GL_RENDERER)));
  EngineSnapshot snapshot = fake::Snapshot(mission, SourceKind::kLive);
  UiState ui;
  ViewFrame frame{width_px, height_px};
  const auto draw = [&] {
    frame.ui_time_s += kFrame_s;
    (*offscreen)->BeginFrame();
    (*view)->Upload(snapshot, frame, ui, kFrame_s);
    (*backend)->BeginFrame(kFrame_s);
    (*view)->Draw(&snapshot, nullptr, ui, (*backend)->fonts(), frame);
    (*backend)->EndFrame((*view)->background());
    glFinish();
  };
  for (int i = 0; i < 60; ++i) {  // until the 3-D view stands still
    draw();
  }
  for (auto _ : state) {
    snapshot.sequence += is_new ? 1 : 0;
    draw();
  }
}

const bool kRegistered = [] {
  struct Size {
    int width_px, height_px;
  };
  for (const Size size : {Size{1920, 1080}, Size{3840, 2160}}) {
    for (const bool descends : {false, true}) {
      for (const bool is_new : {true, false}) {
        const std::string name = std::string("window ") + (descends ? "descent " : "armed ") +
                                 std::to_string(size.width_px) + "x" +
                                 std::to_string(size.height_px) +
                                 (is_new ? "/new snapshot" : "/same snapshot");
        const MissionState mission = descends ? MissionState::kDescending : MissionState::kArmed;
        benchmark::RegisterBenchmark(name.c_str(),
                                     [=](benchmark::State& state) {
                                       DrawWindow(state, mission, size.width_px, size.height_px,
                                                  is_new);
                                     })
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime();
      }
    }
  }
  return true;
}();

}  // namespace
}  // namespace palace
