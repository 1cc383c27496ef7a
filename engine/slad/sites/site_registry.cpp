#include "engine/slad/sites/site_registry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <opencv2/core.hpp>

#include "engine/model/site_standing.h"
#include "engine/slad/sites/none_reason.h"
#include "engine/slad/sites/rank_reasons.h"
#include "engine/slad/sites/site_evaluation.h"
#include "engine/slad/sites/site_ranking.h"
#include "engine/slad/terrain/sense_check.h"

namespace palace {
namespace {

constexpr int kListedAfter_maps = 3;
constexpr std::size_t kTriesPerSite = 3;  // places looked at for each site kept

void Replace(std::string& text, const std::string& words, const std::string& with) {
  if (const auto at = text.rfind(words); at != std::string::npos) {
    text.replace(at, words.size(), with);
  }
}

/// Reasons speak of the best and the next: their letters instead.
void NameInReasons(SiteSelection& selection) {
  if (selection.sites.empty()) {
    return;
  }
  const std::string best = selection.sites.front().letter;
  const std::string next = selection.sites.size() > 1 ? selection.sites[1].letter : "?";
  for (LandingSite& site : selection.sites) {
    Replace(site.reason, "the best", best);
    Replace(site.reason, "the next", next);
  }
}

}  // namespace

/// One map, and how it stands to the one before.
struct SiteRegistry::Map {
  const ElevationMap& elevation;
  const HazardMaps& hazards;
  const SladSettings& settings;
  const SiteContext& context;
  bool first = false;  ///< of a flight, or under other limits: nothing is steady yet
  bool again = false;  ///< the same map: counts no second time
  ApproachCorridors corridors{elevation, settings};

  std::optional<Cell> CellOf(const Eigen::Vector2d& p_W) const {
    return elevation.geometry.CellFromPoint(p_W.x(), p_W.y());
  }
  std::size_t most_sites() const { return static_cast<std::size_t>(settings.choice.sites_kept); }
  /// Score of a place that a map called unsafe: as if ten times as much might hide there, or all of
  /// its cost.
  double shaken_costs() const {
    return settings.choice.ranking == SiteRanking::kFarthest ? settings.lander.clear_radius_m() : 1;
  }
  /// Room beyond the clear radius that a map may be wrong by.
  double tight_m() const {
    return settings.mode == SladMode::kModern ? elevation.geometry.cell_m : 0;
  }
};

void SiteRegistry::Reset(SiteNames names) {
  SiteRegistry anew;
  anew.naming_ = naming_;
  anew.naming_.Reset(names);
  anew.waits_ = waits_;
  *this = std::move(anew);
}

void SiteRegistry::GoOnWith(const std::vector<RecordedPlace>& places,
                            const SladSettings& settings) {
  places_.clear();
  for (const RecordedPlace& place : places) {
    places_.push_back({.id = place.id,
                       .letter = place.letter,
                       .p_W = place.north_east_m,
                       .rank = static_cast<int>(places_.size()),
                       .run = kBetterAfter_maps,  // nobody says how long it has stood
                       .beaten = LastingClaim(kBetterAfter_maps)});
    naming_.Use(place.id);
  }
  time_ = Timestamp{};  // older than any map: the next is not the same again
  settings_ = settings;
  lists_ = !places.empty();  // a flight's first seconds have none
}

SiteSelection SiteRegistry::Select(const ElevationMap& map, const HazardMaps& hazards,
                                   const SladSettings& settings, const SiteContext& context) {
  PALACE_CHECK(map.geometry == hazards.geometry);
  SiteSelection selection;
  selection.none_reason = ObjectionTo(map, settings);
  if (!selection.none_reason.empty()) {
    Lose({map, hazards, settings, context}, {});
    return selection;
  }
  const bool first = !time_ || settings != settings_;
  const bool again = time_ == map.time;
  maps_ += again ? 0 : 1;
  lists_ = lists_ || !waits_ || settings.mode == SladMode::kThesis ||
           maps_ >= settings.fusion.frames_fused;
  const Map now{map, hazards, settings, context, first, !first && again};
  StartMap(now);
  SiteCandidates candidates(map, hazards, settings, context);
  std::vector<FoundSite> found = Revisit(now, candidates);
  Explore(now, candidates, found);
  Lose(now, found);
  const bool any = !found.empty();
  std::erase_if(found, [&](const FoundSite& one) { return !IsRipe(now, places_[one.place]); });
  const RankRules rules{now.elevation.time, candidates.noise(), now.shaken_costs(),
                        now.most_sites(), kept_};
  for (FoundSite& one : List(now, Ranked(places_, std::move(found), rules))) {
    selection.sites.push_back(std::move(one.site));
  }
  std::erase_if(places_, [](const SitePlace& place) { return place.id == 0 && place.run == 0; });
  GiveReasons(settings.choice.ranking, now.tight_m(), selection);
  NameInReasons(selection);
  selection.named = naming_.named();
  if (selection.sites.empty()) {
    selection.waits = !lists_;
    selection.none_reason = !lists_ ? "places are listed once " +
                                          std::to_string(settings.fusion.frames_fused) +
                                          " pictures are fused, now " + std::to_string(maps_)
                            : !any ? NoneReason(map, hazards, settings)
                                   : "the places found are not on 3 maps in a row yet";
  }
  return selection;
}

void SiteRegistry::StartMap(const Map& now) {
  if (now.first) {
    for (SitePlace& place : places_) {
      place = {.id = place.id,
               .letter = place.letter,
               .p_W = place.p_W,
               .named_at = place.named_at,
               .rank = place.rank};
    }
  }
  if (!now.again) {
    replaced_.clear();
  }
  time_ = now.elevation.time;
  settings_ = now.settings;
}

std::vector<FoundSite> SiteRegistry::Revisit(const Map& now, SiteCandidates& candidates) {
  std::vector<Chosen> listed;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const auto cell = now.CellOf(places_[i].p_W);
    const auto score = cell ? candidates.ScoreAt(*cell) : std::nullopt;
    if (score && (places_[i].rank >= 0 || IsKept(places_[i]))) {
      listed.push_back({i, {*cell, *score}});
    }
  }
  // The better ones first: what is better near one of them does not speak against another.
  std::stable_sort(listed.begin(), listed.end(), [&](const Chosen& a, const Chosen& b) {
    return std::pair(IsKept(places_[a.place]), a.at.score) >
           std::pair(IsKept(places_[b.place]), b.at.score);
  });
  std::vector<Chosen> chosen;
  for (const Chosen& one : listed) {
    SitePlace& place = places_[one.place];
    if (!candidates.ScoreAt(one.at.cell)) {
      continue;  // too near another: the spacing was changed
    }
    const bool beaten = candidates.BestNear(one.at.cell) > one.at.score + candidates.noise();
    if (!now.again && place.beaten.Add(beaten, kBetterAfter_maps) && !IsKept(place)) {
      replaced_.push_back(place.p_W);
      place.beaten = LastingClaim();
      place.rank = -1;
      continue;
    }
    candidates.Take(one.at.cell);
    chosen.push_back(one);
  }
  std::vector<FoundSite> found;
  Follow(now, chosen, candidates, found);
  return found;
}

