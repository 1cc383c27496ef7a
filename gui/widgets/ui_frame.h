// UiFrame: what every panel is handed for one frame, beside the snapshot and its own state.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <imgui.h>

#include "engine/core/check.h"
#include "gui/app/intent.h"
#include "gui/widgets/focus.h"

namespace palace {

/// Screen rectangle in pixels, y down.
struct Rect {
  float x = 0, y = 0, w = 0, h = 0;
  float right() const { return x + w; }
  float bottom() const { return y + h; }
  ImVec2 min() const { return {x, y}; }
  ImVec2 max() const { return {x + w, y + h}; }
  ImVec2 centre() const { return {x + w / 2, y + h / 2}; }
  bool Contains(ImVec2 p) const { return p.x >= x && p.y >= y && p.x < x + w && p.y < y + h; }
};

/// What was drawn, by name: scripts and tests act and assert through it.
struct Item {
  std::string name;  ///< "approve", "site/A", "limit/slad.max_slope_deg", "tab/Tune"
  Rect rect;
  bool enabled = true;
  std::string text;  ///< visible words and value
};
class ItemRecord {
 public:
  void Clear() { items_.clear(); }
  void Add(std::string_view name, const Rect& rect, bool enabled, std::string_view text) {
    items_.push_back({std::string(name), rect, enabled, std::string(text)});
  }
  /// The item recorded last, which must be of that name: to write down what only the drawing shows.
  Item& Last(std::string_view name) {
    PALACE_CHECK(!items_.empty() && items_.back().name == name, std::string(name));
    return items_.back();
  }
  /// Null when nothing of that name was drawn this frame.
  const Item* Find(std::string_view name) const {
    for (const Item& item : items_) {
      if (item.name == name) {
        return &item;
      }
    }
    return nullptr;
  }
  const std::vector<Item>& items() const { return items_; }

 private:
  std::vector<Item> items_;
};

/// A height beside the 3-D view's drop line.
struct View3dTick {
  ImVec2 pixel;  ///< from the picture's top-left corner
  std::string text;
};

/// Pictures uploaded by the render room, with what is needed to read them; null ids are drawn as
/// "unknown" hatch.
struct PanelTextures {
  ImTextureID left_camera = nullptr;  ///< rectified left, grey
  ImTextureID right_camera = nullptr;
  ImTextureID scene_3d = nullptr;  ///< 3-D view, rendered at the size the layout gives it
  std::vector<View3dTick> scene_3d_ticks;
  std::optional<ViewPreset> scene_3d_preset;  ///< it is seen from; empty: turned by hand
  /// Maps of the decision shown (preview while previewing): elevation, slope, roughness, cost, safe
  /// distance.
  ImTextureID maps[5] = {};
  float elevation_low_m = -0.5f;  ///< height of the first colour of the elevation map
  float elevation_high_m = 1.5f;  ///< and of the last
  ImTextureID recorded_safe_distance = nullptr;  ///< replay
  ImTextureID difference = nullptr;              ///< recorded against re-decided
  ImTextureID anchor_patch = nullptr;
  ImTextureID current_patch = nullptr;
  ImTextureID difference_patch = nullptr;
  ImTextureID range_tint = nullptr;    ///< left camera's depth, to be drawn over its picture
  ImTextureID world[kWorldEyes] = {};  ///< views of a simulated world, by WorldEye
  std::string world_waits_for{};       ///< why there are none yet
  float range_near_m = 0;              ///< depth of the first colour of range_tint
  float range_far_m = 0;               ///< and of the last
};

struct Style;  // palette, fonts and scale: gui/widgets/style.h
struct TerrainDecision;
struct CellExplanation;
struct Cell;
/// Why a cell of a decision is as it is. The app lends the engine's answer to the panels.
using CellExplainer = CellExplanation (*)(const TerrainDecision& decision, Cell cell);
struct EngineSnapshot;
/// Why a way to another hover is not flown; empty when it is. Lent in the same way.
using WayJudge = std::string (*)(const EngineSnapshot& snapshot, const FlyTo& there);
using WayLength = double (*)(const EngineSnapshot& snapshot, const FlyTo& there);

/// The way out of a review, back to what the station was started with; without a label there is
/// none.
struct WayOut {
  std::string label;  ///< of its button, "New flight"
  std::string hint;
};

/// Where the focus ring of this frame goes.
struct FocusMark {
  Rect rect;
  ImDrawList* over = nullptr;  ///< draw list of the window that holds the control
};

/// Handed to each draw function. Panels read const data, write their own state, append intents.
struct UiFrame {
  const Style& style;
  const PanelTextures& textures;
  ItemRecord& items;
  Intents& intents;
  Focus& focus;
  double ui_time_s = 0;  ///< monotonic UI clock (simulated time when headless)
  bool blocked_by_popup = false;
  Rect wave_off_rect;                    ///< popups, toasts and tooltips keep out of it
  CellExplainer explain_cell = nullptr;  ///< null: no answers
  std::uint64_t highlighted_site = 0;    ///< candidate that the keyboard is on; 0: none
  bool window_focused = true;            ///< the window has the system's keyboard
  /// Since the snapshot was true, by the station's clock: what every age on the screen grows by
  /// when nothing more is published. 0 where the session's clock is the data's own.
  double silent_s = 0;
  WayOut after_review{};
  WayJudge why_not_flown = nullptr;   ///< null: only what the snapshot itself says
  WayLength unseen_on_way = nullptr;  ///< metres over ground that no map showed; null: not told
  TabPlace tab{};                     ///< of the controls drawn now; panels set it
  /// Why the buttons drawn now take no press yet; panels set it. Empty: they do.
  std::string_view withheld{};
  std::optional<FocusMark> ring{};    ///< set by Interact, drawn by EndCanvas
};

}  // namespace palace
