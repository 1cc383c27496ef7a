#include "engine/tracking/feature_follower.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "engine/core/rounding.h"
#include "engine/core/text.h"
#include "engine/tracking/coherence.h"

namespace palace {
namespace {

constexpr float kMinVariance = 1.0F;     // grey levels squared, as in coherence.cpp
constexpr float kMinEigenvalue = 0.02F;  // (grey levels per px) squared: below it, only noise
constexpr double kNewAnchorScale = 1.4;
// The view changes over seconds, a hand comes in within a few pictures.
constexpr std::size_t kSlowPictures = 10;
constexpr double kSlowFall = 0.05;
constexpr int kCoastPictures = 15;
constexpr std::size_t kVelocityPictures = 5;
constexpr double kRival = 0.9;         // of the best score; beyond it two places are alike
constexpr double kSurroundings = 0.8;  // of the least coherence, in a square of twice the side
constexpr double kSuddenFall = 0.15;   // of coherence, from one picture to the next
constexpr int kIterations = 12;
constexpr double kConverged_px = 0.005;
constexpr double kDamping = 1e-3;     // an edge alone leaves one direction open
constexpr double kLargestStep = 1.3;  // of scale, from one picture to the next

cv::Mat View(const ImageU8& picture) {
  return {picture.height(), picture.width(), CV_8U,
          const_cast<std::uint8_t*>(picture.pixels().data())};
}

Eigen::Matrix2d Turn(double angle_rad) { return Eigen::Rotation2Dd(angle_rad).toRotationMatrix(); }

/// Square of `side` whose offset d from the middle shows centre + scale R(angle) d; beyond the
/// picture the edge is repeated.
ImageU8 Sampled(const ImageU8& picture, const Eigen::Vector2d& centre, double scale,
                double angle_rad, int side) {
  const Eigen::Matrix2d A = scale * Turn(angle_rad);
  const Eigen::Vector2d t = centre - A * Eigen::Vector2d::Constant(0.5 * (side - 1));
  const cv::Matx23d source(A(0, 0), A(0, 1), t.x(), A(1, 0), A(1, 1), t.y());
  ImageU8 square(side, side);
  cv::Mat out = View(square);
  cv::warpAffine(View(picture), out, source, out.size(), cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                 cv::BORDER_REPLICATE);
  return square;
}

/// A smoothed part of a picture, sampled between pixels; beyond it the edge is repeated. Bilinear
/// weights of unsmoothed pixels pull towards whole and half places.
class SmoothPart {
 public:
  SmoothPart(const ImageU8& picture, const Eigen::Vector2d& centre, double reach_px) {
    const cv::Rect whole(0, 0, picture.width(), picture.height());
    const int reach = static_cast<int>(std::ceil(reach_px)) + 2;
    cv::Rect part(static_cast<int>(std::lround(centre.x())) - reach,
                  static_cast<int>(std::lround(centre.y())) - reach, 2 * reach + 1, 2 * reach + 1);
    part &= whole;
    if (part.empty()) {
      part = whole;
    }
    origin_ = Eigen::Vector2d(part.x, part.y);
    cv::Mat grey;
    View(picture)(part).convertTo(grey, CV_32F);
    cv::GaussianBlur(grey, smooth_, cv::Size(5, 5), 1.1);
  }

  float At(const Eigen::Vector2d& pixel) const {
    const double x = std::clamp(pixel.x() - origin_.x(), 0.0, smooth_.cols - 1.0);
    const double y = std::clamp(pixel.y() - origin_.y(), 0.0, smooth_.rows - 1.0);
    const int x0 = std::min(static_cast<int>(x), std::max(smooth_.cols - 2, 0));
    const int y0 = std::min(static_cast<int>(y), std::max(smooth_.rows - 2, 0));
    const float a = static_cast<float>(x - x0), b = static_cast<float>(y - y0);
    const float* row = smooth_.ptr<float>(y0) + x0;
    const float* next = smooth_.ptr<float>(std::min(y0 + 1, smooth_.rows - 1)) + x0;
    const int right = x0 + 1 < smooth_.cols ? 1 : 0;
    const float top = row[0] + a * (row[right] - row[0]);
    const float bottom = next[0] + a * (next[right] - next[0]);
    return top + b * (bottom - top);
  }

