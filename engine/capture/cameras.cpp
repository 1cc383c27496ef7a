#include "engine/capture/cameras.h"

#include <utility>

#include "engine/capture/camera_source.h"
#include "engine/capture/rig_cameras.h"
#include "engine/capture/video_source.h"

namespace palace {
namespace {

template <typename T>
Result<std::unique_ptr<Source>> AsSource(Result<std::unique_ptr<T>> source) {
  if (!source) {
    return source.error();
  }
  return std::unique_ptr<Source>(std::move(source).value());
}

}  // namespace

Result<std::unique_ptr<Source>> OpenCameras(const std::filesystem::path& rig_toml, bool wait_at_end,
                                            const OpenCamera& open) {
  Result<RigCameras> cameras = LoadRigCameras(rig_toml);
  if (!cameras) {
    return cameras.error();
  }
  if (cameras->recorded()) {
    return AsSource(VideoSource::Open(std::move(cameras).value(), {open, wait_at_end}));
  }
  CameraSourceOptions options;
  options.open = open;
  return AsSource(CameraSource::Open(std::move(cameras).value(), std::move(options)));
}

}  // namespace palace
