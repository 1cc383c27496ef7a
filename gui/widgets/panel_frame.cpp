#include "gui/widgets/panel_frame.h"

#include <vector>

#include "gui/widgets/icons.h"

namespace palace {

void DrawPanelBackground(UiFrame& ui, const Rect& rect, std::string_view name) {
  const Style& s = ui.style;
  ImDrawList* dl = Canvas();
  FillRect(dl, rect, s.palette.panel, s.Fine(4));
  if (s.palette.outlined_panels) {
    StrokeRect(dl, rect, s.palette.line, s.Fine(1), s.Fine(4));
  }
  ui.items.Add("panel/" + std::string(name), rect, true, name);
}

Rect DrawPanelFrame(UiFrame& ui, const Rect& rect, std::string_view title,
                    std::initializer_list<PanelFact> facts) {
  const Style& s = ui.style;
  DrawPanelBackground(ui, rect, title);
  const float header = s.Px(28);
  const float middle = rect.y + header / 2;
  const float pad = s.Px(12);
  const float title_end =
      rect.x + pad + DrawText(ui, s.medium, s.palette.text1, rect.x + pad, middle, title);
  float right = rect.right() - pad;
  std::vector<PanelFact> list(facts);
  const auto width_of = [&](const PanelFact& fact) {
    return fact.text.empty() ? 0.0f
                             : TextWidth(fact.strong ? s.medium : s.caption, fact.text) +
                                   (fact.caution ? s.Px(18) : 0.0f) + s.Px(12);
  };
  float wanted = 0;
  for (const PanelFact& fact : list) {
    wanted += width_of(fact);
  }
  while (!list.empty() && right - wanted + s.Px(4) < title_end) {
    wanted -= width_of(list.back());
    list.pop_back();
  }
  for (std::size_t i = list.size(); i-- > 0;) {
    const PanelFact& fact = list[i];
    if (fact.text.empty()) {
      continue;
    }
    ImFont* font = fact.strong ? s.medium : s.caption;
    const float icon = fact.caution ? s.Px(18) : 0.0f;
    const float width = TextWidth(font, fact.text);
    DrawText(ui, font, fact.colour != 0 ? fact.colour : s.palette.text2, right, middle, fact.text,
             Align::kRight);
    if (fact.caution) {
      DrawIcon(Canvas(), Icon::kCaution, {right - width - s.Px(10), middle}, s.Px(12),
               s.palette.caution);
    }
    right -= width + icon + s.Px(12);
  }
  return {rect.x, rect.y + header, rect.w, rect.h - header};
}

}  // namespace palace
