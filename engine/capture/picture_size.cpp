#include "engine/capture/picture_size.h"

namespace palace {

std::string SizeText(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height) + " px";
}

Status CheckPictureSize(const ImageU8& picture, const PinholeCamera& camera,
                        const std::string& name, const std::string& remedy) {
  if (picture.width() == camera.width && picture.height() == camera.height) {
    return Ok();
  }
  return InvalidError(name + ": the picture is " + SizeText(picture.width(), picture.height()) +
                      ", RIG.toml says " + SizeText(camera.width, camera.height) + "; " + remedy);
}

}  // namespace palace
