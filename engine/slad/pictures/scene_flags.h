// Flags from pictures and motion: what heights alone cannot show, found in a stereo pair and kept
// on the map.
//
//   FindSceneGround        range map, pictures -> the ground behind thin things, right over left
//   FindThinStructures     their difference    -> wires, ropes, masts
//   LineParallax           older views         -> heights of those along the baseline
//   FlagTextureAndShadow   both pictures       -> no texture, deep shadow
//   CellTexture          per cell            -> what ten maps show of texture together
//   SceneMotion            an older view       -> what moved
//   FlagMemory             per cell, map by map
#pragma once

#include <cstdint>

#include "engine/model/elevation_map.h"
#include "engine/slad/pictures/cell_texture.h"
#include "engine/slad/pictures/flag_memory.h"
#include "engine/slad/pictures/older_views.h"
#include "engine/slad/pictures/scene_ground.h"
#include "engine/slad/pictures/scene_motion.h"

namespace palace {

class SceneFlags {
 public:
  void Reset();
  /// What was seen before need not have been where it was said to be: no later view is compared
  /// with it, and nothing that was found by comparing stands. What moves is told again after half a
  /// second.
  void DoubtViews();
  /// TerrainFlag bits for the cells of the map that the view's range map was just fused into. A
  /// cell has no texture, shadow or motion when at least half of the blocks seen in it have. A thin
  /// structure flags the cells straight below it and their neighbours; one of unknown height those
  /// of the ground seen behind it. Without pictures the flags stay as they are.
  Grid<std::uint8_t> Add(const SceneView& view, const GridGeometry& geometry);
  /// Of the cells that are flagged for a thin structure (ElevationMap::thin_top_m); empty: none is.
  GridF ThinTops() const { return memory_.ThinTops(); }

 private:
  SceneMotion motion_;
  OlderViews older_;
  FlagMemory memory_;
  CellTexture texture_;
};

}  // namespace palace
