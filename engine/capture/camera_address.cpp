#include "engine/capture/camera_address.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <string_view>
#include <system_error>

namespace palace {
namespace {

constexpr std::array<std::string_view, 4> kSchemes = {"rtsp", "rtsps", "http", "https"};
constexpr std::size_t kSniffed = 4096;
constexpr const char* kListDevices = "list what there is with: v4l2-ctl --list-devices";

bool AllDigits(const std::string& text) {
  return !text.empty() &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c); });
}

/// Video holds control bytes within its first kilobytes; text does not. (The decoder library would
/// show a text file as a film of its letters.)
bool LooksLikeText(std::string_view start) {
  constexpr std::string_view kRawVideo = "YUV4MPEG2 ";  // the one container with a text header
  if (start.substr(0, kRawVideo.size()) == kRawVideo) {
    return false;
  }
  return std::none_of(start.begin(), start.end(), [](unsigned char c) {
    return c < 32 && c != '\t' && c != '\n' && c != '\r' && c != '\f' && c != '\x1b';
  });
}

Status CheckDevice(const std::string& path) {
  std::error_code code;
  const auto status = std::filesystem::status(path, code);
  if (!std::filesystem::exists(status)) {
    return UnavailableError(path + ": no such camera; plug it in, or " + kListDevices);
  }
  if (!std::filesystem::is_character_file(status)) {
    return InvalidError(path + ": this is no camera device; " + kListDevices);
  }
  if (access(path.c_str(), R_OK | W_OK) != 0) {
    return UnavailableError(path +
                            ": no permission to use this camera; add yourself to its group with: "
                            "sudo usermod -aG video $USER, then log in again");
  }
  return Ok();
}

Status CheckFile(const std::string& path) {
  std::error_code code;
  const auto status = std::filesystem::status(path, code);
  if (!std::filesystem::exists(status)) {
    return UnavailableError(path + ": no such video file; check the name");
  }
  if (!std::filesystem::is_regular_file(status)) {
    return InvalidError(path + ": this is no file; name a video file, a device or a URL");
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    return UnavailableError(path + ": cannot be read; check its permissions");
  }
  std::string start(kSniffed, '\0');
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(file.gcount()));
  if (start.empty()) {
    return InvalidError(path + ": the file is empty; record it again");
  }
  if (LooksLikeText(start)) {
    return InvalidError(path + ": this is text, no video; name a video file, a device or a URL");
  }
  return Ok();
}

}  // namespace

Result<CameraRequest> ParseCameraAddress(const std::string& text,
                                         const std::filesystem::path& folder) {
  CameraRequest request;
  const std::size_t scheme = text.find("://");
  if (AllDigits(text)) {
    request.kind = CameraKind::kDevice;
    request.address = "/dev/video" + text;
  } else if (text.rfind("/dev/", 0) == 0) {
    request.kind = CameraKind::kDevice;
    request.address = text;
  } else if (scheme != std::string::npos) {
    if (std::find(kSchemes.begin(), kSchemes.end(), text.substr(0, scheme)) == kSchemes.end()) {
      return InvalidError(text.substr(0, scheme) +
                          ":// is not supported; use rtsp, rtsps, http or https, or name a device "
                          "or a file");
    }
    request.kind = CameraKind::kStream;
    request.address = text;
  } else {
    request.kind = CameraKind::kFile;
    request.address = (folder / text).lexically_normal().string();
  }
  return request;
}

std::string NameOf(const CameraRequest& request) {
  if (request.kind != CameraKind::kStream) {
    return request.address;
  }
  const std::size_t host = request.address.find("://") + 3;
  const std::size_t path = request.address.find('/', host);
  const std::size_t at = request.address.rfind('@', path);
  return at == std::string::npos || at < host
             ? request.address
             : request.address.substr(0, host) + request.address.substr(at + 1);
}

Status CheckCameraAddress(const CameraRequest& request) {
  switch (request.kind) {
    case CameraKind::kDevice:
      return CheckDevice(request.address);
    case CameraKind::kFile:
      return CheckFile(request.address);
    case CameraKind::kStream:
      return Ok();
  }
  PALACE_CHECK(false);
}

}  // namespace palace
