#include "engine/experiments/thesis_figures.h"

namespace palace {
namespace {

constexpr ThesisFigure kFigures[] = {
    {"Figure 3.1", "One feature through a descent",
     "Consecutive pictures of a descent with the tracked feature; on recorded flights of an RMAX "
     "from 150 ft the features were followed in real time. No error is told.",
     "trackers", "",
     "Rendered descents with known points; the template that is refreshed with every picture, as "
     "in the thesis, beside ours and OpenCV's."},
    {"Figure 3.7", "Position from one camera on the way to a cone",
     "Simulated, from a hover at 50 ft: the estimate never deviates by more than 0.25 m from the "
     "vehicle's position. In flight the focal length was wrong and the positions did not match.",
     "position-estimate", "",
     "The seven steps with their errata corrected, beside a resection of many points; with perfect "
     "attitude and with 0.3 degrees of noise and bias."},
    {"Section 3.3", "Tracking while the camera is moved by hand",
     "A web camera at 30 pictures a second followed its features.", "", "",
     "By hand: palacectl track VIDEO or a camera's number."},
    {"Figure 4.1", "Calibration of the pair",
     "Targets before both cameras; Tsai's model, then CAHVOR from it. No residual is told.",
     "calibration", "", "One bundle adjustment over all views and both cameras; rendered targets."},
    {"Figure 4.2", "Range map over the left picture",
     "From a flight of the RMAX; its accuracy could not be told there.", "", "4.2", ""},
    {"Figures 4.3 and 4.4", "The obstacle field",
     "Boxes, cylinders and wedges, textured with a city from above: objects of 6 in and higher "
     "are discerned from 50 ft, and slopes to within 5 degrees.",
     "stereo-accuracy", "4.3", "Exact depths of every pixel are known; OpenCV's matchers beside."},
    {"Figure 4.5", "The cluttered landing area", "Tables and cones on a runway, a part left void.",
     "", "4.5", ""},
    {"Figure 4.6", "Elevation map", "100 x 100 cells, from above.", "", "4.6", ""},
    {"Figure 4.7", "Slope and roughness", "By a plane through 3 x 3 cells.", "", "4.7", ""},
    {"Figure 4.8", "Cost, safe distance and the site",
     "The place farthest from every hazard that keeps the limits of slope.", "", "4.8", ""},
    {"Figure 4.9", "The site in the picture", "Where it lies in the left camera's picture.", "",
     "4.9", ""},
    {"Section 4.3", "The same site from all sides",
     "Repeated tests chose the same site, whatever angle and position it was viewed from.",
     "site-views", "", ""},
    {"Table 4.5", "The right site among random cones, by altitude",
     "Of 50 tries each: 30 ft 85 %, 40 ft 89 %, 50 ft 100 %, 60 ft 98 %, 70 ft 65 %; at 10 and 20 "
     "ft not applicable.",
     "site-range", "", "Cones of 28 in; thesis mode beside modern mode on the same pairs."},
    {"Section 4.3", "Single shapes from 50 ft",
     "Hazards were identified; boxes wider than the vehicle with a flat top were chosen to land "
     "on.",
     "site-shapes", "", ""},
    {"Figures 5.1 and 5.2", "Velocity from vision, unstable and improved",
     "A filter that expected 10 fixes a second got up to 30, with high gains: the vehicle crashed "
     "at once. In time and with low gains the velocity was smooth; with too high an integral gain "
     "in the control loop it still crashed.",
     "velocity-estimate", "", ""},
    {"Figure 5.3", "Whole missions to the ground",
     "The vehicle landed at the point that was chosen; one flight is shown.", "landing", "",
     "Many seeds, with the touchdown's distance from the approved point and its interval."},
};

}  // namespace

std::span<const ThesisFigure> ThesisFigures() { return kFigures; }

}  // namespace palace
