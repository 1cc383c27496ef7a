// How much is known of a site, and why it is no more, in words for people.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/model/landing_site.h"
#include "engine/model/settings/settings.h"

namespace palace {

/// One frame's gaps and blunders are not told from the ground; fewer where frames_fused is less.
inline constexpr int kFramesToConfirm = 3;

/// Nothing is approved on ground measured longer ago, as old as a map may be.
inline constexpr double kOldGround_s = 2;

/// Its ground was measured no longer ago.
bool IsInView(const LandingSite& site);
bool IsAnyInView(const std::vector<LandingSite>& sites);

/// "3.1 m clear", with ", not all in view" where the ground is older than that.
std::string ClearWords(const LandingSite& site);

/// Rocks and holes over the limit expected unseen (LandingSite::hidden_things) under a confirmed
/// site, at most: so few of a hundred may be unsafe.
inline constexpr double kMostHidden = 0.01;
/// … and under a provisional one, of which one in twenty may: where more may be hidden the site is
/// to be looked at first.
inline constexpr double kMostHiddenProvisional = 0.05;

/// Above a site that is flown to or approved: from there on it must be confirmed.
inline constexpr double kConfirmHeight_m = 6;

/// Of the air over a site (LandingSite::air_seen_m), asked of a confirmed one. None is approved
/// whose way down shows no more either: a wire or a branch hangs there unseen.
inline constexpr double kLeastAirSeen_m = 5;
/// It was seen, or the way down shows it, or nobody asked.
bool IsAirShown(const LandingSite& site);

/// A mark that no height explains (kFlagUnexplained) lies within its clear radius: no look is known
/// from which nothing could hide.
bool IsMarked(const LandingSite& site);

/// A look goes down by as much at least: a hover nearer to it would be the same view.
inline constexpr double kLeastWayToLook_m = 2;

/// Heights of a look are told in whole metres: one that differs by no more stays as it was `told`.
inline constexpr double kSameLook_m = 1;
double LookToldAgain(double told_m, double now_m);

enum class SiteStanding : std::uint8_t {
  kConfirmed,    ///< LandingSite::confirmed
  kProvisional,  ///< all but confirmed: it holds every limit that may be asked at its noise
  /// 3 sigma of its heights reach the roughness limit, more than kMostHiddenProvisional may be
  /// hidden there, or less than kLeastAirSeen_m of the air over it was looked at: what stands or
  /// hangs there is not known. The place is offered to be looked at first.
  kToLookAt,
};
SiteStanding StandingOf(const LandingSite& site, const SladSettings& settings);
/// "Confirmed", "Provisional", "Look first".
const char* StandingWord(SiteStanding standing);

/// "Look from 12 m" where noise is what speaks against a place and it is known from where it would
/// not (LandingSite::look_height_m); else StandingWord.
std::string StandingWords(const LandingSite& site, const SladSettings& settings);

/// The first that holds: noise of height, what may hide (over kMostHiddenProvisional, and air is
/// shown), air not seen, what may hide, probability, frames, cells wider than a rock
/// (landing_site.h, confirmed). Empty when the site is confirmed.
std::string WhyProvisional(const LandingSite& site, const SladSettings& settings);

}  // namespace palace
