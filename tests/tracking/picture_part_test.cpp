// The fast ways of cutting parts from a picture against the plain ones, to the bit.
#include "engine/tracking/picture_part.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "engine/tracking/view_geometry.h"
#include "tests/tracking/ground_world.h"

namespace palace {
namespace {

ImageU8 PlainWarpedSquare(const ImageU8& source, const Eigen::Matrix3d& source_from_view,
                          const Eigen::Vector2d& centre, int side) {
  cv::Mat map_x(side, side, CV_32F), map_y(side, side, CV_32F);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const Eigen::Vector2d offset(x - 0.5 * (side - 1), y - 0.5 * (side - 1));
      const Eigen::Vector2d at = MapPixel(source_from_view, centre + offset);
      map_x.at<float>(y, x) = static_cast<float>(at.x());
      map_y.at<float>(y, x) = static_cast<float>(at.y());
    }
  }
  const auto view = [](const ImageU8& picture) {
    return cv::Mat(picture.height(), picture.width(), CV_8U,
                   const_cast<std::uint8_t*>(picture.pixels().data()));
  };
  ImageU8 square(side, side);
  cv::Mat out = view(square);
  cv::remap(view(source), out, map_x, map_y, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return square;
}

TEST(WarpedSquare, IsThatOfThePlainWayToTheBit) {
  const PinholeCamera camera{640, 480, 772.548, 772.548, 319.5, 239.5};
  GroundWorld world(3);
  const ImageU8 source = world.Render(camera, Descent{}.CameraAt(0), 2);
  RandomStream random(4);
  for (int i = 0; i < 60; ++i) {
    const RigidTransform X_WA = Descent{}.CameraAt(i), X_WB = Descent{}.CameraAt(i / 2);
    const Eigen::Matrix3d H = i % 5 == 0 ? Eigen::Matrix3d(Eigen::Matrix3d::Identity())
                                         : *PlaneHomography(camera, X_WA, X_WB, {});
    const Eigen::Vector2d centre(random.Uniform(-20, 660), random.Uniform(-20, 500));
    const int side = 40 + i % 30;
    EXPECT_EQ(WarpedSquare(source, H, centre, side).pixels(),
              PlainWarpedSquare(source, H, centre, side).pixels())
        << i;
  }
}

}  // namespace
}  // namespace palace
