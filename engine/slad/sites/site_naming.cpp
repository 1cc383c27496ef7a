#include "engine/slad/sites/site_naming.h"

#include <algorithm>
#include <string_view>

namespace palace {
namespace {

constexpr std::string_view kLetters = "ABCDEFGHJKLMNPQRSTUVWXYZ";  // I and O read as 1 and 0

bool HasLetter(const std::vector<SitePlace>& places, const std::string& letter) {
  return std::any_of(places.begin(), places.end(),
                     [&](const SitePlace& place) { return place.letter == letter; });
}

}  // namespace

std::string SiteLetter(std::size_t n) {
  const std::size_t round = n / kLetters.size() + 1;
  return kLetters[n % kLetters.size()] + (round > 1 ? std::to_string(round) : "");
}

void SiteNaming::Name(std::vector<SitePlace>& places, SitePlace& fresh, double moves_m,
                      std::uint64_t kept) {
  SitePlace* moved = nullptr;
  double least_m = moves_m;
  for (SitePlace& place : places) {
    const double away_m = (place.named_at - fresh.p_W).norm();
    if (place.id != 0 && place.rank < 0 && place.id != kept && away_m < least_m) {
      moved = &place;
      least_m = away_m;
    }
  }
  if (moved != nullptr) {
    fresh.id = moved->id;
    fresh.letter = moved->letter;
    fresh.named_at = moved->named_at;
    *moved = {};
    return;
  }
  fresh.id = next_id_++;
  std::string letter;
  do {
    letter = SiteLetter(static_cast<std::size_t>(named_++));
  } while (HasLetter(places, letter));  // of a recorded flight nobody counted those before
  fresh.letter = letter;
}

void SiteNaming::Reset(SiteNames names) { named_ = names == SiteNames::kGoOn ? named_ : 0; }

void SiteNaming::GoOnNaming(std::uint64_t named) {
  named_ = std::max(named_, named);
  Use(named);
}

void SiteNaming::Use(std::uint64_t id) { next_id_ = std::max(next_id_, id + 1); }

}  // namespace palace
