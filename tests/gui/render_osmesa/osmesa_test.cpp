// The render room draws through a driver of another kind: the same library, linked to OSMesa.
#include <vector>

// osmesa.h brings GL/gl.h, whose functions of OpenGL 1.5 and later are declared on demand.
#define GL_GLEXT_PROTOTYPES
#include <GL/osmesa.h>
#include <gtest/gtest.h>

#include "gui/render/scene_renderer.h"
#include "tests/support/expected.h"

namespace palace {
namespace {

TEST(OsMesaTest, SceneIsDrawnThroughOffscreenMesa) {
  const int wishes[] = {OSMESA_FORMAT,
                        OSMESA_RGBA,
                        OSMESA_DEPTH_BITS,
                        24,
                        OSMESA_PROFILE,
                        OSMESA_CORE_PROFILE,
                        OSMESA_CONTEXT_MAJOR_VERSION,
                        3,
                        OSMESA_CONTEXT_MINOR_VERSION,
                        3,
                        0};
  OSMesaContext context = OSMesaCreateContextAttribs(wishes, nullptr);
  if (context == nullptr) {
    ASSERT_FALSE(GlIsExpected()) << "OSMesa is there but makes no OpenGL 3.3 core context";
    GTEST_SKIP() << "runs where Mesa has a software driver (libgl1-mesa-dri)";
  }
  std::vector<unsigned char> screen(16 * 16 * 4);
  ASSERT_TRUE(OSMesaMakeCurrent(context, screen.data(), GL_UNSIGNED_BYTE, 16, 16));
  {
    World scene;
    scene.solids = {StandingOn(scene.ground, Box{2, 2, 0.5}, 0, 0)};
    scene.solids[0].albedo = 1;
    auto renderer = SceneRenderer::Create(scene, {0.0F, 0.0F, false});
    ASSERT_TRUE(renderer.ok()) << renderer.error().message;
    const PinholeCamera camera{160, 120, 170, 170, 79.5, 59.5};
    const RigidTransform X_WC{CameraRotationFromTilt(-1.5707963267948966), {0, 0, -10}};
    const Result<ImageU8> picture = (*renderer)->Render(camera, X_WC);
    ASSERT_TRUE(picture.ok()) << picture.error().message;
    EXPECT_EQ(picture->at(80, 60), 255);  // the box
    EXPECT_EQ(picture->at(10, 10), 0);    // plain black ground
    // 2 m wide, 9.5 m away: 36 pixels.
    int width = 0;
    for (int x = 0; x < 160; ++x) {
      width += picture->at(x, 60) > 127 ? 1 : 0;
    }
    EXPECT_NEAR(width, 170 * 2 / 9.5, 1.01);
  }
  OSMesaDestroyContext(context);
}

}  // namespace
}  // namespace palace
