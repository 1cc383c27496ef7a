// palacectl analyze with a rig whose numbers are wrong by a unit or a digit: the map looks right,
// so the warning must come from what the pair itself measures.
#include <gmock/gmock.h>

#include <cstdio>

#include "engine/capture/picture_file.h"
#include "tests/scenarios/scenario.h"
#include "tests/tracking/ground_world.h"

namespace palace {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr double kHeight_m = 10, kBaseline_m = 0.5;
const PinholeCamera kCamera{320, 240, 386, 386, 159.5, 119.5};

class RigMistakes : public Scenario {
 protected:
  void SetUp() override {
    GroundWorld world(5);
    RigidTransform X_WC;
    X_WC.R = CameraRotationFromTilt(Rad(-90));
    for (const auto& [name, east_m] : {std::pair("l.png", 0.0), {"r.png", kBaseline_m}}) {
      X_WC.p = {0, east_m, -kHeight_m};
      ASSERT_TRUE(WriteGreyPicture(folder_ / name, world.Render(kCamera, X_WC, 2)));
    }
  }
  /// What is said of the pair with these numbers in RIG.toml.
  std::string Said(double fx_px, double height_m) const {
    char camera[160], rig[640];
    std::snprintf(
        camera, sizeof camera,
        "width = 320\nheight = 240\nfx_px = %g\nfy_px = %g\ncx_px = 159.5\ncy_px = 119.5\n", fx_px,
        fx_px);
    std::snprintf(rig, sizeof rig,
                  "[left]\n%s[right]\n%s[rig]\nbaseline_m = %g\nrectified = true\n"
                  "min_disparity_px = 8\nnum_disparities = 32\n[mount]\ntilt_deg = -90\n"
                  "position_body_m = [0.0, 0.0, 0.0]\n[pose]\nroll_deg = 0\npitch_deg = 0\n"
                  "heading_deg = 0\nheight_m = %g\n",
                  camera, camera, kBaseline_m, height_m);
    WriteFile("rig.toml", rig);
    const ProcessResult result =
        RunProcess(Palacectl({"analyze", "--left", "l.png", "--right", "r.png", "--rig", "rig.toml",
                              "--out", "out"}),
                   60);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.err;
  }
};

TEST_F(RigMistakes, NumbersThatFitAreNotDoubted) {
  const std::string said = Said(386, 10);
  EXPECT_THAT(said, Not(HasSubstr("by stereo")));
  EXPECT_THAT(said, Not(HasSubstr("field of view")));
}

TEST_F(RigMistakes, AHeightThatStereoContradictsIsNamedWithBoth) {
  EXPECT_THAT(
      Said(386, 100),
      HasSubstr("by its pose the camera is 100 m above the ground (down = 0), by stereo 10 m "
                "(median); check the height of the pose, and fx_px and baseline_m"));
  EXPECT_THAT(Said(386, 5), HasSubstr("is 5 m above the ground (down = 0), by stereo 10 m"));
}

TEST_F(RigMistakes, AFocalLengthInMillimetresIsNamed) {
  const std::string said = Said(8.8, 10);
  EXPECT_THAT(said, HasSubstr("[left] fx_px = 8.8 with width = 320 px is a field of view of 174 "
                              "degrees, which no such lens has; fx_px is in pixels"));
  EXPECT_THAT(said,
              HasSubstr("by its pose the camera is 10 m above the ground (down = 0), by stereo"));
}

}  // namespace
}  // namespace palace
