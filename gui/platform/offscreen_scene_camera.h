// MakeOffscreenSceneCamera: pictures of a scene with no window, for simulator, palacectl and tests.
#pragma once

#include <memory>

#include "engine/core/result.h"
#include "engine/simulation/scene_camera.h"
#include "engine/world/world.h"

namespace palace {

/// The object owns its own EGL context and makes it current inside each call only, so it may be
/// created on one thread and used on another (one at a time), beside any window's context on other
/// threads. Shaders and textures are made at the first Render.
/// kUnavailable with the remedy when the machine has no EGL or OpenGL driver.
Result<std::unique_ptr<SceneCamera>> MakeOffscreenSceneCamera(const World& scene);

}  // namespace palace
