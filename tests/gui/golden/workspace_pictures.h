// Pictures of the workspaces in every state, drawn offscreen from a fake snapshot: what the golden
// pictures in tests/golden hold, at half size.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "gui/app/layout.h"
#include "gui/app/take_fonts.h"
#include "gui/panels/diagnose/diagnose.h"
#include "gui/panels/fly_workspace.h"
#include "gui/panels/frame_bar.h"
#include "gui/panels/review/review.h"
#include "gui/panels/simulate/simulate.h"
#include "gui/panels/tune/tune.h"
#include "gui/platform/imgui_backend.h"
#include "gui/platform/offscreen.h"
#include "gui/render/texture_set.h"
#include "gui/widgets/interact.h"
#include "tests/support/fake_snapshot.h"
#include "tests/support/fake_sweep.h"

namespace palace {
namespace golden {

inline ImTextureID TextureId(unsigned name) {
  return name == 0 ? nullptr : reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(name));
}

struct Shot {
  std::string name;  ///< of the golden picture, without the size
  int width, height;
  double scale;
  MissionState state;
  SourceKind kind;
  Workspace workspace = Workspace::kFly;
  bool track_view = false;
};

/// Other limits than the flight's: a preview while armed, a re-decision in replay.
inline void MoveLimits(EngineSnapshot& snap) {
  snap.session.Edit().preview_settings.slad.limits.max_slope_deg = 6;
  snap.session.Edit().preview_settings.slad.limits.max_deviation_m = 0.06;
  snap.session.Edit().preview_settings.slad.fusion.frames_fused = 24;
  snap.session.Edit().preview_hash = 0x91c07e;
  auto moved = std::make_shared<TerrainDecision>(*fake::Decision(
      snap.sensors->X_WC, snap.session->preview_settings.slad, snap.session->preview_hash));
  std::swap(moved->selection.sites[0], moved->selection.sites[1]);
  if (snap.session->source.kind == SourceKind::kReplay) {
    snap.terrain.Edit().recorded = snap.terrain->applied;
    snap.terrain.Edit().applied = moved;
    snap.session.Edit().recorded_settings = snap.session->settings;
    snap.session.Edit().settings = snap.session->preview_settings;
    auto redecided = std::make_shared<std::vector<RedecidedSample>>();
    for (int i = 0; i < 400; ++i) {  // A where the flight had B until 230 s
      RedecidedSample sample;
      sample.time = AddSeconds(snap.session->source.start, 212 + 0.1 * i);
      sample.recorded = i < 180 ? "B" : "A";
      sample.best_site = "A";
      sample.best_safe_distance_m = 4.3;
      sample.differs = i < 180;
      redecided->push_back(sample);
    }
    snap.terrain.Edit().redecided = redecided;
  } else {
    snap.terrain.Edit().preview = moved;
  }
}

/// What the Simulate workspace is offered for, in the middle of a flight.
inline void Simulate(EngineSnapshot& snap, SimulateState& state) {
  SourceStatus& source = snap.session.Edit().source;
  SimulationStatus& simulation = source.simulation.emplace();
  ReadRig(*snap.sensors->rig, simulation.began);
  simulation.in_force = simulation.asked = simulation.began;
  simulation.in_force.wind_mps = simulation.asked.wind_mps = 4;
  simulation.asked.wind_from_deg = 230;
  state.offered = {{"runway", "rocks", "rough", "ditches", "config/worlds/yard.toml"},
                   {"multirotor", "r50"}};
  state.choice = {"rocks", 7, "r50"};
  state.offered.faults = {{.name = "gps_jump",
                           .words = "GPS jump",
                           .what = "Every fix is off by this",
                           .has_value = true,
                           .unit = "m",
                           .default_value = 3,
                           .least = 0,
                           .most = 100}};
  state.faults = {{1, "GPS jump 3 m", "GPS jump", 4, 20, true, false}};
}

inline FlightRecord Record(const EngineSnapshot& snap) {
  FlightRecord record;
  record.start_s = static_cast<double>(snap.session->source.start.us) * 1e-6;
  record.duration_s = 338;
  record.has_settings = true;
  record.events = *snap.session->events;
  for (int i = 0; i < 676; ++i) {
    const double t = 0.5 * i;
    FlightRecordSample sample;
    sample.time = AddSeconds(snap.session->source.start, t);
    sample.state = t < 60    ? MissionState::kSearch
                   : t < 180 ? MissionState::kProposed
                   : t < 220 ? MissionState::kArmed
                             : MissionState::kDescending;
    sample.best_site = t < 20 ? "" : (t < 230 ? "B" : "A");
    sample.best_safe_distance_m = t < 20 ? NAN : 4.6;
    sample.height_above_site_m = t < 220 ? 38 : std::max(0.0, 38 - 0.6 * (t - 220));
    sample.height_m = sample.height_above_site_m;
    record.samples.push_back(sample);
  }
  return record;
}

/// An empty picture where no offscreen screen can be had; `why` then says so.
inline ImageRgba Draw(const Shot& shot, std::string& why) {
  auto offscreen = Offscreen::Open(shot.width, shot.height);
  if (!offscreen.ok()) {
    why = offscreen.error().message;
    return {};
  }
  auto backend = ImGuiBackend::ForOffscreen(*offscreen.value(), shot.scale);
  if (!backend.ok()) {
    why = backend.error().message;
    return {};
  }
  EngineSnapshot snap = fake::Snapshot(shot.state, shot.kind);
  if (shot.workspace != Workspace::kFly) {
    MoveLimits(snap);
  }
  const FlightRecord record = Record(snap);
  Style style;
  style.scale = static_cast<float>(shot.scale);
  style.palette = MakeDarkPalette();
  TakeFonts(backend.value()->fonts(), style);
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
  Focus focus;
  FlyState fly;
  fly.camera.track_view = shot.track_view;
  TuneState tune;
  EngineSnapshot before = snap;
  before.session.Edit().preview_settings = {};
  tune.history.Remember(CommandAction(SetSetting{"slad.max_slope_deg", 6}), before, {});
  tune.history.Remember(CommandAction(SetSetting{"slad.max_deviation_m", 0.06}), before, {});
  tune.sweep = fake::RoughnessSweep(snap);
  ReviewState review;
  DiagnoseState diagnose;
  SimulateState simulate;
  if (shot.workspace == Workspace::kSimulate) {
    Simulate(snap, simulate);
  }
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
    UiFrame ui{style, textures, items, intents, focus, i / 60.0, false, layout.frame.wave_off};
    BeginCanvas(ui);
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
      case Workspace::kSimulate:
        DrawSimulateWorkspace(snap, layout.frame.body, simulate, ui);
        break;
    }
    DrawFrameOverlay(snap, layout.frame, frame, ui);
    EndCanvas(ui);
    backend.value()->EndFrame(style.palette.window);
  }
  return offscreen.value()->ReadPixels();
}

