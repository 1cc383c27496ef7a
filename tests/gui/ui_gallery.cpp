// ui_gallery: draws the Fly workspace of a fake snapshot offscreen and saves pictures, to be looked
// at beside the reference pictures. Usage: ui_gallery OUT_DIR
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

#include "gui/app/layout.h"
#include "gui/panels/diagnose/diagnose.h"
#include "gui/panels/fly_workspace.h"
#include "gui/panels/frame_bar.h"
#include "gui/panels/review/review.h"
#include "gui/panels/tune/tune.h"
#include "gui/platform/imgui_backend.h"
#include "gui/platform/offscreen.h"
#include "gui/platform/screenshot.h"
#include "gui/render/texture_set.h"
#include "tests/support/fake_snapshot.h"

namespace palace {
namespace {

ImTextureID TextureId(unsigned name) {
  return name == 0 ? nullptr : reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(name));
}

void FillStyle(Style& style, const Fonts& fonts, double scale) {
  style.scale = static_cast<float>(scale);
  style.palette = MakeDarkPalette();
  style.caption = fonts.caption;
  style.body = fonts.body;
  style.medium = fonts.medium;
  style.section = fonts.section;
  style.button = fonts.button;
  style.readout = fonts.readout;
  style.mode = fonts.mode;
  style.mode_replay = fonts.mode_replay;
  style.wave_off = fonts.wave_off;
  style.replay_time = fonts.replay_time;
  style.mono = fonts.mono;
}

struct Shot {
  const char* file;
  int width, height;
  double scale;
  MissionState state;
  SourceKind kind;
  Workspace workspace = Workspace::kFly;
};

/// Other limits than the flight's: a preview while armed, a re-decision in replay.
void MoveLimits(EngineSnapshot& snap) {
  snap.preview_settings.slad.limits.max_slope_deg = 6;
  snap.preview_settings.slad.limits.max_deviation_m = 0.06;
  snap.preview_settings.slad.fusion.frames_fused = 24;
  snap.preview_hash = 0x91c07e;
  auto moved = std::make_shared<TerrainDecision>(
      *fake::Decision(snap.X_WC, snap.preview_settings.slad, snap.preview_hash));
  std::swap(moved->selection.sites[0], moved->selection.sites[1]);
  if (snap.source.kind == SourceKind::kReplay) {
    snap.recorded = snap.applied;
    snap.applied = moved;
    snap.settings = snap.preview_settings;
  } else {
    snap.preview = moved;
  }
}

FlightRecord Record(const EngineSnapshot& snap) {
  FlightRecord record;
  record.start_s = static_cast<double>(snap.source.start.us) * 1e-6;
  record.duration_s = 338;
  record.has_settings = true;
  record.events = *snap.events;
  for (int i = 0; i < 676; ++i) {
    const double t = 0.5 * i;
    FlightRecordSample sample;
    sample.time = AddSeconds(snap.source.start, t);
    sample.state = t < 60    ? MissionState::kSearch
                   : t < 180 ? MissionState::kProposed
                   : t < 220 ? MissionState::kArmed
                             : MissionState::kDescending;
    sample.best_site = t < 20 ? '\0' : (t < 230 ? 'B' : 'A');
    sample.best_safe_distance_m = t < 20 ? NAN : 4.6;
    sample.height_above_site_m = t < 220 ? 38 : std::max(0.0, 38 - 0.6 * (t - 220));
    sample.height_m = sample.height_above_site_m;
    record.samples.push_back(sample);
  }
  return record;
}

int Take(const Shot& shot, const std::string& folder) {
  auto offscreen = Offscreen::Open(shot.width, shot.height);
  if (!offscreen.ok()) {
    std::fprintf(stderr, "no offscreen screen\n");
    return 1;
  }
  auto backend = ImGuiBackend::ForOffscreen(*offscreen.value(), shot.scale);
  if (!backend.ok()) {
    std::fprintf(stderr, "no ImGui backend\n");
    return 1;
  }
  EngineSnapshot snap = fake::Snapshot(shot.state, shot.kind);
  if (shot.workspace != Workspace::kFly) {
    MoveLimits(snap);
  }
  const FlightRecord record = Record(snap);
  Style style;
  FillStyle(style, backend.value()->fonts(), shot.scale);
  TextureSet set;
  set.Update(snap, 1);
  PanelTextures textures;
  textures.left_camera = TextureId(set.names().left_camera);
  textures.right_camera = TextureId(set.names().right_camera);
  for (std::size_t i = 0; i < 5; ++i) {
    textures.maps[i] = TextureId(set.names().maps[i]);
  }
  textures.anchor_patch = TextureId(set.names().anchor_patch);
  textures.current_patch = TextureId(set.names().current_patch);
  textures.difference_patch = TextureId(set.names().difference_patch);
  textures.recorded_safe_distance = TextureId(set.names().recorded_safe_distance);
  textures.difference = TextureId(set.names().difference);
  ItemRecord items;
  Intents intents;
  FlyState fly;
  TuneState tune;
  tune.history = {{snap.time, "slad.max_slope_deg", 10, 6},
                  {snap.time, "slad.max_deviation_m", 0.1, 0.06}};
  ReviewState review;
  DiagnoseState diagnose;
  FrameState frame;
  frame.preset_name = "r50-field";
  frame.workspace = shot.workspace;
  frame.frame_ms = 7;
  for (int i = 0; i < 3; ++i) {
    offscreen.value()->BeginFrame();
    backend.value()->BeginFrame(1.0 / 60);
    items.Clear();
    const FlyLayout layout =
        ComputeFlyLayout(shot.width, shot.height, shot.scale, ShowsDescent(snap));
    UiFrame ui{style, textures, items, intents, i / 60.0, false, layout.frame.wave_off};
    BeginCanvas(style);
    DrawFrameBar(snap, layout.frame, frame, ui);
    switch (shot.workspace) {
      case Workspace::kFly:
        DrawFlyWorkspace(snap, layout, fly, ui);
        break;
      case Workspace::kTune:
        DrawTuneWorkspace(snap, layout.frame.body, tune, ui);
        break;
      case Workspace::kReview:
        DrawReviewWorkspace(snap, &record, layout.frame.body, review, ui);
        break;
      case Workspace::kDiagnose:
        DrawDiagnoseWorkspace(snap, layout.frame.body, diagnose, ui);
        break;
    }
    DrawFrameOverlay(snap, layout.frame, frame, ui);
    EndCanvas();
    backend.value()->EndFrame();
  }
  const std::string path = folder + "/" + shot.file;
  return SavePng(offscreen.value()->ReadPixels(), path).ok() ? 0 : 1;
}

}  // namespace
}  // namespace palace

