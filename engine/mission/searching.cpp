#include "engine/mission/searching.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/mission/going.h"
#include "engine/mission/wording.h"
#include "engine/model/find_site.h"
#include "engine/model/mission/hover_before.h"
#include "engine/model/site_standing.h"
#include "engine/search/ground_looks.h"
#include "engine/search/search_plan.h"

namespace palace {
namespace {

constexpr double kReplan_s = 1;
constexpr double kSpareAir_m = 1;  // more than is asked for, so that the next map shows it too
constexpr double kLeastClimb_m = 2, kLongestClimb_m = 10;
constexpr double kSamePlace_m = 0.5;
constexpr double kSameHeading_rad = Rad(3);
constexpr int kSampled = 4;  // every so many rows and columns

double MeanGround(const ElevationMap& map) {
  double sum_m = 0;
  int cells = 0;
  const GridF& ground = map.Measured();
  for (int row = 0; row < map.state.rows(); row += kSampled) {
    for (int col = 0; col < map.state.cols(); col += kSampled) {
      if (map.state.at(row, col) == CellState::kMeasured) {
        sum_m += static_cast<double>(ground.at(row, col));
        ++cells;
      }
    }
  }
  return cells > 0 ? sum_m / cells : NAN;
}

bool IsPlaceKnown(const MissionFacts& facts) {
  return facts.p_WB.allFinite() && std::isfinite(facts.yaw_rad);
}

ProposedLook Proposed(const MissionMemory& m, const FlyTo& to, std::string why) {
  return {to.p_WB, to.heading_rad,
          words::WayInShort(to.p_WB - m.facts.p_WB, WrapAngle(to.heading_rad - m.facts.yaw_rad)),
          std::move(why)};
}

/// From higher up, where a site lacks the sight of its air only.
std::optional<ProposedLook> LookForAir(const MissionMemory& m, Timestamp now) {
  const bool armed = m.status.state == MissionState::kArmed;
  const LandingSite* site =
      armed ? (m.newest ? &*m.newest : &*m.status.armed) : m.status.BestStanding(m.facts.sites);
  if (site == nullptr || IsAirShown(*site) || (armed && m.armed.air_shown)) {
    return std::nullopt;
  }
  const double over_m = static_cast<double>(site->air_seen_m);
  const double seen_m = std::fmax(0, std::fmax(over_m, static_cast<double>(site->air_on_way_m)));
  const double up_m =
      std::clamp(std::ceil(kLeastAirSeen_m - seen_m + kSpareAir_m), kLeastClimb_m, kLongestClimb_m);
  const FlyTo to{m.facts.p_WB - up_m * Eigen::Vector3d::UnitZ(), m.facts.yaw_rad};
  if (!WhyNotThere(m, to, now).empty()) {
    return std::nullopt;
  }
  return Proposed(m, to,
                  "the air over site " + site->letter +
                      WithNumbers(" is seen up to %.1f m, min %.1f m", seen_m, kLeastAirSeen_m));
}

/// For a look that takes so long; 0: for any. Empty: it has it, or for how long it lasts is not
/// known.
std::string WhyNoEnergy(const MissionMemory& m, double takes_s) {
  const double lasts_s = m.status.energy.lasts_s;
  const double reserve_s = m.facts.settings.mission.energy_reserve_s;
  if (!(lasts_s - takes_s < reserve_s)) {
    return {};
  }
  const std::string takes = takes_s > 0 ? WithNumbers(", it takes %.0f s", takes_s) : "";
  return WithNumbers("No look: energy lasts %.1f min", lasts_s / 60) + takes +
         WithNumbers(", reserve %.1f min", reserve_s / 60);
}

bool HoldsId(const std::vector<std::uint64_t>& ids, std::uint64_t id) {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

std::optional<FlyTo> WayToPromising(const MissionMemory& m) {
  const std::optional<LandingSite>& site = m.search.promising;
  if (!site || m.status.state != MissionState::kSearch || m.status.IsRefused(site->id) ||
      HoldsId(m.search.looked_at, site->id) || FindSite(m.facts.sites, site->id) != nullptr) {
    return std::nullopt;  // what is listed still stands, and is seen from here
  }
  return HoverBefore(m.facts.p_WB, site->p_WS, Rad(m.facts.settings.mission.glide_slope_deg));
}

std::optional<ProposedLook> LookAgain(const MissionMemory& m, Timestamp now) {
  const std::optional<FlyTo> to = WayToPromising(m);
  if (!to || !WhyNotThere(m, *to, now).empty()) {
    return std::nullopt;
  }
  return Proposed(m, *to, "site " + m.search.promising->letter + " was proposed and did not last");
}

/// `why_none`: said where there is none.
std::optional<ProposedLook> LookElsewhere(const MissionMemory& m, Timestamp now,
                                          const FlyTo* before, std::string& why_none) {
  const SearchMemory& search = m.search;
  if (!search.view || !m.status.seen) {
    why_none = "The height of the ground is not known";
    return std::nullopt;
  }
  const FlyArea* area = m.status.area ? &*m.status.area : nullptr;
  const SearchGround ground{*m.status.seen, *search.view, area};
  const FlyTo here{m.facts.p_WB, m.facts.yaw_rad};
  const auto may_fly = [&](const FlyTo& to) { return WhyNotThere(m, to, now).empty(); };
  const std::optional<SearchLook> look = NextLook(ground, here, may_fly, before);
  const double left_m2 = LeftToSee_m2(ground);
  if (look) {
    why_none = WhyNoEnergy(m, look->takes_s);
    return why_none.empty()
               ? std::optional(Proposed(m, look->to,
                                        WithNumbers("shows %.0f of %.0f m² left to see, in %.0f s",
                                                    look->new_m2, left_m2, look->takes_s)))
               : std::nullopt;
  }
  const std::string where =
      area != nullptr ? "in the area"
                      : WithNumbers("within %.0f m of where it began", SeenGround::kSearched_m);
  why_none = left_m2 < kLeastNew_m2 ? "All ground " + where + " was looked at"
                                    : WithNumbers("%.0f m² ", left_m2) + where +
                                          " are out of sight from any hover near";
  return std::nullopt;
}

}  // namespace

void RememberGround(MissionMemory& m, const MissionInputs& in) {
  SearchMemory& search = m.search;
  if (in.vehicle.bundle.rig) {
    search.view = GroundView(*in.vehicle.bundle.rig);
  }
  if (in.terrain.forgotten || m.watch.rebooted()) {
    m.status.seen.reset();
    search.promising.reset();
    search.looked_at.clear();
  }
  if (m.status.state == MissionState::kProposed) {
    const LandingSite* best = m.status.BestStanding(m.facts.sites);
    if (best != nullptr) {
      search.promising = *best;
    }
  }
  const TerrainDecision* decision = in.terrain.decision;
  if (!in.terrain.new_map || decision == nullptr || !decision->elevation || !search.view ||
      !IsPlaceKnown(m.facts)) {
    return;
  }
  const double ground_m = MeanGround(*decision->elevation);
  std::shared_ptr<const SeenGround>& seen = m.status.seen;
  if (!seen && !std::isfinite(ground_m)) {
    return;
  }
  const Eigen::Vector2d here = m.facts.p_WB.head<2>();
  const bool goes_on = seen && (seen->middle_W - here).norm() <= SeenGround::kSearched_m;
  auto next = std::make_shared<SeenGround>(goes_on ? *seen : NothingSeen(here));
  next->ground_m = std::isfinite(ground_m) ? ground_m : seen->ground_m;
  AddLook(*next, *search.view, {m.facts.p_WB, m.facts.yaw_rad});
  seen = std::move(next);
}

void PlanSearch(MissionMemory& m, Timestamp now) {
  MissionStatus& status = m.status;
  const bool armed = status.state == MissionState::kArmed;
  if (!status.why_not_go.empty() || status.going || !IsPlaceKnown(m.facts)) {
    status.next_look.reset();
    status.why_no_look = status.why_not_go;
    m.search.planned_at = {};
    return;
  }
  const bool due = now < m.search.planned_at ||
                   SecondsBetween(m.search.planned_at, now) >= kReplan_s ||
                   (armed && m.search.planned_at < status.since);
  if (!due) {
    return;
  }
  m.search.planned_at = now;
  status.why_no_look.clear();
  const std::optional<FlyTo> before =
      status.next_look ? std::optional(FlyTo{status.next_look->p_WB, status.next_look->heading_rad})
                       : std::nullopt;
  status.next_look = LookForAir(m, now);
  if (armed) {
    return;
  }
  status.why_no_look = WhyNoEnergy(m, 0);
  if (!status.why_no_look.empty()) {
    return;
  }
  if (!status.next_look) {
    status.next_look = LookAgain(m, now);
  }
  if (!status.next_look) {
    status.next_look = LookElsewhere(m, now, before ? &*before : nullptr, status.why_no_look);
  }
}

void RememberLook(MissionMemory& m, const FlyTo& there) {
  const std::optional<FlyTo> again = WayToPromising(m);
  if (again && (again->p_WB - there.p_WB).norm() < kSamePlace_m &&
      std::abs(WrapAngle(again->heading_rad - there.heading_rad)) < kSameHeading_rad) {
    m.search.looked_at.push_back(m.search.promising->id);
  }
}

}  // namespace palace