void SiteRegistry::Explore(const Map& now, SiteCandidates& candidates,
                           std::vector<FoundSite>& found) {
  for (const SitePlace& place : places_) {
    if (const auto cell = now.CellOf(place.p_W)) {
      candidates.Favour(*cell);
    }
  }
  std::size_t tried = found.size();
  const std::size_t most = kTriesPerSite * now.most_sites();
  while (tried < most) {
    // How a place turns out does not change which come next: as many as are still wanted are looked
    // at side by side.
    const std::size_t wanted = Wanted(now, found, candidates);
    std::vector<Chosen> chosen;
    while (chosen.size() < std::min(wanted, most - tried)) {
      const auto best = candidates.TakeBest();
      if (!best) {
        break;
      }
      chosen.push_back({PlaceAt(now, best->cell), *best});
    }
    if (chosen.empty()) {
      return;
    }
    tried += chosen.size();
    Follow(now, chosen, candidates, found);
  }
}

/// As many as are missing whose straight approach is clear; beyond that one that is better than the
/// worst of them.
std::size_t SiteRegistry::Wanted(const Map& now, const std::vector<FoundSite>& found,
                                 const SiteCandidates& candidates) const {
  std::size_t clear = 0;
  double worst = HUGE_VAL;
  for (const FoundSite& one : found) {
    const SitePlace& place = places_[one.place];
    if (place.straight_clear.good()) {
      ++clear;
      worst = std::min(worst, place.score.value());
    }
  }
  if (clear < now.most_sites()) {
    return now.most_sites() - clear;
  }
  const auto best = candidates.BestScore();
  return best && *best > worst + candidates.noise() ? 1 : 0;
}

