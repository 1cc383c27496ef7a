// Where the panels of Review lie, as a pure function of the body's size.
#pragma once

#include "gui/widgets/style.h"
#include "gui/widgets/ui_frame.h"

namespace palace {

enum class ReviewPicture { kRightCamera, kView3d };

struct ReviewLayout {
  bool narrow = false;
  Rect left_camera;
  Rect right_camera, view_3d;  ///< narrow: the one chosen; the other is empty
  Rect picture_tabs;           ///< narrow only
  Rect maps;                   ///< row of three
  float map_side = 0;
  Rect plots, redecide, decision, differences, timeline;  ///< differences: empty when narrow
};

ReviewLayout LayReview(const Rect& body, const Style& style, ReviewPicture picture);

}  // namespace palace
