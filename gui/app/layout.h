// Layout: all rectangles of the window from its size, as pure functions (reference: the look of the
// station, section 2). Unit is one pixel at 100 %; edges are rounded to whole pixels.
#pragma once

#include "gui/panels/fly_layout.h"

namespace palace {

/// The wanted scale, or the next smaller step at which 1280 x 720 units fit the window.
double FittingScale(double width_px, double height_px, double wanted);

FrameLayout ComputeFrameLayout(double width_px, double height_px, double scale);

/// `descent`: the mission is descending, holding or landed. The left and right halves keep their
/// places, only the map row and the right column change their panels.
FlyLayout ComputeFlyLayout(double width_px, double height_px, double scale, bool descent);

}  // namespace palace
