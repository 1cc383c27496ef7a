// The views: one large, three beside it.
#include "gui/panels/fly_panels.h"
#include "gui/panels/simulate/simulate.h"
#include "gui/widgets/button.h"
#include "gui/widgets/interact.h"
#include "gui/widgets/number_text.h"

namespace palace {
namespace {

constexpr std::array<WorldEye, kWorldEyes> kEyes = {WorldEye::kLeft,  WorldEye::kRight,
                                                    WorldEye::kChase, WorldEye::kBirdsEye,
                                                    WorldEye::kAbove, WorldEye::kOrbit};

struct Words {
  const char *name, *title, *chip;
};
Words WordsOf(WorldEye eye) {
  switch (eye) {
    case WorldEye::kLeft:
      return {"left", "Left camera", "Left"};
    case WorldEye::kRight:
      return {"right", "Right camera", "Right"};
    case WorldEye::kChase:
      return {"chase", "Chase", "Chase"};
    case WorldEye::kBirdsEye:
      return {"birds_eye", "Bird's eye", "Bird's eye"};
    case WorldEye::kAbove:
      return {"above", "From above, north up", "Above"};
    case WorldEye::kOrbit:
      break;
  }
  return {"orbit", "Free orbit", "Orbit"};
}

bool IsCamera(WorldEye eye) { return eye == WorldEye::kLeft || eye == WorldEye::kRight; }

/// Where the picture lies in its panel: a camera's keeps its shape.
Rect PictureIn(const Rect& content, WorldEye eye, const EngineSnapshot& snap) {
  if (!IsCamera(eye) || !snap.sensors->rig) {
    return content;
  }
  const PinholeCamera& camera = snap.sensors->rig->left.pinhole;
  return PictureRect(content, static_cast<double>(camera.width) / camera.height);
}

void DrawPicture(const Rect& content, WorldEye eye, const EngineSnapshot& snap, UiFrame& ui) {
  const Style& s = ui.style;
  const ImTextureID id = ui.textures.world[static_cast<std::size_t>(eye)];
  const Rect picture = PictureIn(content, eye, snap);
  if (id != nullptr) {
    Canvas()->AddImage(id, picture.min(), picture.max());
  } else {
    UnknownFill(s, Canvas(), picture);
    const std::string& why = ui.textures.world_waits_for;
    if (!why.empty() && !IsCamera(eye)) {
      TextPlate(ui, picture, Corner::kTopLeft, FitWords(s.caption, why, picture.w - s.Px(32)));
    }
  }
}

constexpr double kNewTruth_s = 0.5;  // bundles without pictures come every 0.2 s

/// Of what the outside views show, by the vehicle's clock.
double TruthAge(const EngineSnapshot& snap) {
  return snap.sensors->truth ? SecondsBetween(snap.sensors->truth->time, snap.time) : 0.0;
}

/// The choice of the main view, at the right end of its header.
void DrawEyeChips(const Rect& panel, WorldEye main, UiFrame& ui) {
  const Style& s = ui.style;
  float x = panel.right() - s.Px(6);
  for (std::size_t i = kEyes.size(); i-- > 0;) {
    const Words words = WordsOf(kEyes[i]);
    const float w = TextWidth(s.caption, words.chip) + s.Px(18);
    x -= w;
    ButtonLook look;
    look.font = s.caption;
    look.active = kEyes[i] == main;
    const std::string hint = "Key " + std::to_string(i + 1);
    look.hint = hint;
    if (DrawButton(ui, std::string("world_view/") + words.name, {x, panel.y + s.Px(3), w, s.Px(22)},
                   words.chip, look)) {
      ui.intents.push_back(UiAction(ShowWorldView{kEyes[i]}));
    }
    x -= s.Px(4);
  }
}

void DrawMain(const EngineSnapshot& snap, const Rect& panel, WorldEye eye, UiFrame& ui) {
  const Rect content = DrawPanelFrame(ui, panel, EyeWords(eye));
  DrawEyeChips(panel, eye, ui);
  DrawPicture(content, eye, snap, ui);
  if (!IsCamera(eye)) {
    const double age_s = TruthAge(snap);
    TextPlate(ui, content, Corner::kBottomLeft,
              age_s > kNewTruth_s
                  ? "Truth of " + Fixed(age_s, 1) + " s ago: no newer one has come"
                  : std::string("Truth: the world as it is, not as it is measured"));
  }
  if (eye == WorldEye::kOrbit) {
    RunOrbit(ui, "orbit", content);
  }
}

void DrawSmall(const EngineSnapshot& snap, const Rect& panel, WorldEye eye, UiFrame& ui) {
  const Style& s = ui.style;
  const Rect content =
      DrawPanelFrame(ui, panel, EyeWords(eye), {{IsCamera(eye) ? "" : "Truth", 0, false, false}});
  DrawPicture(content, eye, snap, ui);
  const Interaction in = Interact(ui, std::string("swap/") + EyeName(eye), panel, 0, EyeWords(eye));
  if (in.hovered) {
    StrokeRect(Canvas(), panel, s.palette.white_mark, s.Fine(1), s.Fine(4));
  }
  if (in.clicked) {
    ui.intents.push_back(UiAction(ShowWorldView{eye}));
  }
}

}  // namespace

const char* EyeName(WorldEye eye) { return WordsOf(eye).name; }
const char* EyeWords(WorldEye eye) { return WordsOf(eye).title; }

void ShowEye(WorldEye eye, SimulateState& state) {
  for (WorldEye& shown : state.eyes) {
    if (shown == eye) {
      std::swap(shown, state.eyes[0]);
      return;
    }
  }
  state.eyes[0] = eye;
}

void DrawWorldViews(const EngineSnapshot& snap, const SimulateLayout& layout, SimulateState& state,
                    UiFrame& ui) {
  DrawMain(snap, layout.eyes[0], state.eyes[0], ui);
  for (std::size_t i = 1; i < layout.eyes.size(); ++i) {
    DrawSmall(snap, layout.eyes[i], state.eyes[i], ui);
  }
}

}  // namespace palace
