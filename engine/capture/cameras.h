// The source behind RIG.toml's [capture]: live cameras or filmed ones.
#pragma once

#include <filesystem>
#include <memory>

#include "engine/capture/opencv_camera.h"
#include "engine/runtime/source.h"

namespace palace {

/// Two files give a VideoSource, devices and streams a CameraSource. `wait_at_end` is for films.
Result<std::unique_ptr<Source>> OpenCameras(const std::filesystem::path& rig_toml, bool wait_at_end,
                                            const OpenCamera& open = OpenWithOpenCv);

}  // namespace palace
