#include "gui/panels/search_map_legend.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "gui/panels/course_rose.h"
#include "gui/panels/search_map_marks.h"
#include "gui/widgets/draw.h"
#include "gui/widgets/interact.h"
#include "gui/widgets/number_text.h"

namespace palace {
namespace {

constexpr float kSwatch = 14, kRow = 18, kApart = 12, kPad = 6;

struct Entry {
  std::string words;
  void (*draw)(const Style& style, const Rect& swatch);
};

void LookedAt(const Style&, const Rect& r) { FillRect(Canvas(), r, kLookedAt); }
void InView(const Style& s, const Rect& r) {
  DashedRect(Canvas(), r, s.palette.text3, s.Fine(1), s.Px(4), s.Px(3));
}
void NextView(const Style& s, const Rect& r) {
  DashedRect(Canvas(), r, picture::kWhite, s.Fine(1), s.Px(4), s.Px(3));
}
void Area(const Style& s, const Rect& r) { StrokeRect(Canvas(), r, picture::kWhite, s.Fine(1.5F)); }
void Circle(const Style& s, const Rect& r) {
  constexpr int kCorners = 24;
  std::vector<ImVec2> points;
  for (int k = 0; k <= kCorners; ++k) {
    const float turn = 2 * std::numbers::pi_v<float> * static_cast<float>(k) / kCorners;
    points.push_back(
        {r.centre().x + r.w / 2 * std::cos(turn), r.centre().y + r.w / 2 * std::sin(turn)});
  }
  DashedPolyline(Canvas(), points, s.palette.text3, s.Fine(1), s.Px(4), s.Px(3));
}
void Suits(const Style& s, const Rect& r) {
  const float y = r.centre().y;
  Canvas()->AddLine({r.x, y}, {r.right(), y}, picture::kSafe, s.Fine(4));
}
void Vetoed(const Style& s, const Rect& r) {
  const float y = r.centre().y;
  DashedLine(Canvas(), {r.x, y}, {r.right(), y}, picture::kUnsafeLine, s.Fine(2), s.Px(3), s.Px(3));
}
void Planned(const Style& s, const Rect& r) {
  const float y = r.centre().y;
  Canvas()->AddLine({r.x, y}, {r.right(), y}, picture::kWhite, s.Fine(3));
}

std::vector<Entry> EntriesOf(const EngineSnapshot& snap) {
  const MissionStatus& m = snap.flight->mission;
  std::vector<Entry> entries;
  const bool sees = m.seen && snap.sensors->pose && snap.sensors->rig;
  if (m.seen && SeenArea_m2(*m.seen) > 0) {
    entries.push_back({"Looked at", LookedAt});
  }
  if (sees) {
    entries.push_back({"In view", InView});
  }
  if (sees && (m.going || m.next_look)) {
    entries.push_back({m.going ? "Where it flies" : "Next look", NextView});
  }
  if (m.area) {
    entries.push_back({"Area", Area});
  } else if (m.seen) {
    entries.push_back({"Next looks keep to " + Fixed(SeenGround::kSearched_m, 0) + " m", Circle});
  }
  if (HasCourses(m)) {
    entries.push_back({"Course suits (ring: fully)", Suits});
    entries.push_back({"Blocked or downwind", Vetoed});
    entries.push_back({"Planned course", Planned});
  }
  return entries;
}

}  // namespace

float DrawSearchLegend(const EngineSnapshot& snap, const Rect& map, float bottom, UiFrame& ui) {
  const Style& s = ui.style;
  const std::vector<Entry> entries = EntriesOf(snap);
  if (entries.empty()) {
    return bottom;
  }
  const float left = map.x + s.Px(8), room = map.w - s.Px(16) - 2 * s.Px(kPad);
  const auto width = [&](const Entry& entry) {
    return s.Px(kSwatch + 6) + TextWidth(s.caption, entry.words);
  };
  std::vector<ImVec2> at;  // from the plate's corner
  float x = 0, widest = 0;
  int row = 0;
  for (const Entry& entry : entries) {
    if (x > 0 && x + width(entry) > room) {
      x = 0;
      ++row;
    }
    at.push_back({s.Px(kPad) + x, s.Px(4) + (static_cast<float>(row) + 0.5F) * s.Px(kRow)});
    x += width(entry) + s.Px(kApart);
    widest = std::max(widest, x - s.Px(kApart));
  }
  const float height = static_cast<float>(row + 1) * s.Px(kRow) + s.Px(8);
  const Rect plate{left, bottom - height, widest + 2 * s.Px(kPad), height};
  FillRect(Canvas(), plate, picture::kPlate, s.Fine(3));
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const float side = s.Px(kSwatch), px = plate.x + at[i].x, py = plate.y + at[i].y;
    entries[i].draw(s, {px, py - side / 2, side, side});
    DrawText(ui, s.caption, picture::kPlateText, px + side + s.Px(6), py, entries[i].words);
  }
  Interact(ui, "search_legend", plate, kNoTab);  // a click on it picks no place
  return plate.y;
}

}  // namespace palace
