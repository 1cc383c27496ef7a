#include "engine/runtime/recorded_names.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace palace {
namespace {

constexpr double kSamePlace_m = 1.5;
constexpr std::uint64_t kUnrecordedIds = 1'000'000'000;  // no flight names that many places

/// New letters of old ones.
using Renamed = std::map<std::string, std::string>;

std::string Small(std::string letter) {
  std::transform(letter.begin(), letter.end(), letter.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return letter;
}

/// Letters in a sentence, "0.6 m less clear than A2": whole words only.
std::string WithNewLetters(const std::string& text, const Renamed& renamed) {
  const auto is_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
  std::string said;
  for (auto at = text.begin(); at != text.end();) {
    const auto end = is_word(*at) ? std::find_if_not(at, text.end(), is_word) : at + 1;
    const std::string word(at, end);
    const auto found = renamed.find(word);
    said += found != renamed.end() ? found->second : word;
    at = end;
  }
  return said;
}

struct Pairing {
  double distance_m = 0;
  LandingSite* site = nullptr;
  const RecordedPlace* place = nullptr;
};

/// Every site with every place near it, nearest first.
std::vector<Pairing> PairingsOf(SiteSelection& selection, const RecordedProposal& proposal) {
  std::vector<Pairing> pairings;
  for (LandingSite& site : selection.sites) {
    for (const RecordedPlace& place : proposal.places) {
      const double distance_m = (site.p_WS.head<2>() - place.north_east_m).norm();
      if (distance_m <= kSamePlace_m) {
        pairings.push_back({distance_m, &site, &place});
      }
    }
  }
  std::stable_sort(pairings.begin(), pairings.end(),
                   [](const Pairing& a, const Pairing& b) { return a.distance_m < b.distance_m; });
  return pairings;
}

}  // namespace

std::shared_ptr<const TerrainDecision> NamedByRecord(
    std::shared_ptr<const TerrainDecision> decision, const RecordedProposal& proposal,
    bool limits_of_flight) {
  auto named = std::make_shared<TerrainDecision>(*decision);
  Renamed renamed;
  for (LandingSite& site : named->selection.sites) {
    renamed[site.letter] = Small(site.letter);
    site.id += kUnrecordedIds;
  }
  std::vector<const RecordedPlace*> taken;
  for (const Pairing& pairing : PairingsOf(named->selection, proposal)) {
    const bool free = std::find(taken.begin(), taken.end(), pairing.place) == taken.end();
    if (free && pairing.site->id >= kUnrecordedIds) {
      renamed[pairing.site->letter] = pairing.place->letter;
      pairing.site->id = pairing.place->id;
      taken.push_back(pairing.place);
    }
  }
  for (LandingSite& site : named->selection.sites) {
    site.letter = renamed[site.letter];
    site.reason = WithNewLetters(site.reason, renamed);
  }
  if (limits_of_flight) {
    const auto rank = [&](const LandingSite& site) {
      return std::find_if(proposal.places.begin(), proposal.places.end(),
                          [&](const RecordedPlace& place) { return place.id == site.id; });
    };
    std::stable_sort(named->selection.sites.begin(), named->selection.sites.end(),
                     [&](const LandingSite& a, const LandingSite& b) { return rank(a) < rank(b); });
  }
  return named;
}

}  // namespace palace
