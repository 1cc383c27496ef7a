// Draws panels without a screen: an ImGui context with a built font atlas and no backend. Tests
// move the mouse, advance frames and read items and intents.
#pragma once

#include <cstdio>
#include <fstream>
#include <functional>
#include <string>

#include <imgui.h>

#include "gui/widgets/draw.h"
#include "gui/widgets/imgui_input.h"
#include "gui/widgets/interact.h"

namespace palace {

class UiHarness {
 public:
  UiHarness(float width, float height, float scale = 1) {
    context_ = ImGui::CreateContext();
    Use();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {width, height};
    io.DeltaTime = 1.0f / 60;
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    StartFedInput();
    style.scale = scale;
    style.palette = MakeDarkPalette();
    LoadFonts(scale);
    unsigned char* pixels = nullptr;
    int w = 0;
    int h = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &w, &h);
  }
  ~UiHarness() { ImGui::DestroyContext(context_); }
  UiHarness(const UiHarness&) = delete;
  UiHarness& operator=(const UiHarness&) = delete;

  /// Runs one frame of 1/60 s (or dt_s).
  void Frame(const std::function<void(UiFrame&)>& draw, float dt_s = 1.0f / 60) {
    Use();
    ImGuiIO& io = ImGui::GetIO();
    io.DeltaTime = dt_s;
    time_s += static_cast<double>(dt_s);
    items.Clear();
    UiFrame ui{style, textures, items, intents, focus, time_s, popup, wave_off_rect, explain};
    ui.highlighted_site = highlighted_site;
    ui.why_not_flown = why_not_flown;
    ui.unseen_on_way = unseen_on_way;
    ImGui::NewFrame();
    BeginCanvas(ui);
    draw(ui);
    EndCanvas(ui);
    ImGui::Render();
    Highlight();
  }
  void MoveTo(ImVec2 p) { Use(), FeedMousePosition(p); }
  void MoveTo(const std::string& item) {
    if (const Item* found = items.Find(item)) {
      MoveTo(found->rect.centre());
    } else {
      std::fprintf(stderr, "no item %s\n", item.c_str());
    }
  }
  void Button(bool down) { Use(), FeedMouseButton(0, down); }
  void Key(ImGuiKey key, bool down) { Use(), FeedKey(key, down); }
  /// Presses and releases a key over two frames.
  void Tap(ImGuiKey key, const std::function<void(UiFrame&)>& draw) {
    Key(key, true);
    Frame(draw);
    Key(key, false);
    Frame(draw);
  }
  /// Moves onto the item of the last frame, presses and releases over four frames.
  void Click(const std::string& item, const std::function<void(UiFrame&)>& draw) {
    MoveTo(item);
    Frame(draw);
    Button(true);
    Frame(draw);
    Frame(draw);
    Button(false);
    Frame(draw);
  }
  template <typename T>
  int CountCommands() const {
    int count = 0;
    for (const Intent& intent : intents) {
      const auto* command = std::get_if<CommandAction>(&intent);
      count += command != nullptr && std::holds_alternative<T>(*command) ? 1 : 0;
    }
    return count;
  }
  template <typename T>
  T LastCommand() const {
    T found{};
    for (const Intent& intent : intents) {
      if (const auto* command = std::get_if<CommandAction>(&intent)) {
        if (const T* typed = std::get_if<T>(command)) {
          found = *typed;
        }
      }
    }
    return found;
  }

  Style style;
  PanelTextures textures;
  ItemRecord items;
  Intents intents;  ///< all so far, but for the highlight, which is carried out
  Focus focus;
  std::uint64_t highlighted_site = 0;
  double time_s = 0;
  bool popup = false;
  Rect wave_off_rect;
  CellExplainer explain = nullptr;
  WayJudge why_not_flown = nullptr;
  WayLength unseen_on_way = nullptr;

 private:
  /// The one intent that comes back to the panels without the engine.
  void Highlight() {
    for (auto it = intents.begin(); it != intents.end();) {
      const auto* action = std::get_if<UiAction>(&*it);
      const auto* site = action != nullptr ? std::get_if<HighlightSite>(action) : nullptr;
      highlighted_site = site != nullptr ? site->site_id : highlighted_site;
      it = site != nullptr ? intents.erase(it) : it + 1;
    }
  }
  /// Several harnesses may live at a time; ImGui's context is one global.
  void Use() { ImGui::SetCurrentContext(context_); }
  static bool Exists(const std::string& path) { return std::ifstream(path).good(); }
  void LoadFonts(float scale) {
    // Widths matter for the overlap tests, so the real faces are used where they are installed.
    const std::string roboto = "/usr/share/fonts/truetype/roboto/unhinted/RobotoTTF/Roboto-";
    const std::string mono = "/usr/share/fonts/truetype/jetbrains-mono/JetBrainsMono-Regular.ttf";
    static const ImWchar ranges[] = {0x20,   0xFF,   0x2013, 0x2014, 0x2026, 0x2026,
                                     0x2032, 0x2032, 0x2212, 0x2212, 0x2264, 0x2265,
                                     0x0394, 0x0394, 0x03C3, 0x03C3, 0};
    ImFontAtlas* atlas = ImGui::GetIO().Fonts;
    const auto load = [&](const std::string& path, float size) {
      return Exists(path) ? atlas->AddFontFromFileTTF(path.c_str(), size * scale, nullptr, ranges)
                          : atlas->AddFontDefault();
    };
    style.caption = load(roboto + "Regular.ttf", 15.25f);
    style.body = load(roboto + "Regular.ttf", 16.5f);
    style.medium = load(roboto + "Medium.ttf", 16.5f);
    style.section = load(roboto + "Medium.ttf", 18.75f);
    style.button = load(roboto + "Bold.ttf", 21);
    style.readout = load(roboto + "Medium.ttf", 23.5f);
    style.mode = load(roboto + "Bold.ttf", 23.5f);
    style.mode_replay = load(roboto + "Bold.ttf", 20);
    style.wave_off = load(roboto + "Bold.ttf", 28);
    style.replay_time = load(roboto + "Medium.ttf", 30.5f);
    style.mono = load(mono, 17);
  }
  ImGuiContext* context_ = nullptr;
};

}  // namespace palace
