#include "engine/capture/single_pictures.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "engine/capture/camera_address.h"
#include "engine/capture/picture_file.h"
#include "engine/capture/picture_order.h"

namespace palace {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 6> kEndings = {".png",  ".jpg", ".jpeg",
                                                      ".tiff", ".tif", ".pgm"};

bool IsPicture(const fs::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end();
}

Result<SinglePictures> OpenFolder(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code code;
  for (fs::directory_iterator at(folder, code), end; !code && at != end; at.increment(code)) {
    std::error_code ignored;
    if (IsPicture(at->path()) && at->is_regular_file(ignored)) {
      files.push_back(at->path());
    }
  }
  if (code) {
    return UnavailableError(folder.string() + ": cannot be read; check its permissions");
  }
  if (files.empty()) {
    return InvalidError(folder.string() +
                        ": holds no pictures; give a folder of PNG, JPEG, TIFF or PGM files");
  }
  std::sort(files.begin(), files.end(), IsEarlierName);
  SinglePictures pictures;
  pictures.name = folder.string();
  pictures.device.frame_count = files.size();
  pictures.device.read = [files = std::move(files), next = std::size_t{0},
                          name = pictures.name]() mutable -> Result<CameraPicture> {
    if (next == files.size()) {
      return Error{ErrorCode::kEnd, name + ": end of the folder"};
    }
    Result<ImageU8> grey = ReadGreyPicture(files[next++]);
    if (!grey) {
      return grey.error();
    }
    return CameraPicture{std::move(grey).value(), NAN};
  };
  return pictures;
}

}  // namespace

Result<SinglePictures> OpenSinglePictures(const std::string& source, const fs::path& folder,
                                          int width, int height, const OpenCamera& open) {
  std::error_code ignored;
  if (fs::is_directory(folder / source, ignored)) {
    return OpenFolder((folder / source).lexically_normal());
  }
  Result<CameraRequest> request = ParseCameraAddress(source, folder);
  if (!request) {
    return request.error();
  }
  request->width = width;
  request->height = height;
  Result<CameraDevice> device = open(*request);
  if (!device) {
    return device.error();
  }
  return SinglePictures{NameOf(*request), request->kind != CameraKind::kFile,
                        std::move(device).value()};
}

}  // namespace palace
