#include "engine/tracking/tracker_set.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/tracking/anchor_zoom.h"
#include "engine/tracking/coherence.h"
#include "engine/tracking/landing_features.h"
#include "engine/tracking/tracker_consensus.h"

namespace palace {
namespace {

constexpr int kFeatures = 4;
constexpr int kDriftPictures = 3;
constexpr int kReplaceAfterDrift = 10;  // pictures
constexpr double kReplaceAfterLost_s = 3;
constexpr int kChooseEvery = 5;  // pictures: choosing costs as much as following
constexpr double kPlaneSigma_px = 0.3, kTemplateSigma_px = 0.5;
constexpr double kMargin_px = kPatchSide_px / 2;

TrackerMember Named(TrackerMember::Kind kind, const char* name, bool in_force) {
  TrackerMember member;
  member.kind = kind;
  member.name = name;
  member.in_force = in_force;
  return member;
}

/// In the picture, with the ground around it that is compared.
bool IsWhole(const PinholeCamera& camera, const Eigen::Vector2d& pixel) {
  return pixel.allFinite() && InPicture(camera, pixel, kMargin_px);
}

}  // namespace

TrackerSet::TrackerSet(const SiteView& view, const LandingSite& site)
    : mode_(view.settings.mode), site_(site), plane_{site.p_WS, site.normal_W.normalized()} {
  plane_tracker_.Lock(view.left, view.camera, view.X_WC_predicted, view.range, site, view.settings);
  // What the ranges said of the height holds for all but a template in force: navigation goes by
  // its word alone.
  const RigidTransform X_WC = plane_tracker_.Corrected(view.X_WC_predicted);
  const SiteView corrected{view.left, view.camera, X_WC, view.range, view.settings, view.time};
  const PredictedPixel predicted = Predicted(view.camera, X_WC, view.settings, view.time);
  predicted_ = predicted.pixel;
  if (mode_ == TrackerMode::kTemplate) {
    template_tracker_.Lock(view.left, view.camera, view.X_WC_predicted, site, view.settings);
  } else {
    template_tracker_.LockAt(predicted.pixel, view.left, view.camera, view.X_WC_predicted, site,
                             view.settings);
  }
  plane_told_.member = Named(TrackerMember::Kind::kPlane, "Plane", mode_ == TrackerMode::kPlane);
  template_told_.member =
      Named(TrackerMember::Kind::kTemplate, "Template", mode_ == TrackerMode::kTemplate);
  template_told_.member.anchors = 1;
  for (CoastedPixel* pixel : {&plane_told_.site, &template_told_.site, &consensus_}) {
    pixel->Start(predicted);
  }
  ReplaceFeatures(corrected, predicted, predicted.pixel, kFeatures);
  CutSiteAnchor(corrected, predicted.pixel);
  copy_.reset();
}

bool TrackerSet::anchored() const {
  return mode_ == TrackerMode::kPlane ? plane_tracker_.anchored() : template_tracker_.anchored();
}

bool TrackerSet::locked() const {
  return mode_ == TrackerMode::kPlane ? plane_tracker_.locked() : template_tracker_.locked();
}

PredictedPixel TrackerSet::Predicted(const PinholeCamera& camera, const RigidTransform& X_WC,
                                     const TrackingSettings& settings, Timestamp time) const {
  PredictedPixel predicted;
  predicted.pixel = PixelFromWorldPoint(camera, X_WC, plane_.p_WS).value_or(predicted_);
  predicted.pixels_per_metre = camera.fx_px / std::max((X_WC.p - plane_.p_WS).norm(), 0.5);
  predicted.accel_noise_mps2 = settings.accel_noise_mps2;
  predicted.time = time;
  return predicted;
}

void TrackerSet::Describe(const TrackerStatus& status, double sigma_px, const PredictedPixel& site,
                          Told& told) {
  TrackerMember& member = told.member;
  if (status.locked) {
    told.site.See(status.site_pixel, sigma_px, site);
  } else {
    told.site.Coast(site);
  }
  told.site.Tell(member);
  member.why_lost = status.why_not_locked;
  member.coherence = member.own_score = status.coherence;
  member.pixel = member.site_pixel;
  member.window_centre = status.window_centre;
  member.window_side_px = status.window_side_px;
  member.anchor_patch = status.anchor_patch;
  member.current_patch = status.current_patch;
  member.difference_patch = status.difference_patch;
}

void TrackerSet::CompareTemplate(const SiteView& view) {
  TrackerMember& member = template_told_.member;
  member.coherence = 0;
  if (!member.followed() || !site_anchor_.keyframe || !IsWhole(view.camera, member.pixel)) {
    return;
  }
  const auto patch = site_anchor_.ViewFrom(view.camera, view.X_WC_predicted, plane_);
  if (!patch) {
    return;
  }
  const PatchComparison patches =
      ComparePatches(*site_anchor_.keyframe, view.left,
                     KeyFromNow(*patch, Eigen::Matrix2d::Identity(), member.pixel), member.pixel);
  member.coherence = patches.coherence;
  member.anchor_patch = patches.anchor;
  member.current_patch = patches.current;
  member.difference_patch = patches.difference;
}

void TrackerSet::FollowFeatures(const SiteView& view, const PredictedPixel& site) {
  FeatureHint hint;
  hint.site_pixel = plane_told_.member.followed() ? plane_told_.member.site_pixel
                                                  : consensus_.CarriedTo(site.pixel);
  std::size_t turn = static_cast<std::size_t>(pictures_);
  for (std::size_t i = 0; i < features_.size(); ++i) {
    hint.may_look_wide = i == turn % features_.size();
    features_[i].tracker.Follow(view, plane_, site, hint);
  }
}

TrackerSetStatus TrackerSet::Agree(const PredictedPixel& site) {
  TrackerSetStatus status;
  status.time = site.time;
  status.members = {plane_told_.member, template_told_.member};
  for (const Feature& feature : features_) {
    status.members.push_back(feature.tracker.member());
  }
  const std::vector<TrackerMember> members = status.members;  // who drifts still has its say
  const auto judge = [&](std::size_t i, int& beyond) {
    TrackerMember& member = status.members[i];
    member.disagreement_px = DisagreementOf(members, i);
    const bool is_beyond = member.disagreement_px > TrackerSetStatus::kDrift_px;
    beyond = is_beyond && OthersAgree(members, i) ? beyond + 1 : 0;
    member.drifts = beyond >= kDriftPictures;
  };
  judge(0, plane_told_.beyond);
  judge(1, template_told_.beyond);
  for (std::size_t i = 0; i < features_.size(); ++i) {
    judge(i + 2, features_[i].beyond);
  }
  status.consensus = ConsensusOf(status.members);
  ShareWeights(status.consensus, status.members);
  status.disagreement = DisagreementWords(status.members);
  if (status.consensus.agreeing > 0) {
    consensus_.See(status.consensus.site_pixel, status.consensus.sigma_px, site);
  } else {
    consensus_.Coast(site);
    status.consensus.site_pixel = consensus_.pixel();
    status.consensus.sigma_px = consensus_.sigma_px();
  }
  return status;
}

const std::shared_ptr<const ImageU8>& TrackerSet::Copy(const ImageU8& left) {
  if (!copy_) {
    copy_ = std::make_shared<const ImageU8>(left);
  }
  return copy_;
}

void TrackerSet::CutSiteAnchor(const SiteView& view, const Eigen::Vector2d& site_pixel) {
  if (IsWhole(view.camera, site_pixel)) {
    site_anchor_ = {Copy(view.left), view.X_WC_predicted, site_pixel};
  }
}

void TrackerSet::ReplaceFeatures(const SiteView& view, const PredictedPixel& site,
                                 const Eigen::Vector2d& site_pixel, int count) {
  std::vector<Eigen::Vector2d> taken;
  for (const Feature& feature : features_) {
    taken.push_back(feature.tracker.member().pixel);
  }
  for (const Eigen::Vector2d& pixel :
       ChooseLandingFeatures(view, plane_, site_pixel, taken, count)) {
    const KeyPatch patch{Copy(view.left), view.X_WC_predicted, pixel};
    features_.push_back({AnchoredFeature(++features_made_, patch, site_pixel, site)});
  }
}

void TrackerSet::RestartTemplate(const SiteView& view, const Eigen::Vector2d& site_pixel) {
  if (mode_ != TrackerMode::kTemplate && !template_tracker_.locked() &&
      IsWhole(view.camera, site_pixel)) {
    template_tracker_.LockAt(site_pixel, view.left, view.camera, view.X_WC_predicted, site_,
                             view.settings);
    ++template_told_.member.anchors;
  }
}

void TrackerSet::Renew(const SiteView& view, const PredictedPixel& site,
                       const TrackerSetStatus& status) {
  for (Feature& feature : features_) {
    if (feature.tracker.wants_anchor() && feature.beyond == 0) {
      feature.tracker.CutAnchor(Copy(view.left), view.X_WC_predicted);
    }
  }
  if (!status.consensus.trusted) {
    return;
  }
  const Eigen::Vector2d& site_pixel = status.consensus.site_pixel;
  const auto patch = site_anchor_.keyframe
                         ? site_anchor_.ViewFrom(view.camera, view.X_WC_predicted, plane_)
                         : std::nullopt;
  if (!patch || std::abs(std::log(patch->zoom)) > std::log(kNewAnchorZoom)) {
    CutSiteAnchor(view, site_pixel);
  }
  std::erase_if(features_, [&](const Feature& feature) {
    const TrackerMember& member = feature.tracker.member();
    return feature.beyond >= kReplaceAfterDrift || member.lost_s > kReplaceAfterLost_s ||
           !IsWhole(view.camera, member.pixel);
  });
  if (static_cast<int>(features_.size()) < kFeatures && pictures_ % kChooseEvery == 0) {
    ReplaceFeatures(view, site, site_pixel, 1);
  }
}

TrackResult TrackerSet::Track(const SiteView& view) {
  ++pictures_;
  TrackResult plane = plane_tracker_.Track(view.left, view.camera, view.X_WC_predicted, view.range,
                                           view.settings, view.time);
  TrackResult by_template = template_tracker_.Track(view.left, view.camera, view.X_WC_predicted,
                                                    view.settings, view.time);
  // What plane and prediction know together, for all that is warped from here on.
  const RigidTransform X_WC = plane_tracker_.Corrected(view.X_WC_predicted);
  const SiteView corrected{view.left, view.camera, X_WC, view.range, view.settings, view.time};
  const PredictedPixel site = Predicted(view.camera, X_WC, view.settings, view.time);
  predicted_ = site.pixel;
  Describe(plane.status, kPlaneSigma_px, site, plane_told_);
  plane_told_.member.anchors = plane.status.keyframes;
  Describe(by_template.status, kTemplateSigma_px, site, template_told_);
  CompareTemplate(corrected);
  FollowFeatures(corrected, site);
  TrackResult result = std::move(mode_ == TrackerMode::kPlane ? plane : by_template);
  result.set = Agree(site);
  if (result.set.consensus.trusted) {
    RestartTemplate(view, result.set.consensus.site_pixel);
  }
  Renew(corrected, site, result.set);
  copy_.reset();
  return result;
}

TrackerSetStatus TrackerSet::Coast(const PinholeCamera& camera,
                                   const RigidTransform& X_WC_predicted,
                                   const TrackingSettings& settings, const std::string& why,
                                   Timestamp time) {
  const RigidTransform X_WC = plane_tracker_.Corrected(X_WC_predicted);
  const PredictedPixel site = Predicted(camera, X_WC, settings, time);
  predicted_ = site.pixel;
  TrackerStatus nothing;
  nothing.why_not_locked = why;
  nothing.window_centre.setConstant(NAN);
  Describe(nothing, 0, site, plane_told_);
  Describe(nothing, 0, site, template_told_);
  for (Feature& feature : features_) {
    feature.tracker.Coast(camera, X_WC, plane_, site, why);
  }
  return Agree(site);
}

}  // namespace palace
