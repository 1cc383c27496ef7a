#include "gui/app/toast.h"

#include <algorithm>
#include <vector>

namespace palace {

Rect ToastRoom(const FlyLayout& fly, const Style& s) {
  const Rect& view = fly.view_3d;
  const float edge = s.Px(8), head = s.Px(28), foot = s.Px(36);
  return {view.x + edge, view.y + head + edge, view.w - 2 * edge, view.h - head - edge - foot};
}

Rect ToastRoom(const FrameLayout& frame, const Style& s) {
  const Rect& body = frame.body;
  const float column = s.Px(frame.narrow ? 360 : 432), edge = s.Px(16);
  return {body.x + edge, body.y, body.w - column - 2 * edge, body.h - edge};
}

void DrawToast(const Rect& room, const std::string& words, UiFrame& ui) {
  const Style& s = ui.style;
  const float pad = s.Px(16), pitch = s.Px(20);
  const std::vector<std::string> lines = WrapText(s.body, words, room.w - 2 * pad);
  float widest = 0;
  for (const std::string& line : lines) {
    widest = std::max(widest, TextWidth(s.body, line));
  }
  const float w = widest + 2 * pad, h = pitch * static_cast<float>(lines.size()) + s.Px(24);
  const Rect toast{room.right() - w, room.bottom() - h, w, h};
  FillRect(Canvas(), toast, s.palette.control, s.Fine(4));
  StrokeRect(Canvas(), toast, s.palette.line, 1, s.Fine(4));
  float y = toast.y + s.Px(12) + pitch / 2;
  for (const std::string& line : lines) {
    DrawText(ui, s.body, s.palette.text1, toast.x + pad, y, line);
    y += pitch;
  }
  ui.items.Add("toast", toast, true, words);
}

}  // namespace palace
