// What did not get through, and what that means. Only what was lost is listed.
#include <algorithm>

#include "gui/panels/diagnose/diagnose.h"
#include "gui/widgets/number_text.h"

namespace palace {
namespace {

struct LossRow {
  const char* name;
  std::uint64_t count;
  std::string meaning;
};

std::string WordsOf(const std::map<std::string, std::uint64_t>& counts) {
  std::string text;
  for (const auto& [name, count] : counts) {
    text += (text.empty() ? "" : ", ") + name + " " + std::to_string(count);
  }
  return text;
}

std::vector<LossRow> RowsOf(const Losses& losses) {
  std::vector<LossRow> rows = {
      {"Pairs overtaken", losses.pairs_replaced,
       "Came; newer ones came before they were looked at"},
      {"Pictures unpaired", losses.pictures_unpaired, "The other camera gave none of that time"},
      {"Pairs without rig", losses.pairs_without_rig, "Came before the cameras were described"},
      {"Bundles missing", losses.bundles_missing, "Gaps in the sender's numbers: lost on the way"},
      {"Samples missing", losses.samples_missing, "Announced by the sender, lost on the way"},
      {"Samples overflowed", losses.samples_overflowed, "Too many waited; the oldest went"},
      {"Datagrams refused", losses.datagrams_refused,
       "Refused: " + WordsOf(losses.bus.refused_why)},
      {"Datagrams overrun", losses.bus.overrun,
       "This machine had no room: raise net.core.rmem_max"},
      {"Undecodable", losses.undecodable_messages(), "Refused: " + WordsOf(losses.undecodable)},
      {"Messages unsent", losses.messages_unsent, "The bus did not take them: check the link"},
      {"Frames not recorded", losses.records_dropped, "The disk was too slow; samples are kept"}};
  std::erase_if(rows, [](const LossRow& row) { return row.count == 0; });
  return rows;
}

constexpr float kHead = 40, kOneLine = 20, kTwoLines = 42;

}  // namespace

float LossesHeight(const EngineSnapshot& snap, const Style& s, float most) {
  const auto rows =
      static_cast<float>(std::max<std::size_t>(RowsOf(snap.session->losses).size(), 1));
  return std::max(s.Px(kHead + kOneLine * rows), std::min(s.Px(kHead + kTwoLines * rows), most));
}

void DrawLosses(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const std::vector<LossRow> rows = RowsOf(snap.session->losses);
  const Rect content = DrawPanelFrame(ui, rect, "Losses", {{"since the start", 0, false, false}});
  const float left = content.x + s.Px(12), right = content.right() - s.Px(12);
  float y = content.y + s.Px(12);
  if (rows.empty()) {
    DrawText(ui, s.body, p.text2, left, y, "Nothing was lost.");
    return;
  }
  const float room = rect.bottom() - content.y;
  const bool meanings = room >= s.Px(kTwoLines) * static_cast<float>(rows.size());
  for (const LossRow& row : rows) {
    const std::string count = Fixed(static_cast<double>(row.count), 0);
    DrawText(ui, s.body, p.text1, left, y, row.name);
    DrawText(ui, s.medium, p.text1, right, y, count, Align::kRight);
    ui.items.Add(std::string("loss/") + row.name,
                 {content.x, y - s.Px(10), content.w, s.Px(meanings ? 40 : 20)}, true,
                 count + ": " + row.meaning);
    if (meanings) {
      DrawText(ui, s.caption, p.text2, left, y + s.Px(18),
               FitWords(s.caption, row.meaning, right - left));
    }
    y += s.Px(meanings ? kTwoLines : kOneLine);
  }
}

}  // namespace palace