 private:
  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  cv::Mat smooth_;
};

Eigen::Vector2d Offset(int i, int side) {
  return {i % side - 0.5 * (side - 1), i / side - 0.5 * (side - 1)};
}

/// To mean 0 and length 1; the length that it had, or nothing where the ground is even.
std::optional<float> Normalise(Eigen::VectorXf& values) {
  values.array() -= values.mean();
  const float length = values.norm();
  if (length * length <= kMinVariance * static_cast<float>(values.size())) {
    return std::nullopt;
  }
  values /= length;
  return length;
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

bool FeatureFollower::MakeAnchor(const ImageU8& picture, const Placement& at, int side,
                                 Anchor& anchor) {
  const SmoothPart smooth(picture, at.place, side);
  const int count = side * side;
  Eigen::VectorXf values(count);
  Eigen::Matrix<float, 4, Eigen::Dynamic> lean(4, count);
  Eigen::Matrix2f gradients = Eigen::Matrix2f::Zero();
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector2d d = Offset(i, side), pixel = at.place + d;
    values(i) = smooth.At(pixel);
    const Eigen::Vector2f g(0.5F * (smooth.At(pixel + Eigen::Vector2d::UnitX()) -
                                    smooth.At(pixel - Eigen::Vector2d::UnitX())),
                            0.5F * (smooth.At(pixel + Eigen::Vector2d::UnitY()) -
                                    smooth.At(pixel - Eigen::Vector2d::UnitY())));
    const Eigen::Vector2f o = d.cast<float>();
    lean.col(i) << g.x(), g.y(), g.dot(o), g.y() * o.x() - g.x() * o.y();
    gradients += g * g.transpose();
  }
  const auto length = Normalise(values);
  const float weakest =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix2f>(gradients / static_cast<float>(count))
          .eigenvalues()(0);
  if (!length || weakest < kMinEigenvalue) {
    return false;
  }
  // What gain and offset of the exposure can explain is no sign of motion.
  lean /= *length;
  lean.colwise() -= lean.rowwise().mean().eval();
  lean -= (lean * values) * values.transpose();
  Eigen::Matrix4d hessian = (lean * lean.transpose()).cast<double>();
  hessian.diagonal() *= 1 + kDamping;
  anchor.picture = picture;
  anchor.centre = at.place;
  anchor.scale *= at.scale;
  anchor.angle_rad += at.angle_rad;
  anchor.values = std::move(values);
  anchor.inverse = hessian.inverse();
  anchor.lean = std::move(lean);
  return anchor.inverse.allFinite();
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

double FeatureFollower::Coherence(const ImageU8& picture, const Placement& at, int side) const {
  return ComparePatches(Sampled(anchor_.picture, anchor_.centre, 1, 0, side),
                        Sampled(picture, at.place, at.scale, at.angle_rad, side))
      .coherence;
}

FeatureFollower::Placement FeatureFollower::Refined(const ImageU8& picture,
                                                    const Placement& start) const {
  const int side = options_.template_px;
  const SmoothPart smooth(picture, start.place, start.scale * side);
  Placement at = start;
  Eigen::VectorXf now(side * side);
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const Eigen::Matrix2d A = at.scale * Turn(at.angle_rad);
    for (int i = 0; i < side * side; ++i) {
      now(i) = smooth.At(at.place + A * Offset(i, side));
    }
    if (!Normalise(now)) {
      return start;
    }
    const Eigen::Vector4d step =
        anchor_.inverse * (anchor_.lean * (now - anchor_.values)).cast<double>();
    at.place -= A * step.head<2>();
    at.scale *= std::exp(-step(2));
    at.angle_rad -= step(3);
    if ((at.place - start.place).norm() > side / 4.0 ||
        std::abs(std::log(at.scale / start.scale)) > std::log(kLargestStep)) {
      return start;
    }
    if (step.head<2>().norm() + side / 2.0 * step.tail<2>().norm() < kConverged_px) {
      break;
    }
  }
  return at;
}

std::string FeatureFollower::WhyNotTheSame(const ImageU8& picture, const TemplateMatch& match,
                                           const Placement& at) const {
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
                                                const Eigen::Vector2d& expected,
                                                int radius_px) const {
  const int side = options_.template_px;
  const int reach = radius_px + side / 2;
  cv::Rect part(static_cast<int>(std::lround(expected.x())) - reach,
                static_cast<int>(std::lround(expected.y())) - reach, 2 * reach + 1, 2 * reach + 1);
  part &= cv::Rect(0, 0, picture.width(), picture.height());
  Sighting sighting;
  sighting.at = at_;
  if (part.width < side || part.height < side) {
    sighting.why_not = "the window lies outside the picture";
    return sighting;
  }
  ImageU8 window(part.width, part.height);
  View(picture)(part).copyTo(View(window));
  const ImageU8 wanted =
      Sampled(anchor_.picture, anchor_.centre, 1 / at_.scale, -at_.angle_rad, side);
  const TemplateMatch match = MatchTemplate(window, wanted);
  sighting.at.place = Eigen::Vector2d(part.x, part.y) + match.corner.cast<double>() +
                      Eigen::Vector2d::Constant(side / 2);
  sighting.coherence = Coherence(picture, sighting.at, side);
  const Placement refined = Refined(picture, sighting.at);
  const double better = Coherence(picture, refined, side);
  if (better >= sighting.coherence) {
    sighting.at = refined;
    sighting.coherence = better;
  }
  if (sighting.coherence < options_.min_coherence) {
    sighting.why_not = WithNumbers("coherence %.2f, limit %.2f",
                                   ShownBeyond(sighting.coherence, options_.min_coherence, 2),
                                   options_.min_coherence);
  } else if (lost_ > 0 ||
             (!coherences_.empty() && coherences_.back() - sighting.coherence > kSuddenFall)) {
    sighting.why_not = WhyNotTheSame(picture, match, sighting.at);
  }
  return sighting;
}

bool FeatureFollower::NeedsAnchor(const Sighting& sighting) const {
  const double good = 0.5 * (1 + options_.min_coherence);
  if (!options_.update || sighting.coherence < good) {
    return false;
  }
  if (std::abs(std::log(sighting.at.scale)) >= std::log(kNewAnchorScale)) {
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
    coherences_.clear();
  }
  lost_ = 0;
  at_ = sighting.at;
  coasted_ = at_.place;
  places_.push_back(at_.place);
  if (places_.size() > kVelocityPictures) {
    places_.pop_front();
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
  const Sighting sighting = Look(picture, coasted_, radius);
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
