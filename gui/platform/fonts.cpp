#include "gui/platform/fonts.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <string>

#include <imgui.h>

#include "engine/core/log.h"

namespace palace {
namespace {

constexpr const char* kRoboto = "/usr/share/fonts/truetype/roboto/unhinted/RobotoTTF/Roboto-";
constexpr const char* kMono = "/usr/share/fonts/truetype/jetbrains-mono/JetBrainsMono-Regular.ttf";

/// Latin-1, then dashes, dots, primes, minus, comparisons, delta and sigma.
constexpr std::array<ImWchar, 21> kGlyphs = {0x0020, 0x00FF, 0x0394, 0x0394, 0x03C3, 0x03C3,
                                             0x2013, 0x2014, 0x2026, 0x2026, 0x2032, 0x2032,
                                             0x2212, 0x2212, 0x2264, 0x2265, 0};

struct Role {
  ImFont* Fonts::*font;
  const char* face;  ///< null: JetBrains Mono
  double size;       ///< ascent minus descent, as stb sizes a font: em x 1.172, mono em x 1.32
};
constexpr std::array<Role, 11> kRoles = {{{&Fonts::body, "Regular", 16.5},
                                          {&Fonts::caption, "Regular", 15.25},
                                          {&Fonts::medium, "Medium", 16.5},
                                          {&Fonts::section, "Medium", 18.75},
                                          {&Fonts::button, "Bold", 21},
                                          {&Fonts::readout, "Medium", 23.5},
                                          {&Fonts::mode, "Bold", 23.5},
                                          {&Fonts::mode_replay, "Bold", 20},
                                          {&Fonts::wave_off, "Bold", 28},
                                          {&Fonts::replay_time, "Medium", 30.5},
                                          {&Fonts::mono, nullptr, 17}}};

ImFont* BuiltIn(ImFontAtlas& atlas, double size) {
  ImFontConfig config;
  config.SizePixels = static_cast<float>(std::round(size * 0.85));
  return atlas.AddFontDefault(&config);
}

}  // namespace

Fonts LoadFonts(ImFontAtlas& atlas, double scale) {
  // Whole pixels, rounded down: later versions of Dear ImGui do so by themselves, and a text has
  // the same width whichever is installed.
  const auto pixels = [&](const Role& role) {
    return static_cast<float>(std::floor(role.size * scale));
  };
  Fonts fonts;
  atlas.Clear();
  for (const Role& role : kRoles) {
    const std::string path =
        role.face != nullptr ? std::string(kRoboto) + role.face + ".ttf" : std::string(kMono);
    std::error_code unread;
    ImFont* font = nullptr;
    // ImGui asserts on a missing file, so look first.
    if (std::filesystem::is_regular_file(path, unread)) {
      ImFontConfig config;
      config.OversampleH = 2;
      config.OversampleV = 1;
      config.PixelSnapH = false;
      font = atlas.AddFontFromFileTTF(path.c_str(), pixels(role), &config, kGlyphs.data());
    }
    if (font == nullptr) {
      fonts.fallback = true;
      font = BuiltIn(atlas, pixels(role));
    }
    fonts.*role.font = font;
  }
  if (fonts.fallback) {
    LogWarning(
        "a font file is missing, ImGui's own font stands in; install "
        "fonts-roboto-unhinted and fonts-jetbrains-mono");
  }
  atlas.Build();
  return fonts;
}

}  // namespace palace
