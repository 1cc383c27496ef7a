#include "gui/panels/course_rose.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "engine/core/units.h"
#include "engine/model/wind.h"
#include "gui/widgets/draw.h"
#include "gui/widgets/number_text.h"

namespace palace {
namespace {

constexpr float kInner = 18, kLeast = 64, kMost = 132;              // units of the design grid
constexpr double kHalf_rad = Rad(0.4 * 360.0 / kApproachHeadings);  // of a ray; gaps between

/// Of a course: on the side that it comes from.
ImVec2 At(ImVec2 centre, double heading_rad, float radius) {
  return {centre.x - radius * static_cast<float>(std::sin(heading_rad)),
          centre.y + radius * static_cast<float>(std::cos(heading_rad))};
}

/// As large as the map has room for round it, within limits.
float RoseRadius(ImVec2 centre, const Rect& map, const Style& s) {
  const float room = std::min(
      {centre.x - map.x, map.right() - centre.x, centre.y - map.y, map.bottom() - centre.y});
  return std::clamp(room - s.Px(16), s.Px(kLeast), s.Px(kMost));
}

void DrawRay(ImVec2 centre, const HeadingScore& score, float from, float to, const Style& s) {
  const double a = score.heading_rad - kHalf_rad, b = score.heading_rad + kHalf_rad;
  if (score.IsVetoed()) {
    DashedLine(Canvas(), At(centre, score.heading_rad, from), At(centre, score.heading_rad, to),
               picture::kUnsafeLine, s.Fine(2), s.Px(3), s.Px(3));
    return;
  }
  Canvas()->AddQuadFilled(At(centre, a, from), At(centre, a, to), At(centre, b, to),
                          At(centre, b, from), WithAlpha(picture::kSafe, 0.8F));
}

/// An arrow towards the site.
void DrawPlanned(ImVec2 centre, double heading_rad, float from, float to, const Style& s) {
  const ImVec2 tip = At(centre, heading_rad, from), tail = At(centre, heading_rad, to);
  const double across =
      std::atan2(static_cast<double>(s.Px(6)), static_cast<double>(from + s.Px(12)));
  const ImVec2 left = At(centre, heading_rad - across, from + s.Px(12)),
               right = At(centre, heading_rad + across, from + s.Px(12));
  Canvas()->AddLine(tail, tip, picture::kBlack, s.Fine(5));
  Canvas()->AddLine(tail, tip, picture::kWhite, s.Fine(3));
  Canvas()->AddTriangleFilled(tip, left, right, picture::kWhite);
}

}  // namespace

bool HasCourses(const MissionStatus& m) { return m.armed && m.headings; }

void DrawCourses(const MissionStatus& m, const MapGround& ground, UiFrame& ui) {
  if (!HasCourses(m)) {
    return;
  }
  const Style& s = ui.style;
  const ImVec2 centre = ground.At(m.armed->p_WS.head<2>());
  const float from = s.Px(kInner), full = RoseRadius(centre, ground.rect, s);
  Canvas()->AddCircleFilled(centre, full, WithAlpha(picture::kLetterDark, 0.6F), 72);
  Canvas()->AddCircle(centre, full, WithAlpha(picture::kWhite, 0.4F), 72, s.Fine(1));
  for (const HeadingScore& score : m.headings->headings) {
    const auto share = static_cast<float>(std::clamp(score.combined, 0.0, 1.0));
    DrawRay(centre, score, from, from + (full - from) * share, s);
  }
  if (m.approach && std::isfinite(m.approach->heading_rad)) {
    DrawPlanned(centre, m.approach->heading_rad, from, full + s.Px(10), s);
  }
  ui.items.Add("courses", {centre.x - full, centre.y - full, 2 * full, 2 * full}, true, "");
}

std::string HeadingWords(const EngineSnapshot& snap) {
  const MissionStatus& m = snap.flight->mission;
  if (!m.headings || !m.approach || !std::isfinite(m.approach->heading_rad)) {
    return {};
  }
  const HeadingScore& score = m.headings->At(m.approach->heading_rad);
  const std::string heading = HeadingText(m.approach->heading_rad);
  const auto& vehicle = snap.sensors->vehicle;
  const bool calm = vehicle && std::isfinite(vehicle->wind_speed_mps) &&
                    !WindHasDirection(vehicle->wind_speed_mps);
  const bool sun = snap.session->settings.mission.sun == SunSource::kByPlace;
  return std::string("Approach ") + heading + ": wind " +
         (std::isfinite(score.tailwind_mps) ? Fixed(score.wind, 2)
          : calm                            ? "calm"
                                            : "not known") +
         ", sun " + (sun ? Fixed(score.sun, 2) : "not known") + ", turn " +
         Fixed(score.orientation, 2);
}

}  // namespace palace
