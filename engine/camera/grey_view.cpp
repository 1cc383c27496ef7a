#include "engine/camera/grey_view.h"

#include <opencv2/core.hpp>

namespace palace {

cv::Mat GreyView(const ImageU8& picture) {
  return cv::Mat(picture.height(), picture.width(), CV_8UC1,
                 const_cast<std::uint8_t*>(picture.pixels().data()));
}

}  // namespace palace
