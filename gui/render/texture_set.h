// TextureSet: uploads what the snapshot shows, once per new picture.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "engine/model/snapshot.h"
#include "gui/render/gl.h"
#include "gui/render/map_colours.h"
#include "gui/render/texture.h"

namespace palace {

/// GL names; 0 where there is nothing to show. The app turns them into PanelTextures.
struct TextureNames {
  GLuint left_camera = 0;
  GLuint right_camera = 0;
  std::array<GLuint, 5> maps{};  ///< elevation, slope, roughness, cost, safe distance
  GLuint recorded_safe_distance = 0;
  GLuint difference = 0;
  GLuint anchor_patch = 0;
  GLuint current_patch = 0;
  GLuint difference_patch = 0;
  GLuint range_tint = 0;    ///< viridis, half transparent; only while asked for
  ValueRange range_tint_m;  ///< depths of its first and last colour
};

/// Needs one GL context current for every call and for the destructor.
class TextureSet {
 public:
  TextureSet();
  ~TextureSet();
  TextureSet(const TextureSet&) = delete;
  TextureSet& operator=(const TextureSet&) = delete;

  /// Shows the preview's maps while there is one, else the applied ones. Uploads only what changed
  /// by pointer, range or filter. `camera_scale` is screen pixels per camera pixel: above 2 the
  /// pictures are drawn without smoothing. Raw pictures stand in until rectified ones exist.
  void Update(const EngineSnapshot& snapshot, double camera_scale = 1);
  const TextureNames& names() const { return names_; }
  /// In force for the maps shown; the colour bars use the same.
  const MapRanges& ranges() const { return ranges_; }
  /// Uploads the range map as a tint with each update, or no longer.
  void ShowRange(bool shown) { range_shown_ = shown; }
  /// Another mission, log or source: forgets the range and all pictures.
  void Reset();

 private:
  struct Slot;
  void UpdateMaps(const EngineSnapshot& snapshot);
  void UpdateComparison(const EngineSnapshot& snapshot);
  void UpdateRange(const EngineSnapshot& snapshot);
  GLuint Show(Slot& slot, std::shared_ptr<const ImageU8> picture, TextureFilter filter);

  TextureNames names_;
  MapRanges ranges_;
  std::optional<ValueRange> elevation_range_m_;    ///< of the mission's first map
  std::unique_ptr<std::array<Slot, 5>> pictures_;  ///< left, right, three patches
  std::array<Texture, 5> maps_;
  Texture recorded_;
  Texture difference_;
  Texture range_;
  bool range_shown_ = false;
  std::shared_ptr<const RangeMap> range_uploaded_;
  std::shared_ptr<const TerrainDecision> shown_;
  std::shared_ptr<const TerrainDecision> compared_recorded_;
  std::shared_ptr<const TerrainDecision> compared_now_;
};

}  // namespace palace
