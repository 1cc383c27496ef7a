#include "engine/tracking/anchored_feature.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/rounding.h"
#include "engine/core/text.h"
#include "engine/tracking/anchor_zoom.h"
#include "engine/tracking/landing_features.h"
#include "engine/tracking/picture_part.h"
#include "engine/tracking/template_anchor.h"
#include "engine/tracking/template_match.h"

namespace palace {
namespace {

constexpr int kNear_px = 8;  // what attitude and position err by from one picture to the next
constexpr double kMaxWide_px = 128;
constexpr int kAfterWide_px = 4;  // a wide search is at half resolution
constexpr double kWideCoherence = 0.6;
constexpr int kStride = 2;  // of smoothed pixels every other says what all do
constexpr double kSeen = 0.7;
constexpr double kRival = 0.9;
constexpr double kSuddenFall = 0.15;
constexpr double kSigma_px = 0.3;
constexpr double kSigmaOfDistance = 0.003;  // what a pose errs by between feature and site

}  // namespace

AnchoredFeature::AnchoredFeature(int number, KeyPatch patch, const Eigen::Vector2d& site_pixel,
                                 const PredictedPixel& site)
    : patch_(std::move(patch)),
      site_key_(site_pixel),
      pixel_(patch_.pixel),
      predicted_(patch_.pixel) {
  member_.kind = TrackerMember::Kind::kFeature;
  member_.name = "Feature " + std::to_string(number);
  member_.anchors = 1;
  member_.coherence = member_.own_score = 1;
  member_.pixel = pixel_;
  site_.See(site_pixel, kSigma_px, site);
  site_.Tell(member_);
}

Eigen::Vector2d AnchoredFeature::ToSite(const PatchView& patch) const {
  return MapPixel(patch.now_from_key, site_key_) - patch.pixel;
}

std::string AnchoredFeature::WhyNot(double coherence, double seen, bool alone, double least) const {
  if (coherence < least) {
    return WithNumbers("coherence %.2f, limit %.2f", ShownBeyond(coherence, least, 2), least);
  }
  if (seen < kSeen) {
    return WithNumbers("%.0f %% of the template is seen, limit %.0f %%",
                       ShownBeyond(100 * seen, 100 * kSeen, 0), 100 * kSeen);
  }
  const bool lost = site_.pictures_lost() > 0;
  if (!lost && member_.coherence - coherence > kSuddenFall) {
    return WithNumbers("coherence fell from %.2f to %.2f in one picture, limit %.2f",
                       member_.coherence, coherence, kSuddenFall);
  }
  return lost && !alone ? "two places are alike" : "";
}

AnchoredFeature::Sighting AnchoredFeature::Look(const SiteView& view, const PatchView& patch,
                                                const Eigen::Vector2d& expected, int reach_px,
                                                double least) const {
  Sighting sighting;
  sighting.place = expected;
  sighting.A = A_;
  const int side = FeatureSide(view.settings), half = side / 2, border = 3;
  const ImageU8 anchor =
      WarpedSquare(*patch_.keyframe, KeyFromNow(patch, A_, expected), expected, side + 2 * border);
  const Eigen::Vector2d middle = Eigen::Vector2d::Constant(half + border);
  const auto values = TemplateAnchor::Make(anchor, middle, side, kStride);
  if (!values) {
    sighting.why_not = "its anchor is too even";
    return sighting;
  }
  bool alone = true;
  if (reach_px > 0) {
    const PictureWindow window = CutWindow(view.left, expected, half + reach_px);
    if (window.picture.width() < side || window.picture.height() < side) {
      sighting.why_not = "it is out of the picture";
      return sighting;
    }
    const TemplateMatch match =
        MatchTemplate(window.picture, CutWindow(anchor, middle, half).picture);
    sighting.place =
        (window.corner + match.corner).cast<double>() + Eigen::Vector2d::Constant(half);
    alone = match.second_score <= kRival * match.score;
  }
  double seen = 0;
  if (const auto fit = values->Refined(view.left, {sighting.place})) {
    sighting.place = fit->at.place;
    sighting.A = fit->at.Linear() * A_;
    seen = fit->seen;
  }
  sighting.patches = ComparePatches(*patch_.keyframe, view.left,
                                    KeyFromNow(patch, sighting.A, sighting.place), sighting.place);
  sighting.why_not = WhyNot(sighting.patches.coherence, seen, alone, least);
  return sighting;
}

AnchoredFeature::Sighting AnchoredFeature::Find(const SiteView& view, const PatchView& patch,
                                                const FeatureHint& hint) {
  const bool lost = site_.pictures_lost() > 0;
  const double min = view.settings.min_coherence;
  const double as_before = std::max(min, fresh_coherence_ - kSuddenFall);
  const Eigen::Vector2d carried = pixel_ + patch.pixel - predicted_;
  const Eigen::Vector2d expected =
      lost && hint.site_pixel ? Eigen::Vector2d(*hint.site_pixel - ToSite(patch)) : carried;
  if (!InPicture(view.camera, expected, kPatchSide_px / 2)) {
    Sighting outside;
    outside.why_not = "it is out of the picture";
    return outside;
  }
  member_.window_centre = expected;
  member_.window_side_px = FeatureSide(view.settings) + 2 * kNear_px;
  Sighting sighting;
  sighting.why_not = "it was LOST";
  if (!lost) {
    sighting = Look(view, patch, expected, 0, as_before);
  }
  if (!sighting.why_not.empty()) {
    sighting = Look(view, patch, expected, kNear_px, lost ? as_before : min);
  }
  if (sighting.why_not.empty() || !hint.may_look_wide) {
    return sighting;
  }
  const int radius_px = static_cast<int>(
      std::min(std::max(2.0 * view.settings.search_radius_px, 3 * site_.sigma_px()), kMaxWide_px));
  member_.window_side_px = kPatchSide_px + 2 * radius_px;
  const PatchSearch search = SearchPatch(*patch_.keyframe, view.left,
                                         KeyFromNow(patch, A_, expected), expected, radius_px);
  if (search.coherence < kWideCoherence) {
    return sighting;
  }
  // The closer look asks no farther than itself.
  if (search.second_coherence > kRival * search.coherence) {
    sighting.why_not = "two places are alike";
    return sighting;
  }
  Sighting far = Look(view, patch, expected + search.shift_px, kAfterWide_px, as_before);
  return far.why_not.empty() ? far : sighting;
}

void AnchoredFeature::Keep(const SiteView& view, const PatchView& patch, const PredictedPixel& site,
                           Sighting sighting) {
  A_ = sighting.A;
  pixel_ = sighting.place;
  predicted_ = patch.pixel;
  const Eigen::Vector2d to_site = ToSite(patch);
  const double coherence = sighting.patches.coherence;
  site_.See(pixel_ + to_site, std::hypot(kSigma_px, kSigmaOfDistance * to_site.norm()) / coherence,
            site);
  fresh_coherence_ = std::max(fresh_coherence_, coherence);
  const double zoom = patch.zoom * std::sqrt(A_.determinant());
  const double change = std::max(zoom, 1 / zoom);
  const bool good = coherence >= 0.5 * (1 + view.settings.min_coherence);
  wants_anchor_ = change > kForcedAnchorZoom || (good && change > kNewAnchorZoom);
  member_.why_lost.clear();
}

void AnchoredFeature::Lose(const std::optional<PatchView>& patch, const PredictedPixel& site,
                           std::string why) {
  if (patch) {
    pixel_ += patch->pixel - predicted_;
    predicted_ = patch->pixel;
  }
  site_.Coast(site);
  wants_anchor_ = false;
  member_.why_lost = std::move(why);
}

void AnchoredFeature::Follow(const SiteView& view, const GroundPlane& plane,
                             const PredictedPixel& site, const FeatureHint& hint) {
  member_.window_centre.setConstant(NAN);
  member_.window_side_px = 0;
  const auto patch = patch_.ViewFrom(view.camera, view.X_WC_predicted, plane);
  Sighting sighting;
  sighting.why_not = "the camera is not above the ground of the site";
  if (patch) {
    sighting = Find(view, *patch, hint);
  }
  const double coherence = sighting.patches.coherence;
  member_.anchor_patch = sighting.patches.anchor;
  member_.current_patch = sighting.patches.current;
  member_.difference_patch = sighting.patches.difference;
  if (sighting.why_not.empty()) {
    Keep(view, *patch, site, std::move(sighting));
  } else {
    Lose(patch, site, std::move(sighting.why_not));
  }
  member_.coherence = member_.own_score = coherence;
  member_.pixel = pixel_;
  site_.Tell(member_);
}

void AnchoredFeature::Coast(const PinholeCamera& camera, const RigidTransform& X_WC_predicted,
                            const GroundPlane& plane, const PredictedPixel& site,
                            const std::string& why) {
  Lose(patch_.ViewFrom(camera, X_WC_predicted, plane), site, why);
  member_.coherence = member_.own_score = 0;
  member_.window_side_px = 0;
  member_.anchor_patch = member_.current_patch = member_.difference_patch = nullptr;
  member_.pixel = pixel_;
  site_.Tell(member_);
}

void AnchoredFeature::CutAnchor(std::shared_ptr<const ImageU8> picture,
                                const RigidTransform& X_WC_predicted) {
  patch_ = {std::move(picture), X_WC_predicted, pixel_};
  site_key_ = site_.pixel();
  predicted_ = pixel_;
  A_.setIdentity();
  fresh_coherence_ = 0;
  wants_anchor_ = false;
  ++member_.anchors;
}

}  // namespace palace
