#include "engine/capture/picture_size.h"

#include "engine/core/text.h"

namespace palace {

Status CheckPictureSize(const ImageU8& picture, const PinholeCamera& camera,
                        const std::string& name, const std::string& remedy) {
  if (picture.width() == camera.width && picture.height() == camera.height) {
    return Ok();
  }
  return InvalidError(name + ": the picture is " + SizeText(picture.width(), picture.height()) +
                      ", RIG.toml says " + SizeText(camera.width, camera.height) + "; " + remedy);
}

}  // namespace palace
