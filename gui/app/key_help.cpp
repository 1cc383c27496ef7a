#include "gui/app/key_help.h"

#include <algorithm>
#include <cmath>

#include "gui/app/keys.h"
#include "gui/widgets/interact.h"

namespace palace {

void DrawKeyHelp(const Rect& body, UiFrame& ui) {
  const Style& s = ui.style;
  const auto& keys = KeyTable();
  const int rows = (static_cast<int>(keys.size()) + 1) / 2;
  const float row = std::min(s.Px(22), std::floor((body.h - s.Px(72)) / static_cast<float>(rows)));
  const float width = s.Px(840), height = s.Px(72) + row * static_cast<float>(rows);
  const Rect box{body.centre().x - width / 2, body.centre().y - height / 2, width, height};
  BeginOverlay("##key_help", box);
  ImDrawList* dl = Canvas();
  FillRect(dl, box, s.palette.control, s.Fine(4));
  StrokeRect(dl, box, s.palette.strong_line, 1, s.Fine(4));
  DrawText(ui, s.section, s.palette.text1, box.x + s.Px(20), box.y + s.Px(28), "Keys");
  DrawText(ui, s.caption, s.palette.text2, box.right() - s.Px(20), box.y + s.Px(28),
           "F1 or Escape closes", Align::kRight);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const float x = box.x + s.Px(20) + (static_cast<int>(i) < rows ? 0 : width / 2 - s.Px(10));
    const float y = box.y + s.Px(62) + row * static_cast<float>(static_cast<int>(i) % rows);
    DrawText(ui, s.medium, s.palette.text1, x, y, keys[i].keys);
    DrawText(ui, s.body, s.palette.text2, x + s.Px(112), y,
             FitWords(s.body, keys[i].description, width / 2 - s.Px(140)));
  }
  EndOverlay();
  ui.items.Add("key_help", box, true, "Keys");
}

}  // namespace palace