int main(int argc, char** argv) {
  using palace::MissionState;
  using palace::SourceKind;
  using palace::Workspace;
  const std::string folder = argc > 1 ? argv[1] : "/tmp";
  const palace::Shot shots[] = {
      {"fly-armed-1920.png", 1920, 1080, 1, MissionState::kArmed, SourceKind::kLive},
      {"fly-armed-1280.png", 1280, 720, 1, MissionState::kArmed, SourceKind::kLive},
      {"fly-descent-1920.png", 1920, 1080, 1, MissionState::kDescending, SourceKind::kSimulation},
      {"fly-descent-1280.png", 1280, 720, 1, MissionState::kDescending, SourceKind::kSimulation},
      {"fly-replay-1600.png", 1600, 900, 1, MissionState::kProposed, SourceKind::kReplay},
      {"fly-armed-3840.png", 3840, 2160, 2, MissionState::kArmed, SourceKind::kLive},
      {"tune-1920.png", 1920, 1080, 1, MissionState::kArmed, SourceKind::kSimulation,
       Workspace::kTune},
      {"tune-1280.png", 1280, 720, 1, MissionState::kArmed, SourceKind::kSimulation,
       Workspace::kTune},
      {"review-1920.png", 1920, 1080, 1, MissionState::kArmed, SourceKind::kReplay,
       Workspace::kReview},
      {"review-1280.png", 1280, 720, 1, MissionState::kArmed, SourceKind::kReplay,
       Workspace::kReview},
      {"diagnose-1920.png", 1920, 1080, 1, MissionState::kDescending, SourceKind::kLive,
       Workspace::kDiagnose}};
  int failed = 0;
  for (const palace::Shot& shot : shots) {
    failed += palace::Take(shot, folder);
  }
  return failed == 0 ? 0 : 1;
}