/// The golden pictures: each workspace in each of its states, in the two sizes that matter.
inline std::vector<Shot> Shots() {
  struct State {
    const char* name;
    MissionState state;
    SourceKind kind;
    Workspace workspace;
    bool track_view = false;
  };
  const State states[] = {
      {"fly-search", MissionState::kSearch, SourceKind::kSimulation, Workspace::kFly},
      {"fly-proposed", MissionState::kProposed, SourceKind::kSimulation, Workspace::kFly},
      {"fly-armed", MissionState::kArmed, SourceKind::kLive, Workspace::kFly},
      {"fly-approved", MissionState::kApproved, SourceKind::kLive, Workspace::kFly},
      {"fly-descending", MissionState::kDescending, SourceKind::kSimulation, Workspace::kFly},
      {"fly-track-view", MissionState::kDescending, SourceKind::kSimulation, Workspace::kFly, true},
      {"fly-hold", MissionState::kHold, SourceKind::kLive, Workspace::kFly},
      {"fly-aborting", MissionState::kAborting, SourceKind::kLive, Workspace::kFly},
      {"fly-landed", MissionState::kLanded, SourceKind::kSimulation, Workspace::kFly},
      {"fly-replay", MissionState::kProposed, SourceKind::kReplay, Workspace::kFly},
      {"tune-proposed", MissionState::kProposed, SourceKind::kSimulation, Workspace::kTune},
      {"tune-armed", MissionState::kArmed, SourceKind::kSimulation, Workspace::kTune},
      {"review-replay", MissionState::kArmed, SourceKind::kReplay, Workspace::kReview},
      {"diagnose-live", MissionState::kDescending, SourceKind::kLive, Workspace::kDiagnose},
      {"simulate-proposed", MissionState::kProposed, SourceKind::kSimulation,
       Workspace::kSimulate}};
  std::vector<Shot> shots;
  for (const State& s : states) {
    shots.push_back({s.name, 1280, 720, 1, s.state, s.kind, s.workspace, s.track_view});
    shots.push_back({s.name, 1920, 1080, 1, s.state, s.kind, s.workspace, s.track_view});
  }
  return shots;
}

inline std::string FileOf(const Shot& shot) {
  return shot.name + "-" + std::to_string(shot.width) + ".jpg";
}

/// Half size, BGR, as the files hold it.
inline cv::Mat HalfSize(const ImageRgba& picture) {
  cv::Mat bgr(picture.height(), picture.width(), CV_8UC3), half;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const Rgba8 c = picture.at(x, y);
      bgr.at<cv::Vec3b>(y, x) = {c.b, c.g, c.r};
    }
  }
  cv::resize(bgr, half, {}, 0.5, 0.5, cv::INTER_AREA);
  return half;
}

}  // namespace golden
}  // namespace palace
