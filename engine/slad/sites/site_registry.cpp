#include <algorithm>
#include <string>

#include "engine/slad/sites/site_selection.h"

namespace palace {
namespace {

constexpr double kSamePlace_m = 1.5;
constexpr std::size_t kLetters = 26;

void Replace(std::string& text, const std::string& words, const std::string& with) {
  if (const auto at = text.rfind(words); at != std::string::npos) {
    text.replace(at, words.size(), with);
  }
}

}  // namespace

void SiteRegistry::Reset() {
  places_.clear();
  turn_ = 0;
}

SiteRegistry::Place& SiteRegistry::NewPlace() {
  if (places_.size() < kLetters) {
    Place fresh;
    fresh.letter = static_cast<char>('A' + places_.size());
    places_.push_back(fresh);
    return places_.back();
  }
  return *std::min_element(places_.begin(), places_.end(), [](const Place& a, const Place& b) {
    return a.last_used < b.last_used;
  });
}

void SiteRegistry::Assign(SiteSelection& selection) {
  ++turn_;
  // Known places first, so that a new site cannot take the letter of one listed after it.
  for (LandingSite& site : selection.sites) {
    site.id = 0;
    Place* nearest = nullptr;
    double nearest_m = kSamePlace_m;
    for (Place& place : places_) {
      const double distance_m = (place.p_WS - site.p_WS).head<2>().norm();
      if (place.last_used != turn_ && distance_m <= nearest_m) {
        nearest = &place;
        nearest_m = distance_m;
      }
    }
    if (nearest != nullptr) {
      nearest->last_used = turn_;  // the place stays where it was named: letters must not creep
      site.id = nearest->id;
      site.letter = nearest->letter;
    }
  }
  for (LandingSite& site : selection.sites) {
    if (site.id == 0) {
      PALACE_CHECK(selection.sites.size() <= kLetters, selection.sites.size());
      Place& place = NewPlace();
      place = {next_id_++, place.letter, site.p_WS, turn_};
      site.id = place.id;
      site.letter = place.letter;
    }
  }
  if (selection.sites.empty()) {
    return;
  }
  // Reasons were written before letters were known.
  const std::string best(1, selection.sites.front().letter);
  const std::string next(1, selection.sites.size() > 1 ? selection.sites[1].letter : '?');
  for (LandingSite& site : selection.sites) {
    Replace(site.reason, "the best", best);
    Replace(site.reason, "the next", next);
  }
}

}  // namespace palace