std::size_t SiteRegistry::PlaceAt(const Map& now, Cell cell) {
  const auto known = std::find_if(places_.begin(), places_.end(), [&](const SitePlace& place) {
    return place.rank < 0 && now.CellOf(place.p_W) == cell;
  });
  if (known == places_.end()) {
    const GridGeometry& g = now.elevation.geometry;
    SitePlace fresh{.p_W = {g.NorthOfRow(cell.row), g.EastOfCol(cell.col)}};
    for (const SitePlace& place : places_) {
      const bool near = (place.p_W - fresh.p_W).norm() < now.settings.choice.spacing_m;
      if (near && place.shaken_at > fresh.shaken_at) {
        fresh.shaken_at = place.shaken_at;
        fresh.losses = place.losses;
      }
    }
    places_.push_back(std::move(fresh));
    return places_.size() - 1;
  }
  return static_cast<std::size_t>(known - places_.begin());
}

void SiteRegistry::Follow(const Map& now, const std::vector<Chosen>& chosen,
                          const SiteCandidates& candidates, std::vector<FoundSite>& found) {
  std::vector<LandingSite> sites(chosen.size());
  cv::parallel_for_(cv::Range(0, static_cast<int>(chosen.size())), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) {
      const auto k = static_cast<std::size_t>(i);
      sites[k] = EvaluateSite(now.elevation, now.hazards, now.settings, now.context, now.corridors,
                              chosen[k].at.cell);
    }
  });
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    LandingSite& site = sites[k];
    if (!IsSound(site)) {
      continue;
    }
    SitePlace& place = places_[chosen[k].place];
    if (!now.again || place.score.empty()) {
      ++place.run;
      place.score.Add(chosen[k].at.score, candidates.noise());
      place.confirmed.Add(site.confirmed);
      place.air_shown.Add(IsAirShown(site));
      place.straight_clear.Add(site.corridor_clear);
      place.some_clear.Add(site.clear_approaches != 0);
      place.roomy.Add(site.clearance_m >= now.tight_m());
    }
    site.p_WS.head<2>() = place.p_W;
    site.newest_confirms = site.confirmed;
    site.confirmed = place.confirmed.good();
    if (site.confirmed) {
      site.look_height_m = std::numeric_limits<double>::quiet_NaN();  // there is nothing to settle
    }
    site.look_height_m = LookToldAgain(place.look_height_m, site.look_height_m);
    place.look_height_m = site.look_height_m;
    site.called_unsafe_s = place.ShakenFor(now.elevation.time);
    found.push_back({chosen[k].place, std::move(site)});
  }
}

bool SiteRegistry::IsRipe(const Map& now, const SitePlace& place) const {
  if (!lists_) {
    return false;
  }
  const double spacing_m = now.settings.choice.spacing_m;
  return now.first || place.rank >= 0 || place.run >= kListedAfter_maps ||
         std::any_of(replaced_.begin(), replaced_.end(), [&](const Eigen::Vector2d& p_W) {
           return (p_W - place.p_W).norm() < spacing_m;
         });
}

/// Places that the map does not show as sites have to begin anew.
void SiteRegistry::Lose(const Map& now, const std::vector<FoundSite>& found) {
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const bool is_found = std::any_of(found.begin(), found.end(),
                                      [&](const FoundSite& one) { return one.place == i; });
    if (!is_found) {
      SitePlace& place = places_[i];
      const bool unsafe = place.rank >= 0 && now.CellOf(place.p_W);
      place = {.id = place.id,
               .letter = place.letter,
               .p_W = place.p_W,
               .named_at = place.named_at,
               .losses = place.losses + (unsafe ? 1 : 0),
               .shaken_at = unsafe ? now.elevation.time : place.shaken_at};
    }
  }
}

/// In that order, each with id and letter.
std::vector<FoundSite> SiteRegistry::List(const Map& now, std::vector<FoundSite> ranked) {
  for (SitePlace& place : places_) {
    place.rank = -1;
  }
  int rank = 0;
  for (const FoundSite& one : ranked) {
    places_[one.place].rank = rank++;
  }
  std::uint64_t unnamed = 0;
  for (FoundSite& one : ranked) {
    SitePlace& place = places_[one.place];
    if (place.id == 0 && !gives_letters_) {
      one.site.id = kFirstUnnamedSite + ++unnamed;
      one.site.letter = "+" + std::to_string(unnamed);
      continue;
    }
    if (place.id == 0) {
      naming_.Name(places_, place, now.settings.choice.spacing_m / 4, kept_);
    }
    one.site.id = place.id;
    one.site.letter = place.letter;
  }
  return ranked;
}

}  // namespace palace
