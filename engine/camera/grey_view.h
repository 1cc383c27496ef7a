// A picture's pixels as OpenCV sees them, inside one stage.
#pragma once

#include "engine/model/image.h"

namespace cv {
class Mat;
}  // namespace cv

namespace palace {

/// OpenCV has no read-only view: who has made the view of a const picture writes nothing through
/// it. Valid as long as the picture.
cv::Mat GreyView(const ImageU8& picture);

}  // namespace palace
