#include "engine/experiments/heading_case.h"

#include <algorithm>

#include "engine/core/random.h"
#include "engine/core/text.h"
#include "engine/experiments/heading_reference.h"
#include "engine/flight/approach_plan.h"

namespace palace {
namespace {

constexpr double kStrongest_mps = 15;
constexpr double kLowestSun_deg = -20, kHighestSun_deg = 85;
constexpr std::array kSectorNames = {"N", "NE", "E", "SE", "S", "SW", "W", "NW"};

/// Degrees and m/s.
struct Listed {
  const char* name;
  double sun_azimuth, sun_elevation, wind_from, wind_mps, wanted, heading;
};
constexpr Listed kListed[] = {{"low sun; calm", 270, 12, 0, 0, 270, 280},
                              {"low sun ahead of a strong wind", 270, 12, 270, 12, 90, 290},
                              {"glint of the sun", 135, 45, 0, 0, 135, 55},
                              {"sun behind; moderate wind", 135, 40, 300, 4, 300, 280},
                              {"noon", 180, 75, 180, 5, 0, 160},
                              {"night; calm", 0, -20, 0, 0, 120, 110},
                              {"night; windy", 0, -20, 40, 10, 120, 40}};

bool IsClear(const LandingSite& site, int sector) {
  return (site.clear_approaches >> sector & 1U) != 0;
}

double Tailwind_mps(const HeadingConditions& now, double heading_rad) {
  return -now.wind_mps * std::cos(heading_rad - now.wind_from_rad);
}

double CurveError(const HeadingConditions& now, const HeadingCurve& curve) {
  double most = 0;
  for (const HeadingScore& score : curve.headings) {
    const ReferenceScore slow = ScoreByReference(now, score.heading_rad);
    for (const double off :
         {score.wind - slow.wind, score.sun - slow.sun, score.orientation - slow.orientation,
          score.combined - slow.combined}) {
      most = std::max(most, std::isfinite(off) ? std::abs(off) : INFINITY);
    }
  }
  return most;
}

bool BestIsVetoed(const HeadingConditions& now, const HeadingCurve& curve) {
  return curve.best && (now.blocked.test(static_cast<std::size_t>(*curve.best)) ||
                        Tailwind_mps(now, ApproachHeading(*curve.best)) > now.max_tailwind_mps);
}

/// Whether the words of approach_plan.h, over the reference's scores, lead to that course too. What
/// those scores cannot tell apart may go either way.
bool ReferenceAgrees(const HeadingConditions& now, const LandingSite& site,
                     const ApproachCourse& chosen) {
  const auto worth = [&](double heading_rad) {
    const double nearest_rad = ApproachHeading(static_cast<int>(NearestHeading(heading_rad).value()));
    const bool over = Tailwind_mps(now, nearest_rad) > now.max_tailwind_mps;
    return ScoreByReference(now, nearest_rad).combined - (over ? 1 : 0);
  };
  double best = -INFINITY;
  for (int sector = 0; sector < kApproachSectors; ++sector) {
    best = IsClear(site, sector) ? std::max(best, worth(HeadingFromSector(sector))) : best;
  }
  const double kept = site.corridor_clear ? worth(now.wanted_rad) + kWorthTurning : -INFINITY;
  constexpr double kEither = 2 * kReferenceTolerance;
  if (chosen.side == kStraightApproach) {
    return !std::isfinite(best) || best <= kept + kEither;
  }
  return best > kept - kEither && worth(chosen.heading_rad) >= best - kEither;
}

double LeastTailwind_mps(const HeadingConditions& now, const LandingSite& site) {
  double least = site.corridor_clear ? Tailwind_mps(now, now.wanted_rad) : INFINITY;
  for (int sector = 0; sector < kApproachSectors; ++sector) {
    if (IsClear(site, sector)) {
      least = std::min(least, Tailwind_mps(now, HeadingFromSector(sector)));
    }
  }
  return least;
}

std::string ClearText(const LandingSite& site) {
  std::string text = site.corridor_clear ? "straight" : "";
  for (int sector = 0; sector < kApproachSectors; ++sector) {
    if (IsClear(site, sector)) {
      text += (text.empty() ? "" : " ") + std::string(kSectorNames.at(sector));
    }
  }
  return text.empty() ? "nothing" : text;
}

}  // namespace

HeadingCase DrawnHeadingCase(std::uint64_t seed, double max_tailwind_mps) {
  RandomStream random(seed, "approach heading");
  const auto angle_rad = [&] { return Rad(random.Uniform(-180, 180)); };
  HeadingCase result;
  result.name = kDrawnCase;
  HeadingConditions& now = result.conditions;
  now.wind_mps = random.Uniform(0, kStrongest_mps);
  now.wind_from_rad = angle_rad();
  now.sun_azimuth_rad = angle_rad();
  now.sun_elevation_rad = Rad(random.Uniform(kLowestSun_deg, kHighestSun_deg));
  now.wanted_rad = angle_rad();
  now.max_tailwind_mps = max_tailwind_mps;
  LandingSite site;
  const double clear_share = random.Uniform();
  site.corridor_clear = random.Uniform() < clear_share;
  site.clear_approaches = 0;
  for (unsigned sector = 0; sector < kApproachSectors; ++sector) {
    const unsigned bit = random.Uniform() < clear_share ? 1U << sector : 0U;
    site.clear_approaches = static_cast<std::uint8_t>(site.clear_approaches | bit);
  }
  now.blocked = BlockedHeadings(site, now.wanted_rad);

  const HeadingCurve curve = ScoreHeadings(now);
  const ApproachCourse course = ChooseCourse(site, now.wanted_rad, curve);
  const bool straight = course.side == kStraightApproach;
  const bool limit_allows = LeastTailwind_mps(now, site) <= max_tailwind_mps;
  result.clear = ClearText(site);
  result.heading_rad = course.heading_rad;
  result.side = straight ? "straight" : kSectorNames.at(static_cast<std::size_t>(course.side));
  result.reason = !IsReached(site)                       ? kCourseRefused
                  : !limit_allows                        ? kCourseOverAnyway
                  : straight                             ? kCourseStraight
                  : !site.corridor_clear                 ? kCourseRound
                  : curve.At(now.wanted_rad).is_downwind ? kCourseOutOfWind
                                                         : kCourseBetter;
  result.tailwind_mps = Tailwind_mps(now, course.heading_rad);
  result.over_limit_mps = limit_allows ? result.tailwind_mps - max_tailwind_mps : NAN;
  const bool is_clear = straight ? site.corridor_clear : IsClear(site, course.side);
  result.flies_blocked = (IsReached(site) && !is_clear) || BestIsVetoed(now, curve);
  result.curve_error = CurveError(now, curve);
  result.agrees = ReferenceAgrees(now, site, course);
  return result;
}

std::vector<HeadingCase> ListedHeadingCases() {
  std::vector<HeadingCase> cases;
  for (const Listed& listed : kListed) {
    HeadingCase& one = cases.emplace_back();
    one.name = listed.name;
    HeadingConditions& now = one.conditions;
    now.wind_mps = listed.wind_mps;
    now.wind_from_rad = Rad(listed.wind_from);
    now.sun_azimuth_rad = Rad(listed.sun_azimuth);
    now.sun_elevation_rad = Rad(listed.sun_elevation);
    now.wanted_rad = Rad(listed.wanted);
    now.present_rad = 0;
    const HeadingCurve curve = ScoreHeadings(now);
    one.heading_rad = ApproachHeading(curve.best.value_or(0));
    one.clear = "all";
    one.side = "best of 72";
    one.reason = WithNumbers("listed as %03.0f", listed.heading);
    one.tailwind_mps = Tailwind_mps(now, one.heading_rad);
    one.curve_error = CurveError(now, curve);
    one.agrees = curve.best && std::abs(Deg(one.heading_rad) - listed.heading) < 1e-6;
  }
  return cases;
}

}  // namespace palace
