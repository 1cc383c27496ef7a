// Scenes: worlds by name, where the simulated helicopter can be sent.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/model/rig.h"
#include "engine/world/world.h"

namespace palace {

/// "runway" (tables and cones), "cones", "slope" (5 degrees, rising north), "empty": on flat ground
/// of one texture, with a clear disc for certain.
std::vector<std::string_view> PlainSceneNames();
/// These, the families of families/families.h, and "search": 80 by 80 m with one safe place, mostly
/// out of sight (families/clearing.h).
std::vector<std::string_view> SceneNames();
/// All that may be named, for a help text: "runway, cones, ... or a world file (*.toml)".
std::string SceneList();

/// The named scene. `seed` scatters its solids and draws its texture; the same seed gives the same
/// scene. From the default hover pose (origin of W, 50 ft, heading north) both cameras of
/// DefaultRig() see at least one disc of kClearDiscRadius_m of a plain scene that no solid reaches
/// into; a family promises nothing of the kind. An unknown name is a usage error that lists the
/// names.
Result<World> MakeScene(std::string_view name, std::uint64_t seed);

/// Radius of the clear disc every plain scene guarantees.
inline constexpr double kClearDiscRadius_m = 3.0;

/// The view that scenes are laid out for, whichever vehicle flies, and the one of the thesis (3.3);
/// the default vehicle's file says the same. 640 x 480, 45 degrees wide, 1 m baseline along
/// body y, 45 degrees down, 10 Hz; left focal point at (0.8, -0.5, 0.3) m in B.
StereoRig DefaultRig();

}  // namespace palace
