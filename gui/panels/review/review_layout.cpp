#include "gui/panels/review/review_layout.h"

#include <algorithm>
#include <cmath>

#include "gui/panels/fly_layout.h"

namespace palace {
namespace {

void LayWide(const Rect& area, const Style& s, ReviewLayout& layout) {
  const float gap = s.Px(8);
  const float row1 = std::round(area.h * 0.6f), row2 = area.h - row1 - gap;
  const float camera_w =
      std::min(std::floor((row1 - s.Px(28)) * 4 / 3), std::floor(area.w * 0.36f));
  layout.left_camera = {area.x, area.y, camera_w, row1};
  layout.right_camera = {area.x + camera_w + gap, area.y, camera_w, row1};
  const float view_x = area.x + 2 * (camera_w + gap);
  layout.view_3d = {view_x, area.y, area.right() - view_x, row1};
  layout.map_side = row2 - s.Px(32);
  layout.maps = {area.x, area.y + row1 + gap, area.w, row2};
  const float plots_x = layout.maps.x + 3 * (layout.map_side + gap);
  layout.plots = {plots_x, layout.maps.y, area.right() - plots_x, row2};
}

void LayNarrow(const Rect& area, const Style& s, ReviewPicture picture, ReviewLayout& layout) {
  const float gap = s.Px(8);
  const float row1 = std::round(area.h * 0.56f), row2 = area.h - row1 - gap;
  const float camera_w = std::floor((row1 - s.Px(28)) * 4 / 3);
  layout.left_camera = {area.x, area.y, camera_w, row1};
  const float x = area.x + camera_w + gap;
  layout.plots = {x, area.y, area.right() - x, row1};
  layout.map_side = row2 - s.Px(32);
  layout.maps = {area.x, area.y + row1 + gap, area.w, row2};
  const float tabs_x = layout.maps.x + 3 * (layout.map_side + gap);
  const Rect tabs{tabs_x, layout.maps.y, area.right() - tabs_x, s.Px(32)};
  layout.picture_tabs = tabs;
  const float y = tabs.bottom() + s.Px(4);
  const Rect shown{tabs.x, y, tabs.w, layout.maps.bottom() - y};
  (picture == ReviewPicture::kView3d ? layout.view_3d : layout.right_camera) = shown;
}

}  // namespace

ReviewLayout LayReview(const Rect& body, const Style& s, ReviewPicture picture) {
  ReviewLayout layout;
  layout.narrow = IsNarrowBody(body, s);
  const bool narrow = layout.narrow;
  const float gap = s.Px(8);
  // Two lanes in a narrow window; a third, of alarms and marks, where it is not low too.
  const float timeline_h = s.Px(!narrow               ? 260
                                : body.h >= s.Px(660) ? 188
                                                      : 164),
              right_w = s.Px(narrow ? 344 : 416);
  layout.timeline = {body.x, body.bottom() - timeline_h, body.w, timeline_h};
  const Rect upper{body.x, body.y, body.w - right_w - gap, body.h - timeline_h - gap};
  if (narrow) {
    LayNarrow(upper, s, picture, layout);
  } else {
    LayWide(upper, s, layout);
  }
  const float right_x = body.right() - right_w;
  const float redecide_h = s.Px(narrow ? 198 : 228);
  layout.redecide = {right_x, body.y, right_w, redecide_h};
  const float decision_y = body.y + redecide_h + gap;
  const float rest = upper.bottom() - decision_y;
  const bool list = rest >= s.Px(264 + 100);
  const float decision_h = list ? s.Px(264) : rest;
  layout.decision = {right_x, decision_y, right_w, decision_h};
  if (list) {
    const float y = decision_y + decision_h + gap;
    layout.differences = {right_x, y, right_w, upper.bottom() - y};
  }
  return layout;
}

}  // namespace palace
