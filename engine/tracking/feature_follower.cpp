#include "engine/tracking/feature_follower.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/core/rounding.h"
#include "engine/core/text.h"
#include "engine/tracking/anchor_zoom.h"
#include "engine/tracking/coherence.h"
#include "engine/tracking/picture_part.h"

namespace palace {
namespace {

// The view changes over seconds, a hand comes in within a few pictures.
constexpr std::size_t kSlowPictures = 10;
constexpr double kSlowFall = 0.05;
constexpr int kCoastPictures = 15;
constexpr std::size_t kVelocityPictures = 5;
constexpr std::size_t kScalePictures = 15;
constexpr double kScaleStep = 0.1;     // of its logarithm, within what a fit reaches
constexpr double kRival = 0.9;         // of the best score; beyond it two places are alike
constexpr double kSurroundings = 0.8;  // of the least coherence, in a square of twice the side
constexpr double kSuddenFall = 0.15;   // of coherence, from one picture to the next
// What covers a part agrees best with the template where it draws the whole along.
constexpr double kCoveredFall = 0.1;
// From two fifths on what covers decides where the template lies.
constexpr double kSeen = 0.7;
// Taken up again as well as it was seen before; in a second or two the view may have changed.
constexpr double kForgottenAPicture = 0.01;

/// Square of `side` whose offset d from the middle shows at.place + scale R(angle) d.
ImageU8 Sampled(const ImageU8& picture, const TemplatePlacement& at, int side) {
  Eigen::Matrix3d source = Eigen::Matrix3d::Identity();
  source.topLeftCorner<2, 2>() = at.Linear();
  source.topRightCorner<2, 1>() = at.place;
  return WarpedSquare(picture, source, Eigen::Vector2d::Zero(), side);
}

bool TemplateFits(const ImageU8& picture, const Eigen::Vector2d& place, int side) {
  const double half = 0.5 * (side - 1);
  return place.x() >= half && place.y() >= half && place.x() <= picture.width() - 1 - half &&
         place.y() <= picture.height() - 1 - half;
}

}  // namespace

Status CheckFollowerOptions(const FollowerOptions& options) {
  const int side = options.template_px;
  if (side < 11 || side > 101 || side % 2 == 0) {
    return UsageError("template " + std::to_string(side) + " px: must be odd, 11 to 101 px");
  }
  if (options.search_px < 4 || options.search_px > 128) {
    return UsageError("search " + std::to_string(options.search_px) + " px: must be 4 to 128 px");
  }
  if (!(options.min_coherence >= 0.1 && options.min_coherence <= 0.99)) {
    return UsageError("least coherence " + NumberText(options.min_coherence) +
                      ": must be 0.1 to 0.99");
  }
  return Ok();
}

bool FeatureFollower::MakeAnchor(const ImageU8& picture, const TemplatePlacement& at, int side,
                                 Anchor& anchor) {
  auto values = TemplateAnchor::Make(picture, at.place, side);
  if (!values) {
    return false;
  }
  anchor.values = std::move(*values);
  anchor.picture = picture;
  anchor.centre = at.place;
  anchor.scale *= at.scale;
  anchor.angle_rad += at.angle_rad;
  return true;
}

Result<FeatureFollower> FeatureFollower::Start(const ImageU8& picture, const Eigen::Vector2d& pixel,
                                               const FollowerOptions& options) {
  if (const Status fine = CheckFollowerOptions(options); !fine) {
    return fine.error();
  }
  const int side = options.template_px;
  const std::string where = WithNumbers("feature %.10g,%.10g", pixel.x(), pixel.y());
  if (!pixel.allFinite() || !TemplateFits(picture, pixel, side)) {
    const int half = side / 2;
    const int right = picture.width() - 1 - half, bottom = picture.height() - 1 - half;
    const std::string size = WithNumbers("%.0f x %.0f px", picture.width(), picture.height());
    if (right < half || bottom < half) {
      return UsageError(WithNumbers("template %.0f px", side) +
                        ": does not fit into a picture of " + size);
    }
    return UsageError(
        where + WithNumbers(": a template of %.0f px needs x %.0f to %.0f px", side, half, right) +
        WithNumbers(", y %.0f to %.0f px", half, bottom) + " in a picture of " + size);
  }
  FeatureFollower follower;
  follower.options_ = options;
  follower.at_.place = pixel;
  follower.coasted_ = pixel;
  follower.places_ = {pixel};
  follower.log_scales_ = {0};
  follower.coherences_ = {1};
  if (!MakeAnchor(picture, follower.at_, side, follower.anchor_)) {
    return UsageError(where +
                      ": the picture is too even there to be followed; choose a place that "
                      "changes in both directions");
  }
  return follower;
}

FollowedFeature FeatureFollower::first() const {
  FollowedFeature told;
  told.pixel = anchor_.centre;
  told.coherence = 1;
  told.window_centre = anchor_.centre;
  told.window_side_px = options_.template_px + 2 * options_.search_px;
  return told;
}

double FeatureFollower::Coherence(const ImageU8& picture, const TemplatePlacement& at,
                                  int side) const {
  return ComparePatches(Sampled(anchor_.picture, {anchor_.centre}, side),
                        Sampled(picture, at, side))
      .coherence;
}

std::string FeatureFollower::WhyNotTheSame(const ImageU8& picture, const TemplateMatch& match,
                                           const TemplatePlacement& at) const {
  if (match.second_score > kRival * match.score) {
    return WithNumbers("two places are alike, correlation %.2f and %.2f", match.score,
                       match.second_score);
  }
  const int side = 2 * options_.template_px + 1;
  const double least = kSurroundings * options_.min_coherence;
  if (TemplateFits(picture, at.place, side) &&
      TemplateFits(anchor_.picture, anchor_.centre, side)) {
    if (const double around = Coherence(picture, at, side); around < least) {
      return WithNumbers("what lies around differs, coherence %.2f, limit %.2f",
                         ShownBeyond(around, least, 2), least);
    }
  }
  return {};
}

FeatureFollower::Sighting FeatureFollower::Look(const ImageU8& picture,
                                                const TemplatePlacement& expected,
                                                int radius_px) const {
  const int side = options_.template_px;
  const PictureWindow window = CutWindow(picture, expected.place, radius_px + side / 2);
  Sighting sighting;
  sighting.at = expected;
  if (window.picture.width() < side || window.picture.height() < side) {
    sighting.why_not = "the window lies outside the picture";
    return sighting;
  }
  const ImageU8 wanted =
      Sampled(anchor_.picture, {anchor_.centre, 1 / expected.scale, -expected.angle_rad}, side);
  const TemplateMatch match = MatchTemplate(window.picture, wanted);
  sighting.at.place =
      (window.corner + match.corner).cast<double>() + Eigen::Vector2d::Constant(side / 2);
  sighting.coherence = Coherence(picture, sighting.at, side);
  double seen = 0;
  if (const auto fit = anchor_.values.Refined(picture, sighting.at)) {
    seen = fit->seen;
    const double refined = Coherence(picture, fit->at, side);
    if (refined >= sighting.coherence - kCoveredFall) {
      sighting.at = fit->at;
      sighting.coherence = refined;
    }
  }
  const double least =
      sighting.coherence < options_.min_coherence ? options_.min_coherence : LeastCoherence();
  if (sighting.coherence < least) {
    sighting.why_not =
        WithNumbers("coherence %.2f, limit %.2f", ShownBeyond(sighting.coherence, least, 2), least);
  } else if (seen < kSeen) {
    sighting.why_not = WithNumbers("%.0f %% of the template is seen, limit %.0f %%",
                                   ShownBeyond(100 * seen, 100 * kSeen, 0), 100 * kSeen);
  } else if (lost_ > 0 ||
             (!coherences_.empty() && coherences_.back() - sighting.coherence > kSuddenFall)) {
    sighting.why_not = WhyNotTheSame(picture, match, sighting.at);
  }
  return sighting;
}

double FeatureFollower::SoughtScale() const {
  if (lost_ == 0 || log_scales_.size() < 2) {
    return at_.scale;
  }
  const double a_picture =
      (log_scales_.back() - log_scales_.front()) / static_cast<double>(log_scales_.size() - 1);
  const double most = std::log(kForcedAnchorZoom);
  const double grown = std::clamp(a_picture * (lost_ + 1), -most, most);
  const std::array offsets = {grown, grown + kScaleStep, grown - kScaleStep, 0.0};
  return at_.scale * std::exp(offsets[static_cast<std::size_t>(lost_) % offsets.size()]);
}

double FeatureFollower::LeastCoherence() const {
  return lost_ == 0 ? options_.min_coherence
                    : std::max(options_.min_coherence,
                               fresh_coherence_ - kSuddenFall - kForgottenAPicture * lost_);
}

bool FeatureFollower::NeedsAnchor(const Sighting& sighting) const {
  const double good = 0.5 * (1 + options_.min_coherence);
  if (!options_.update || sighting.coherence < good) {
    return false;
  }
  if (std::abs(std::log(sighting.at.scale)) >= std::log(kNewAnchorZoom)) {
    return true;
  }
  const bool sunk = fresh_coherence_ - sighting.coherence > kSlowFall;
  const bool slowly =
      coherences_.size() > kSlowPictures && coherences_.front() - sighting.coherence < kSlowFall;
  return sunk && slowly;
}

void FeatureFollower::Keep(const ImageU8& picture, const Sighting& sighting) {
  if (lost_ > 0) {
    places_.clear();
    log_scales_.clear();
    coherences_.clear();
  }
  lost_ = 0;
  at_ = sighting.at;
  coasted_ = at_.place;
  places_.push_back(at_.place);
  if (places_.size() > kVelocityPictures) {
    places_.pop_front();
  }
  log_scales_.push_back(std::log(anchor_.scale * at_.scale));
  if (log_scales_.size() > kScalePictures) {
    log_scales_.pop_front();
  }
  velocity_px_ = places_.size() < 2 ? Eigen::Vector2d::Zero().eval()
                                    : Eigen::Vector2d((places_.back() - places_.front()) /
                                                      static_cast<double>(places_.size() - 1));
  fresh_coherence_ = std::max(fresh_coherence_, sighting.coherence);
  coherences_.push_back(sighting.coherence);
  if (coherences_.size() > kSlowPictures + 1) {
    coherences_.pop_front();
  }
  if (NeedsAnchor(sighting) && TemplateFits(picture, at_.place, options_.template_px) &&
      MakeAnchor(picture, at_, options_.template_px, anchor_)) {
    at_ = {at_.place, 1, 0};
    ++anchors_;
    coherences_ = {1};
    fresh_coherence_ = 0;
  }
}

FollowedFeature FeatureFollower::Follow(const ImageU8& picture) {
  PALACE_CHECK(
      picture.width() == anchor_.picture.width() && picture.height() == anchor_.picture.height(),
      picture.width(), picture.height());
  if (lost_ < kCoastPictures) {
    const Eigen::Vector2d corner(picture.width() - 1, picture.height() - 1);
    coasted_ = (coasted_ + velocity_px_).cwiseMax(0).cwiseMin(corner);
  }
  const int radius = std::min(options_.search_px + lost_ * std::max(options_.search_px / 4, 1),
                              std::max(picture.width(), picture.height()));
  const Sighting sighting = Look(picture, {coasted_, SoughtScale(), at_.angle_rad}, radius);
  FollowedFeature told;
  told.window_centre = coasted_;
  told.window_side_px = options_.template_px + 2 * radius;
  told.coherence = sighting.coherence;
  told.scale = anchor_.scale * at_.scale;
  told.angle_rad = anchor_.angle_rad + at_.angle_rad;
  if (sighting.why_not.empty()) {
    told.state = lost_ > 0 ? FollowState::kReacquired : FollowState::kFollowed;
    Keep(picture, sighting);
    told.scale = anchor_.scale * at_.scale;
    told.angle_rad = anchor_.angle_rad + at_.angle_rad;
  } else {
    told.state = FollowState::kLost;
    told.why_lost = sighting.why_not;
    ++lost_;
  }
  told.pixel = coasted_;
  told.pictures_lost = lost_;
  told.anchors = anchors_;
  return told;
}

}  // namespace palace
