// View: one frame of the user interface for one snapshot.
#pragma once

#include <memory>
#include <string>

#include "engine/core/result.h"
#include "engine/model/flight_record.h"
#include "engine/model/snapshot.h"
#include "gui/app/ui_state.h"
#include "gui/app/world_views.h"
#include "gui/panels/fly_layout.h"
#include "gui/platform/fonts.h"
#include "gui/render/texture_set.h"
#include "gui/render/view3d_renderer.h"
#include "gui/widgets/style.h"

namespace palace {

/// What a frame is drawn into and when.
struct ViewFrame {
  int width_px = 0;
  int height_px = 0;
  double ui_time_s = 0;
  double frame_ms = 0;         ///< of the frame before, shown in the status bar
  bool window_focused = true;  ///< the window has the system's keyboard
  std::string complaint{};     ///< Engine::Complaint
};

/// Owns GL objects: create, use and destroy with one GL context current.
class View {
 public:
  /// `world`: the one that is simulated here; null: none. `body`: what flies there.
  static Result<std::unique_ptr<View>> Create(const std::string& theme, const World* world,
                                              VehicleBody body = VehicleBody::kHelicopter);
  /// Uploads what the snapshot shows and renders the 3-D view. Only needed when pixels are made.
  void Upload(const EngineSnapshot& snapshot, const ViewFrame& frame, UiState& state, double dt_s);
  /// Draws into the current ImGui frame. `snapshot` null: nothing has arrived yet.
  Intents Draw(const EngineSnapshot* snapshot, const FlightRecord* record, UiState& state,
               const Fonts& fonts, const ViewFrame& frame);
  /// The colour behind all panels, which the window is cleared with.
  ImU32 background() const { return style_.palette.window; }
  /// What the last frame drew, by name.
  const ItemRecord& items() const { return items_; }
  /// The scale that fits a window of this size, at most the wanted one.
  static double FittingScale(int width_px, int height_px, double wanted);

 private:
  explicit View(std::unique_ptr<View3dRenderer> view3d) : view3d_(std::move(view3d)) {}
  void DrawWorkspace(const EngineSnapshot& snapshot, const FlightRecord* record,
                     const FrameLayout& layout, const ViewFrame& frame, UiState& state,
                     UiFrame& ui);
  void UploadWorld(const EngineSnapshot& snapshot, const ViewFrame& frame, UiState& state,
                   double dt_s);
  void UploadPictures(const EngineSnapshot& snapshot, const UiState& state, const ViewFrame& frame);
  /// Where the 3-D picture lies in the workspace shown; empty where there is none.
  Rect SceneRect(const EngineSnapshot& snapshot, const UiState& state,
                 const ViewFrame& frame) const;
  void Fit(const UiState& state, const ViewFrame& frame);
  void DrawWaiting(const FrameLayout& layout, UiFrame& ui);
  void DrawLeaveQuestion(const EngineSnapshot* snapshot, const FrameLayout& layout, UiState& state,
                         UiFrame& ui);
  void DrawComplaint(const FrameLayout& layout, const std::string& complaint, UiFrame& ui);
  void DrawMessage(const EngineSnapshot* snapshot, const FrameLayout& layout,
                   const ViewFrame& frame, const UiState& state, UiFrame& ui);

  /// What the 3-D view was drawn for; drawn again only when it changes or the camera moves.
  struct View3dKey {
    std::uint64_t sequence = 0;
    std::uint64_t highlighted_site = 0;
    std::uint64_t orbit_moves = 0;
    float width = 0;
    float height = 0;
    friend bool operator==(const View3dKey&, const View3dKey&) = default;
  };

  Style style_;
  TextureSet textures_;
  std::unique_ptr<View3dRenderer> view3d_;
  VehicleBody body_ = VehicleBody::kHelicopter;
  View3dKey drawn_3d_;
  std::unique_ptr<WorldViews> world_;  ///< of a simulation
  double settle_s_ = 0;
  PanelTextures ids_;
  ItemRecord items_;
};

}  // namespace palace
