#include "gui/panels/track_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "gui/panels/tracker_words.h"
#include "gui/widgets/button.h"
#include "gui/widgets/map/camera_overlay.h"
#include "gui/widgets/map/site_marks.h"
#include "gui/widgets/number_text.h"
#include "gui/widgets/overlap.h"

namespace palace {
namespace {

constexpr ImU32 kLostInk = Rgb(0x909DAC), kDriftInk = Rgb(0xF5963C);
constexpr int kCirclePoints = 48;
constexpr float kBracket = 10;  // half of its side

/// The trackers, if they are to be drawn.
const TrackerSetStatus* Drawn(const EngineSnapshot& snap) {
  const TrackerSetStatus& set = snap.flight->trackers;
  return !set.members.empty() && AreTrackersOfPicture(snap) ? &set : nullptr;
}

ImU32 InkOf(const TrackerMember& member) {
  return !member.followed() ? kLostInk : member.drifts ? kDriftInk : picture::kWhite;
}

/// On black, so that it is seen on any ground.
void Circle(const Style& s, ImVec2 c, float radius, ImU32 ink, bool dashed) {
  std::vector<ImVec2> points;
  for (int k = 0; k <= kCirclePoints; ++k) {
    const float turn = 2 * std::numbers::pi_v<float> * static_cast<float>(k) / kCirclePoints;
    points.push_back({c.x + radius * std::cos(turn), c.y + radius * std::sin(turn)});
  }
  const ImU32 shade = WithAlpha(picture::kBlack, 0.8f);
  ImDrawList* dl = Canvas();
  if (dashed) {
    DashedPolyline(dl, points, shade, s.Fine(3), s.Px(5), s.Px(4));
    DashedPolyline(dl, points, ink, s.Fine(1.3f), s.Px(5), s.Px(4));
  } else {
    dl->AddPolyline(points.data(), kCirclePoints + 1, shade, 0, s.Fine(3));
    dl->AddPolyline(points.data(), kCirclePoints + 1, ink, 0, s.Fine(1.3f));
  }
}

void DashedSquare(const Style& s, ImVec2 c, float half, ImU32 ink) {
  const Rect square{c.x - half, c.y - half, 2 * half, 2 * half};
  DashedRect(Canvas(), square, WithAlpha(picture::kBlack, 0.8f), s.Fine(4), s.Px(4), s.Px(3));
  DashedRect(Canvas(), square, ink, s.Fine(2), s.Px(4), s.Px(3));
}

void Dot(const Style& s, ImVec2 at, ImU32 ink, bool hollow) {
  ImDrawList* dl = Canvas();
  dl->AddCircleFilled(at, s.Fine(3.5f), picture::kBlack);
  if (hollow) {
    dl->AddCircle(at, s.Fine(2.5f), ink, 0, s.Fine(1.3f));
  } else {
    dl->AddCircleFilled(at, s.Fine(2.5f), ink);
  }
}

void Cross(const Style& s, ImVec2 at, ImU32 ink) {
  const float arm = s.Px(8);
  for (const auto& [colour, width] :
       {std::pair{WithAlpha(picture::kBlack, 0.8f), 4.0f}, std::pair{ink, 2.0f}}) {
    Canvas()->AddLine({at.x - arm, at.y - arm}, {at.x + arm, at.y + arm}, colour, s.Fine(width));
    Canvas()->AddLine({at.x - arm, at.y + arm}, {at.x + arm, at.y - arm}, colour, s.Fine(width));
  }
}

float Sigmas3(double sigma_px, const PictureView& view) {
  return static_cast<float>(3 * sigma_px) * view.ScalePx();
}

/// What no legend may hide.
void NoteMark(const PictureView& view, ImVec2 at, float half, UiFrame& ui) {
  if (view.rect.Contains(at)) {
    ui.items.Add(kTrackMark, {at.x - half, at.y - half, 2 * half, 2 * half}, true, "");
  }
}

void DrawMember(const TrackerMember& member, const TrackerConsensus& consensus,
                const PictureView& view, UiFrame& ui) {
  const Style& s = ui.style;
  const ImU32 ink = InkOf(member);
  if (member.window_side_px > 0 && member.window_centre.allFinite()) {
    DrawSearchWindow(s, Canvas(), view.ScreenFromPixel(member.window_centre),
                     static_cast<float>(member.window_side_px) * view.ScalePx());
  }
  if (member.kind == TrackerMember::Kind::kFeature && member.pixel.allFinite()) {
    const ImVec2 at = view.ScreenFromPixel(member.pixel);
    NoteMark(view, at, s.Px(kBracket), ui);
    if (member.followed()) {
      DrawBrackets(s, Canvas(), at, ink);
    } else {
      DashedSquare(s, at, s.Fine(kBracket), ink);
    }
  }
  if (!member.site_pixel.allFinite()) {
    return;
  }
  const ImVec2 site = view.ScreenFromPixel(member.site_pixel);
  NoteMark(view, site, s.Px(4), ui);
  if (member.drifts && consensus.site_pixel.allFinite()) {
    DashedLine(Canvas(), site, view.ScreenFromPixel(consensus.site_pixel), kDriftInk, s.Fine(2),
               s.Px(6), s.Px(4));
  }
  if (std::isfinite(member.sigma_px)) {
    Circle(s, site, Sigmas3(member.sigma_px, view), ink, !member.followed());
  }
  Dot(s, site, ink, !member.followed());
}

void DrawConsensus(const TrackerConsensus& consensus, const PictureView& view, UiFrame& ui) {
  if (!consensus.site_pixel.allFinite()) {
    return;
  }
  const ImVec2 at = view.ScreenFromPixel(consensus.site_pixel);
  const ImU32 ink = consensus.trusted ? picture::kSafe : kDriftInk;
  if (std::isfinite(consensus.sigma_px)) {
    Circle(ui.style, at, Sigmas3(consensus.sigma_px, view), ink, !consensus.trusted);
  }
  Cross(ui.style, at, ink);
}

struct LegendEntry {
  const char* words;
  void (*draw)(const Style&, ImVec2 at);
};

/// Of what is drawn.
std::vector<LegendEntry> Entries(const TrackerSetStatus& set) {
  const auto any = [&](auto what) {
    return std::any_of(set.members.begin(), set.members.end(), what);
  };
  std::vector<LegendEntry> entries;
  if (set.consensus.site_pixel.allFinite()) {
    entries.push_back(
        set.consensus.trusted
            ? LegendEntry{"Consensus",
                          [](const Style& s, ImVec2 at) { Cross(s, at, picture::kSafe); }}
            : LegendEntry{"Consensus, not trusted",
                          [](const Style& s, ImVec2 at) { Cross(s, at, kDriftInk); }});
  }
  entries.push_back({"Site by each, 3σ", [](const Style& s, ImVec2 at) {
                       Circle(s, at, s.Fine(6.5f), picture::kWhite, false);
                       Dot(s, at, picture::kWhite, false);
                     }});
  if (any([](const TrackerMember& m) { return !m.followed() && m.site_pixel.allFinite(); })) {
    entries.push_back({"LOST, coasted", [](const Style& s, ImVec2 at) {
                         Circle(s, at, s.Fine(6.5f), kLostInk, true);
                         Dot(s, at, kLostInk, true);
                       }});
  }
  if (any([](const TrackerMember& m) { return m.drifts; })) {
    entries.push_back({"Drifts", [](const Style& s, ImVec2 at) {
                         DashedLine(Canvas(), {at.x - s.Px(8), at.y}, {at.x + s.Px(8), at.y},
                                    kDriftInk, s.Fine(2), s.Px(5), s.Px(3));
                       }});
  }
  if (any([](const TrackerMember& m) { return m.kind == TrackerMember::Kind::kFeature; })) {
    entries.push_back({"Feature", [](const Style& s, ImVec2 at) {
                         Style small = s;
                         small.scale = s.scale * 0.7f;
                         DrawBrackets(small, Canvas(), at, picture::kWhite);
                       }});
  }
  if (any([](const TrackerMember& m) { return m.window_side_px > 0; })) {
    entries.push_back({"Search window", [](const Style& s, ImVec2 at) {
                         DrawSearchWindow(s, Canvas(), at, s.Fine(12));
                       }});
  }
  return entries;
}

/// "3 0.91" of "Feature 3".
std::string TagOf(const TrackerMember& member) {
  const std::string number = member.name.substr(member.name.rfind(' ') + 1);
  return number + " " +
         (member.followed() ? Fixed(member.coherence, 2) : std::string(FollowWord(member.state)));
}

bool HidesWords(const ItemRecord& items, const Rect& plate, float around) {
  return std::any_of(items.items().begin(), items.items().end(), [&](const Item& item) {
    const Rect& r = item.rect;
    return item.name == "text" && r.x - around < plate.right() && plate.x < r.right() + around &&
           r.y - around < plate.bottom() && plate.y < r.bottom() + around;
  });
}

bool HidesMarks(const ItemRecord& items, const Rect& plate) {
  return std::any_of(items.items().begin(), items.items().end(), [&](const Item& item) {
    return item.name == kTrackMark && Overlap(item.rect, plate);
  });
}

/// Where a plate of that size hides no words and, if there is such a place, no tracker: above the
/// fact at the lower right, else in another corner; nowhere in a small picture.
std::optional<Rect> FreeCorner(const Rect& image, ImVec2 size, const UiFrame& ui) {
  const Style& s = ui.style;
  const float left = image.x + s.Px(8), right = image.right() - s.Px(8) - size.x;
  for (const bool over_marks : {false, true}) {
    for (const ImVec2& at :
         {ImVec2(right, image.bottom() - s.Px(38) - size.y), ImVec2(right, image.y + s.Px(36)),
          ImVec2(left, image.y + s.Px(8)), ImVec2(left, image.bottom() - s.Px(84) - size.y)}) {
      const Rect plate{at.x, at.y, size.x, size.y};
      if (at.x >= left && at.y >= image.y && !HidesWords(ui.items, plate, s.Px(4)) &&
          (over_marks || !HidesMarks(ui.items, plate))) {
        return plate;
      }
    }
  }
  return std::nullopt;
}

/// The first of the places in the picture that keeps off all words, or, where it is crowded, hides
/// none.
std::optional<Rect> FreePlate(const Rect& image, std::span<const ImVec2> places, ImVec2 size,
                              const UiFrame& ui) {
  for (const float around : {ui.style.Px(6), 0.0f}) {
    for (const ImVec2& place : places) {
      const Rect plate{std::round(place.x), std::round(place.y), size.x, size.y};
      const bool inside = plate.x >= image.x && plate.y >= image.y &&
                          plate.right() <= image.right() && plate.bottom() <= image.bottom();
      if (inside && !HidesWords(ui.items, plate, around)) {
        return plate;
      }
    }
  }
  return std::nullopt;
}

}  // namespace

void OfferTrackView(std::string_view title, const Rect& panel, bool& shown, UiFrame& ui) {
  const Style& s = ui.style;
  const std::string_view words = "Track view";
  ButtonLook look;
  look.font = s.caption;
  look.flat = true;
  look.active = shown;
  look.hint =
      "Every tracker on the picture: where it has the site, its search window, its coherence";
  const Rect rect{panel.x + s.Px(18) + TextWidth(s.medium, title), panel.y + s.Px(3),
                  TextWidth(s.caption, words) + s.Px(12), s.Px(22)};
  if (DrawButton(ui, "track_view", rect, words, look)) {
    shown = !shown;
  }
}

void DrawTrackMarks(const EngineSnapshot& snap, const PictureView& view, UiFrame& ui) {
  const TrackerSetStatus* set = Drawn(snap);
  if (set == nullptr) {
    return;
  }
  Canvas()->PushClipRect(view.rect.min(), view.rect.max(), true);
  for (const TrackerMember& member : set->members) {
    DrawMember(member, set->consensus, view, ui);
  }
  DrawConsensus(set->consensus, view, ui);
  Canvas()->PopClipRect();
}

void DrawTrackLegend(const EngineSnapshot& snap, const Rect& image, UiFrame& ui) {
  const TrackerSetStatus* set = Drawn(snap);
  if (set == nullptr) {
    return;
  }
  const Style& s = ui.style;
  const float swatch = s.Px(24), between = s.Px(12), pitch = s.Px(20);
  const float most = image.w - s.Px(112);  // beside the chip of the depth
  struct Line {
    std::vector<LegendEntry> entries{};
    float width = 0;
  };
  std::vector<Line> lines(1);
  for (const LegendEntry& entry : Entries(*set)) {
    const float width = swatch + TextWidth(s.caption, entry.words) + between;
    if (lines.back().width + width > most && !lines.back().entries.empty()) {
      lines.emplace_back();
    }
    lines.back().entries.push_back(entry);
    lines.back().width += width;
  }
  float widest = 0;
  for (const Line& line : lines) {
    widest = std::max(widest, line.width);
  }
  const ImVec2 size{widest + s.Px(4), pitch * static_cast<float>(lines.size()) + s.Px(6)};
  const std::optional<Rect> free = FreeCorner(image, size, ui);
  if (!free) {
    return;
  }
  const Rect& plate = *free;
  FillRect(Canvas(), plate, picture::kPlate, s.Fine(3));
  ui.items.Add(kTrackLegend, plate, true, "");
  float y = plate.y + s.Px(3) + pitch / 2;
  for (const Line& line : lines) {
    float x = plate.x + s.Px(8);
    for (const LegendEntry& entry : line.entries) {
      entry.draw(s, {x + s.Px(8), y});
      DrawText(ui, s.caption, picture::kPlateText, x + swatch, y, entry.words);
      x += swatch + TextWidth(s.caption, entry.words) + between;
    }
    y += pitch;
  }
}

void DrawCoherences(const EngineSnapshot& snap, const PictureView& view, UiFrame& ui) {
  const TrackerSetStatus* set = Drawn(snap);
  if (set == nullptr) {
    return;
  }
  const Style& s = ui.style;
  const Rect& image = view.rect;
  const float off = s.Px(kBracket + 4), height = s.Px(18);
  for (const TrackerMember& member : set->members) {
    if (member.kind != TrackerMember::Kind::kFeature || !member.pixel.allFinite()) {
      continue;
    }
    const ImVec2 at = view.ScreenFromPixel(member.pixel);
    const std::string words = TagOf(member);
    const float width = TextWidth(s.caption, words) + s.Px(8);
    const ImVec2 places[] = {{at.x + off, at.y - height / 2},
                             {at.x - off - width, at.y - height / 2},
                             {at.x - width / 2, at.y + off},
                             {at.x - width / 2, at.y - off - height}};
    if (const auto plate = FreePlate(image, places, {width, height}, ui)) {
      FillRect(Canvas(), *plate, picture::kPlate, s.Fine(3));
      DrawText(ui, s.caption, picture::kPlateText, plate->centre().x, plate->centre().y, words,
               Align::kCentre);
    }
  }
}

std::string TrackFact(const EngineSnapshot& snap, float width, const Style& style) {
  const TrackerSetStatus& set = snap.flight->trackers;
  if (set.members.empty()) {
    return FitClauses(style.caption, WhyNoTrackers(snap), width);
  }
  if (!AreTrackersOfPicture(snap)) {
    return "Track of " + AgeText(std::max(0.0, SecondsBetween(set.time, snap.time))) +
           " ago: not drawn";
  }
  std::string words;
  for (const TrackerMember& member : set.members) {
    if (member.in_force) {
      words = member.name + " " +
              (member.followed() ? Fixed(member.coherence, 2) + " in force"
                                 : TrackerStateWords(member)) +
              "; ";
    }
  }
  return FitClauses(style.caption, words + ConsensusWords(set), width);
}

}  // namespace palace
