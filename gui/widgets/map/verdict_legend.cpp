#include "gui/widgets/map/verdict_legend.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "engine/model/ground_class.h"
#include "gui/widgets/draw.h"
#include "gui/widgets/map/camera_overlay.h"
#include "gui/widgets/map/flag_marks.h"
#include "gui/widgets/overlap.h"

namespace palace {
namespace {

constexpr float kSwatch = 14;  // units
constexpr float kEdge = 8;     // units, to the picture's edge
constexpr float kApart = 4;    // units, between the two plates

/// In which corner a plate stands; above what stands in the lower ones: scale bar and "Depth" at
/// the left, a fact at the right.
std::vector<Rect> InCorners(const Style& s, const Rect& image, ImVec2 size) {
  const float left = image.x + s.Px(kEdge), right = image.right() - s.Px(kEdge) - size.x;
  return {{left, image.y + s.Px(kEdge), size.x, size.y},
          {left, image.bottom() - s.Px(84) - size.y, size.x, size.y},
          {right, image.bottom() - s.Px(42) - size.y, size.x, size.y},
          {right, image.y + s.Px(kEdge + 28), size.x, size.y}};
}

enum class Hidden { kLetters, kLettersAndRings };

bool Hides(const UiFrame& ui, const Rect& plate, Hidden none_of) {
  return std::any_of(ui.items.items().begin(), ui.items.items().end(), [&](const Item& item) {
    const bool ring = item.name == kSiteRing || item.name == kLandingRing;
    const bool stays = item.name == kSiteMark || item.name == kTrackMark ||
                       item.name == kTrackLegend ||
                       item.name == kVerdictLegend || (ring && none_of == Hidden::kLettersAndRings);
    return stays && Overlap(item.rect, plate);
  });
}

/// Of each way to draw a plate the spots that it may stand in, the best first.
using Spots = std::vector<std::vector<Rect>>;

/// Where it stood last, else the first that fits, and hides no letter and no ring; else, for near
/// the ground a ring fills the picture, the same that hides no letter. A legend that moved with
/// every letter that passes could not be read.
std::optional<Rect> FindSpot(const UiFrame& ui, const Rect& image, const Spots& spots,
                             PlatePlace& place) {
  const auto at = [&](const PlatePlace& p) { return spots[p.way][p.spot]; };
  for (const Hidden none_of : {Hidden::kLettersAndRings, Hidden::kLetters}) {
    const auto free = [&](const PlatePlace& p) {
      const Rect plate = at(p);
      return plate.w + 2 * ui.style.Px(kEdge) <= image.w && plate.y >= image.y &&
             plate.bottom() <= image.bottom() && !Hides(ui, plate, none_of);
    };
    if (place.ways == spots.size() && free(place)) {
      return at(place);
    }
    for (std::size_t way = 0; way < spots.size(); ++way) {
      for (std::size_t spot = 0; spot < spots[way].size(); ++spot) {
        const PlatePlace there{spots.size(), way, spot};
        if (free(there)) {
          place = there;
          return at(there);
        }
      }
    }
  }
  place = {};
  return std::nullopt;
}

struct LegendEntry {
  const char* words;
  void (*draw)(const Style&, const Rect& swatch);
};

void SafeSwatch(const Style& s, const Rect& swatch) {
  StrokeRect(Canvas(), swatch, picture::kSafe, s.Fine(2));
}

void OverSwatch(const Style& s, const Rect& swatch) {
  FillRect(Canvas(), swatch, WithAlpha(Rgb(0xF5963C), 0.25f));
  Hatch(Canvas(), swatch, Rgb(0xF5963C), s.Fine(2), s.Fine(6));
}

void NoPlaceSwatch(const Style& s, const Rect& swatch) {
  StrokeRect(Canvas(), swatch, picture::kNoPlaceLine, s.Fine(1));
  Hatch(Canvas(), swatch, Rgb(0xF5963C), s.Fine(1), s.Fine(12));
}

constexpr std::array<LegendEntry, 3> kBrief = {
    {{"Safe", SafeSwatch}, {"Unsafe", OverSwatch}, {"No room", NoPlaceSwatch}}};

float EntryWidth(const Style& s, const LegendEntry& entry) {
  return s.Px(kSwatch + 6) + TextWidth(s.caption, entry.words);
}

/// Entries beside or below each other.
struct LegendLayout {
  std::span<const LegendEntry> entries;
  bool in_row = true;
};

ImVec2 SizeOf(const Style& s, const LegendLayout& layout) {
  float sum = s.Px(8), widest = 0;
  for (const LegendEntry& entry : layout.entries) {
    const float width = EntryWidth(s, entry);
    sum += width + s.Px(14);
    widest = std::max(widest, width);
  }
  return layout.in_row ? ImVec2(sum, s.Px(26)) : ImVec2(widest + s.Px(20), s.Px(66));
}

/// Returns the plate; nothing where none is drawn.
std::optional<Rect> DrawVerdictPlate(UiFrame& ui, const Rect& image, PlatePlace& place) {
  const Style& s = ui.style;
  const std::array<LegendEntry, 3> full = {
      {{GroundClassWord(GroundClass::kLandable), SafeSwatch},
       {"Over a limit or unknown", OverSwatch},
       {"No place for a lander", NoPlaceSwatch}}};
  const bool in_row = SizeOf(s, {full}).x + 2 * s.Px(kEdge) <= image.w;
  const LegendLayout layouts[] = {{full, in_row}, {kBrief}};
  Spots spots;
  for (const LegendLayout& layout : layouts) {
    spots.push_back(InCorners(s, image, SizeOf(s, layout)));
  }
  const auto plate = FindSpot(ui, image, spots, place);
  if (!plate) {
    return plate;
  }
  const LegendLayout& layout = layouts[place.way];
  FillRect(Canvas(), *plate, picture::kPlate, s.Fine(3));
  ui.items.Add(kVerdictLegend, *plate, true, "");
  ImVec2 at{plate->x + s.Px(8), plate->y + s.Px(13)};
  for (const LegendEntry& entry : layout.entries) {
    const float side = s.Px(kSwatch);
    entry.draw(s, {at.x, at.y - side / 2, side, side});
    DrawText(ui, s.caption, picture::kPlateText, at.x + side + s.Px(6), at.y, entry.words);
    at = layout.in_row ? ImVec2{at.x + EntryWidth(s, entry) + s.Px(14), at.y}
                       : ImVec2{at.x, at.y + s.Px(20)};
  }
  return plate;
}

void DrawFlagPlate(UiFrame& ui, const Rect& image, const std::optional<Rect>& verdict,
                   unsigned flags, PlatePlace& place) {
  const Style& s = ui.style;
  Spots spots;
  const bool trackers_shown = ui.items.Find(kTrackLegend) != nullptr;
  for (const bool in_row : {true, false}) {
    if (!in_row && trackers_shown) {
      break;  // a column would lie over the features that are looked at
    }
    const ImVec2 size = FlagLegendSize(s, flags, in_row);
    spots.emplace_back();
    if (verdict) {
      const bool below = verdict->centre().y < image.centre().y;
      const float x = verdict->centre().x < image.centre().x || verdict->w > image.w / 2
                          ? verdict->x
                          : verdict->right() - size.x;
      spots.back().push_back(
          {x, below ? verdict->bottom() + s.Px(kApart) : verdict->y - s.Px(kApart) - size.y, size.x,
           size.y});
    }
    for (const Rect& corner : InCorners(s, image, size)) {
      spots.back().push_back(corner);
    }
  }
  if (const auto plate = FindSpot(ui, image, spots, place)) {
    FillRect(Canvas(), *plate, picture::kPlate, s.Fine(3));
    ui.items.Add(kFlagLegend, *plate, true, "");
    DrawFlagLegend(ui, plate->min(), flags, place.way == 0);
  }
}

}  // namespace

void DrawVerdictLegend(UiFrame& ui, const Rect& image, unsigned flags, LegendPlace& place) {
  const auto verdict = DrawVerdictPlate(ui, image, place.verdict);
  if (flags != 0) {
    DrawFlagPlate(ui, image, verdict, flags, place.flags);
  }
}

}  // namespace palace
