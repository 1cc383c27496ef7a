// The offscreen screen: ImGui without any window, fonts, screenshots.
#include <filesystem>
#include <vector>

#include <gtest/gtest.h>
#include <imgui.h>
#include <opencv2/imgcodecs.hpp>

#include "gui/platform/imgui_backend.h"
#include "gui/platform/offscreen.h"
#include "gui/platform/screenshot.h"
#include "gui/platform/window.h"
#include "tests/support/environment.h"
#include "tests/support/expected.h"
#include "tests/support/own_path.h"
#include "tests/support/x_server.h"

namespace palace {
namespace {

TEST(OffscreenTest, ImGuiDrawsWithoutAWindowAndFollowsASize) {
  Result<std::unique_ptr<Offscreen>> opened = Offscreen::Open(320, 200);
  PALACE_REQUIRE_GL(opened);
  const std::unique_ptr<Offscreen> screen = std::move(opened).value();
  auto backend = ImGuiBackend::ForOffscreen(*screen, 1);
  ASSERT_TRUE(backend.ok()) << backend.error().message;
  const auto draw = [&] {
    (*backend)->BeginFrame(1 / 60.0);
    ImGui::GetForegroundDrawList()->AddRectFilled({10, 20}, {60, 50}, IM_COL32(255, 0, 0, 255));
    (*backend)->EndFrame();
    return screen->ReadPixels();
  };
  ImageRgba picture = draw();
  EXPECT_EQ(picture.at(30, 30), (Rgba8{255, 0, 0, 255}));
  EXPECT_EQ(picture.at(30, 180), RgbaFromHex(0x090C10));  // y runs down, background below
  ASSERT_TRUE(screen->SetSize(400, 300).ok());
  (*backend)->SetUiScale(1.5);
  picture = draw();
  EXPECT_EQ(picture.width(), 400);
  EXPECT_EQ(picture.at(30, 30), (Rgba8{255, 0, 0, 255}));
}

/// The background is cleared, not drawn: the same pixels as a fill over the whole window.
TEST(OffscreenTest, ABackgroundIsWhatAFillOfItWouldBe) {
  Result<std::unique_ptr<Offscreen>> opened = Offscreen::Open(64, 48);
  PALACE_REQUIRE_GL(opened);
  const std::unique_ptr<Offscreen> screen = std::move(opened).value();
  auto backend = ImGuiBackend::ForOffscreen(*screen, 1);
  ASSERT_TRUE(backend.ok()) << backend.error().message;
  const auto draw = [&](ImU32 background, ImU32 fill) {
    (*backend)->BeginFrame(1 / 60.0);
    if (fill != 0) {
      ImGui::GetBackgroundDrawList()->AddRectFilled({0, 0}, {64, 48}, fill);
    }
    (*backend)->EndFrame(background);
    return screen->ReadPixels();
  };
  // The windows of the three palettes, and every step that eight bits can round.
  std::vector<ImU32> colours = {IM_COL32(0x09, 0x0C, 0x10, 255), IM_COL32(0xE3, 0xE7, 0xEC, 255),
                                IM_COL32(0, 0, 0, 255)};
  for (int level = 0; level < 256; ++level) {
    colours.push_back(IM_COL32(level, 255 - level, level / 2, 255));
  }
  for (const ImU32 colour : colours) {
    EXPECT_EQ(draw(colour, 0).pixels(), draw(IM_COL32(255, 0, 255, 255), colour).pixels())
        << std::hex << colour;
  }
}

TEST(OffscreenTest, FontsScaleAndHoldTheirGlyphs) {
  Result<std::unique_ptr<Offscreen>> opened = Offscreen::Open(320, 200);
  PALACE_REQUIRE_GL(opened);
  const std::unique_ptr<Offscreen> screen = std::move(opened).value();
  auto backend = ImGuiBackend::ForOffscreen(*screen, 2);
  ASSERT_TRUE(backend.ok());
  const Fonts& fonts = (*backend)->fonts();
  if (fonts.fallback) {
    ASSERT_FALSE(FontsAreExpected()) << "a face was not found where its package puts it";
    GTEST_SKIP() << "runs with fonts-roboto-unhinted and fonts-jetbrains-mono installed";
  }
  EXPECT_FLOAT_EQ(fonts.caption->FontSize, 30.0F);  // 2 x 15.25, in whole pixels
  EXPECT_FLOAT_EQ(fonts.wave_off->FontSize, 56.0F);
  for (const ImWchar glyph : {0x2212, 0x2264, 0x2265, 0x03C3, 0x00B0, 0x00B1, 0x2013, 0x2026}) {
    EXPECT_NE(fonts.body->FindGlyphNoFallback(glyph), nullptr) << std::hex << glyph;
  }
  // Numbers must not dance: all digits have one width.
  for (char digit = '1'; digit <= '9'; ++digit) {
    EXPECT_EQ(fonts.readout->FindGlyph(static_cast<ImWchar>(digit))->AdvanceX,
              fonts.readout->FindGlyph('0')->AdvanceX);
  }
}

TEST(ScreenshotTest, WritesWhatWasGivenAndNamesWhatItCannotWrite) {
  const std::string path = OwnPath(".png").string();
  ImageRgba picture(3, 2, RgbaFromHex(0x102030));
  picture.at(2, 1) = RgbaFromHex(0xFF8001);
  ASSERT_TRUE(SavePng(picture, path).ok());
  const cv::Mat read = cv::imread(path);
  ASSERT_EQ(read.cols, 3);
  EXPECT_EQ(read.at<cv::Vec3b>(1, 2), cv::Vec3b(0x01, 0x80, 0xFF));
  std::filesystem::remove(path);
  const Status refused = SavePng(picture, "/no/such/folder/a.png");
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("/no/such/folder/a.png"), std::string::npos);
}

TEST(WindowTest, WithoutADisplaySaysHowToRunWithoutOne) {
  const EnvironmentVariable x11("DISPLAY", std::nullopt), wayland("WAYLAND_DISPLAY", std::nullopt);
  const auto window = Window::Open("PALACE", 640, 360, true);
  ASSERT_FALSE(window.ok());
  EXPECT_NE(window.error().message.find("--headless"), std::string::npos);
}

TEST(WindowTest, HiddenWindowDrawsAndResizes) {
  if (!XServer::IsInstalled()) {
    ASSERT_FALSE(InCi());
    GTEST_SKIP() << "runs with xvfb installed";
  }
  const XServer server;
  ASSERT_NE(server.display(), "") << server.Complaint();
  const EnvironmentVariable x11("DISPLAY", server.display());
  const EnvironmentVariable wayland("WAYLAND_DISPLAY", std::nullopt);
  auto opened = Window::Open("PALACE", 320, 200, true);
  ASSERT_TRUE(opened.ok()) << opened.error().message;
  Window& window = **opened;
  auto backend = ImGuiBackend::ForWindow(window, 1);
  ASSERT_TRUE(backend.ok()) << backend.error().message;
  (*backend)->BeginFrame(1 / 60.0);
  ImGui::GetForegroundDrawList()->AddRectFilled({10, 20}, {60, 50}, IM_COL32(0, 255, 0, 255));
  (*backend)->EndFrame();
  const ImageRgba picture = window.ReadPixels();
  EXPECT_EQ(picture.width(), 320);
  EXPECT_EQ(picture.at(30, 30).g, 255);
  EXPECT_EQ(picture.at(30, 180).g, 0x0C);
  EXPECT_GT(window.dots_per_inch(), 20);
  EXPECT_FALSE(window.PollInput().close_requested);
}

}  // namespace
}  // namespace palace
