#include "gui/widgets/button.h"

#include <algorithm>

namespace palace {

bool DrawButton(UiFrame& ui, std::string_view name, const Rect& rect, std::string_view label,
                const ButtonLook& look) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const bool enabled = look.enabled && ui.withheld.empty();
  const Interaction in = Interact(ui, name, rect, enabled ? 0U : unsigned{kDisabled}, label);
  if (look.unseen && !in.hovered && !in.focused) {
    return in.clicked;
  }
  const bool pressed = (in.held && in.hovered) || in.key_held;
  ImU32 fill = look.flat ? 0 : p.control;
  ImU32 border = p.strong_line;
  ImU32 text = p.text1;
  if (!enabled) {
    border = p.line;
    text = p.text3;
  } else if (look.active) {
    fill = p.white_mark;
    text = p.on_white;
  } else if (pressed) {
    fill = p.window;
    border = p.text2;
  } else if (in.hovered) {
    fill = p.hover;
  }
  ImDrawList* dl = Canvas();
  FillRect(dl, rect, fill, s.Fine(4));
  StrokeRect(dl, rect, border, s.Fine(1), s.Fine(4));
  ImFont* font = look.font != nullptr ? look.font : s.body;
  const float middle = rect.centre().y;
  if (look.sub.empty()) {
    DrawText(ui, font, text, rect.centre().x, middle, label, Align::kCentre);
  } else {
    DrawText(ui, font, text, rect.centre().x, middle - s.Px(9), label, Align::kCentre);
    DrawText(ui, s.caption, enabled ? p.text2 : p.text3, rect.centre().x, middle + s.Px(11),
             FitClauses(s.caption, look.sub, rect.w - s.Px(6)), Align::kCentre);
  }
  const std::string_view told = enabled ? look.hint : !look.enabled ? look.reason : ui.withheld;
  if (in.hovered && !told.empty()) {
    DrawTooltip(ui, told, &rect);
  }
  return in.clicked;
}

void DrawTooltip(UiFrame& ui, std::string_view text, const Rect* of) {
  const Style& s = ui.style;
  std::vector<std::string> lines;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t to = std::min(text.size(), text.find('\n', from));
    const std::vector<std::string> wrapped =
        WrapText(s.body, text.substr(from, to - from), s.Px(244));
    lines.insert(lines.end(), wrapped.begin(), wrapped.end());
    from = to + 1;
  }
  float width = 0;
  for (const std::string& line : lines) {
    width = std::max(width, TextWidth(s.body, line));
  }
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const float below = of != nullptr ? of->bottom() + s.Px(6) : mouse.y + s.Px(16);
  const float above = of != nullptr ? of->y - s.Px(6) : mouse.y - s.Px(8);
  Rect r{mouse.x + s.Px(12), below, width + s.Px(24),
         s.Px(20) * static_cast<float>(lines.size()) + s.Px(16)};
  r.x = std::min(r.x, screen.x - r.w - s.Px(4));
  if (r.bottom() > screen.y - s.Px(4)) {
    r.y = above - r.h;
  }
  const Rect& keep = ui.wave_off_rect;
  if (r.x < keep.right() && r.right() > keep.x && r.y < keep.bottom() && r.bottom() > keep.y) {
    r.y = keep.bottom() + s.Px(8);
  }
  ImDrawList* dl = ImGui::GetForegroundDrawList();
  FillRect(dl, r, s.palette.control, s.Fine(4));
  StrokeRect(dl, r, s.palette.strong_line, s.Fine(1), s.Fine(4));
  float y = r.y + s.Px(8);
  for (const std::string& line : lines) {
    dl->AddText(s.body, s.body->FontSize, {r.x + s.Px(12), y}, s.palette.text1, line.c_str());
    y += s.Px(20);
  }
  ui.items.Add("tooltip", r, true, text);
}

}  // namespace palace
