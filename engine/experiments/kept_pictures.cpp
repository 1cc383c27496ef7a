#include "engine/experiments/kept_pictures.h"

#include <cstdio>

#include "engine/capture/picture_file.h"

namespace palace {

Result<ImageU8> KeptPictures::Next(int width, int height, const std::function<ImageU8()>& draw) {
  if (dir_.empty()) {
    return draw();
  }
  char name[16];
  std::snprintf(name, sizeof(name), "%03d.png", next_++);
  const std::filesystem::path path = dir_ / name;
  std::error_code error;
  if (std::filesystem::exists(path, error)) {
    Result<ImageU8> kept = ReadGreyPicture(path);
    if (kept && (kept->width() != width || kept->height() != height)) {
      return InvalidError(path.string() + ": " + std::to_string(kept->width()) + "x" +
                          std::to_string(kept->height()) + " pixels, the field has " +
                          std::to_string(width) + "x" + std::to_string(height) +
                          "; delete the kept pictures");
    }
    return kept;
  }
  ImageU8 drawn = draw();
  std::filesystem::create_directories(dir_, error);
  // Under its own name only when whole: an experiment may be ended at any time.
  const std::filesystem::path part = dir_ / (std::string("part-") + name);
  if (const Status written = WriteGreyPicture(part, drawn); !written) {
    return written.error();
  }
  std::filesystem::rename(part, path, error);
  if (error) {
    return UnavailableError(path.string() + ": " + error.message());
  }
  return drawn;
}

}  // namespace palace
