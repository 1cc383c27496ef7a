#include "engine/capture/rig_cameras.h"

#include <utility>

#include "engine/capture/camera_address.h"
#include "engine/capture/picture_size.h"
#include "engine/core/text.h"

namespace palace {
namespace {

Result<CameraRequest> RequestOf(const RigFile& file, const std::string& address,
                                const std::string& rig_toml, const char* key) {
  Result<CameraRequest> request = ParseCameraAddress(address, file.folder);
  if (!request) {
    return InvalidError(rig_toml + ": capture." + key + ": " + request.error().message);
  }
  request->width = file.capture->width;
  request->height = file.capture->height;
  request->rate_hz = file.capture->rate_hz.value_or(0);
  request->fourcc = file.capture->fourcc;
  return request;
}

}  // namespace

std::string RigCameras::NameOfCamera(std::size_t index) const {
  return side_by_side() ? "Camera both" : index == 0 ? "Camera left" : "Camera right";
}

Status RigCameras::Check(std::size_t index, const ImageU8& picture) const {
  PinholeCamera expected = index == 0 ? file.rig.left.pinhole : file.rig.right.pinhole;
  std::string remedy = recorded() ? "film and calibrate in the same size"
                                  : "set the camera to that size (v4l2-ctl --list-formats-ext "
                                    "shows its sizes), or calibrate for this one";
  if (side_by_side()) {
    expected.width *= 2;
    remedy = "both halves together; " + remedy;
  }
  return CheckPictureSize(picture, expected, palace::NameOf(requests[index]), remedy);
}

double RigCameras::ToleranceAt(double rate_hz) const {
  return file.capture->pair_tolerance_s.value_or(0.5 / rate_hz);
}

Result<RigCameras> LoadRigCameras(const std::filesystem::path& rig_toml) {
  auto file = LoadRigFile(rig_toml);
  if (!file) {
    return file.error();
  }
  const std::string name = rig_toml.string();
  if (!file->capture) {
    return InvalidError(name +
                        ": table [capture] is missing; add it with left and right (device, URL or "
                        "video file)");
  }
  const PinholeCamera& left = file->rig.left.pinhole;
  const PinholeCamera& right = file->rig.right.pinhole;
  if (left.width != right.width || left.height != right.height) {
    return InvalidError(name + ": [left] is " + SizeText(left.width, left.height) +
                        ", [right] is " + SizeText(right.width, right.height) +
                        "; both cameras of a pair give the same size");
  }
  RigCameras cameras;
  cameras.file = std::move(file).value();
  cameras.rig_toml = name;
  const RigCapture& capture = *cameras.file.capture;
  std::vector<std::pair<const char*, const std::string*>> addresses = {{"left", &capture.left}};
  if (!capture.side_by_side) {
    addresses.emplace_back("right", &capture.right);
  }
  for (const auto& [key, address] : addresses) {
    auto request = RequestOf(cameras.file, *address, name, key);
    if (!request) {
      return request.error();
    }
    cameras.requests.push_back(std::move(request).value());
  }
  const bool second_recorded = cameras.requests.back().kind == CameraKind::kFile;
  if (cameras.recorded() != second_recorded) {
    return InvalidError(name + ": capture.left is " + palace::NameOf(cameras.requests.front()) +
                        ", capture.right is " + palace::NameOf(cameras.requests.back()) +
                        "; give two files or two live cameras, their clocks must agree");
  }
  if (capture.loop && !cameras.recorded()) {
    return InvalidError(name + ": capture.loop is for video files; leave it out for live cameras");
  }
  return cameras;
}

}  // namespace palace
