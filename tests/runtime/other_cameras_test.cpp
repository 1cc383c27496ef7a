// Cameras that become others in flight: the maps of the old ones end, and other sources refuse.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "engine/runtime/engine.h"
#include "engine/simulation/simulator.h"
#include "tests/support/ray_cast_camera.h"

namespace palace {
namespace {

TEST(OtherCameras, BeginTheMapAnew) {
  SimulatorOptions options;
  options.scene = MakeScene("cones", 3).value();
  EngineParts parts;
  parts.source = std::make_shared<Simulator>(std::move(options), MakeRayCastCamera);
  Engine engine(std::move(parts), false);
  const auto frames = [&] {  // in the cell that most saw
    int most = 0;
    if (const auto& decision = engine.Latest()->terrain->applied) {
      for (const std::uint16_t count : decision->elevation->frame_count.cells()) {
        most = std::max<int>(most, count);
      }
    }
    return most;
  };
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(engine.Step());
  }
  ASSERT_EQ(frames(), 3);
  ASSERT_TRUE(engine.Change({"simulation.wind_mps", 2}));
  ASSERT_TRUE(engine.Step());
  EXPECT_EQ(frames(), 4) << "wind is no calibration";
  ASSERT_TRUE(engine.Change({"simulation.rate_hz", 12}));
  ASSERT_TRUE(engine.Step());
  EXPECT_EQ(frames(), 5) << "nor is the rate";
  ASSERT_TRUE(engine.Change({"simulation.field_of_view_deg", 55}));
  ASSERT_TRUE(engine.Step());
  EXPECT_EQ(frames(), 1);
  EXPECT_NEAR(engine.Latest()->terrain->range->camera.fx_px, 320 / std::tan(0.5 * 0.9599310886),
              1e-3);
  EXPECT_FALSE(engine.Change({"simulation.field_of_view_deg", 200}));
}

}  // namespace
}  // namespace palace
