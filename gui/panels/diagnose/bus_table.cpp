// What came over the bus: by channel, and by sender with its address.
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "gui/panels/diagnose/diagnose.h"
#include "gui/widgets/number_text.h"

namespace palace {
namespace {

constexpr std::array kHeads = {"Received", "Lost", "Twice", "Late", "Refused"};

struct BusRow {
  std::string name;
  bool strange = false;  ///< something to look at
  std::array<std::uint64_t, kHeads.size()> counts{};
};

/// Senders first: who they are is what a person must find out.
std::vector<BusRow> RowsOf(const BusTraffic& bus) {
  constexpr std::size_t kMostSenders = 4;
  std::vector<BusRow> rows;
  for (const SenderTraffic& s : bus.senders) {
    // Who sends nothing of ours and nothing wrong is no news: other stations, this one.
    if (rows.size() < kMostSenders && (s.used || s.received > 0 || s.refused > 0)) {
      rows.push_back({(s.used ? "From " : "Stranger ") + s.address,
                      !s.used,
                      {s.received, s.lost, s.duplicated, s.reordered, s.refused}});
    }
  }
  for (const ChannelTraffic& c : bus.channels) {
    rows.push_back({c.channel,
                    c.refused > 0 || !c.second_sender.empty(),
                    {c.received, c.lost, c.duplicated, c.reordered, c.refused}});
  }
  return rows;
}

}  // namespace

float BusTableHeight(const EngineSnapshot& snap, const Style& s, float most) {
  const auto rows = static_cast<float>(RowsOf(snap.session->losses.bus).size());
  return std::min(s.Px(62 + 22 * rows), most);
}

void DrawBusTable(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const Rect content = DrawPanelFrame(ui, rect, "Bus", {{"since the start", 0, false, false}});
  const std::vector<BusRow> rows = RowsOf(snap.session->losses.bus);
  const float left = content.x + s.Px(140);
  const float step = (content.right() - s.Px(12) - left) / static_cast<float>(kHeads.size());
  const auto column = [&](std::size_t i) { return left + step * static_cast<float>(i + 1); };
  float y = content.y + s.Px(12);
  DrawText(ui, s.caption, p.text2, content.x + s.Px(12), y, "Sender, channel");
  for (std::size_t i = 0; i < kHeads.size(); ++i) {
    DrawText(ui, s.caption, p.text2, column(i), y, kHeads[i], Align::kRight);
  }
  y += s.Px(22);
  const float pitch = RowPitch(s, rect.bottom() - s.Px(6) - y + s.Px(13), rows.size());
  for (const BusRow& row : rows) {
    if (y + s.Px(10) > rect.bottom()) {
      break;
    }
    DrawText(ui, row.strange ? s.medium : s.body, row.strange ? p.caution : p.text2,
             content.x + s.Px(12), y, FitWords(s.body, row.name, s.Px(126)));
    std::string told = row.name;
    for (std::size_t i = 0; i < kHeads.size(); ++i) {
      const std::string count = Fixed(static_cast<double>(row.counts[i]), 0);
      DrawText(ui, s.body, p.text1, column(i), y, count, Align::kRight);
      told += (i == 0 ? ": " : ", ") + std::string(kHeads[i]) + " " + count;
    }
    ui.items.Add("bus/" + row.name, {content.x, y - s.Px(10), content.w, s.Px(20)}, true, told);
    y += pitch;
  }
}

}  // namespace palace
