#include "engine/navigation/laser_watch.h"

#include <algorithm>
#include <cmath>

namespace palace {
namespace {

constexpr int kLearned = 40;          // returns before noise is known to change them
constexpr double kMostRepeats = 0.5;  // share of them that equal the one before
constexpr int kLeastSame = 8;
constexpr double kSameHeight_m = 0.3;
constexpr double kStep_m = 1;
constexpr int kStepRun = 3;
constexpr double kStepUnseen_s = 1;  // no stereo for so long: the new level is believed
constexpr double kStereoFresh_s = 0.4;
constexpr double kClimb_m = 2, kLaserScale = 0.2, kStereoScale = 0.12;
constexpr double kReferenceKept_s = 20;

bool Near(double a, double b, double share) { return std::abs(a - b) <= share * std::abs(b); }

}  // namespace

double LaserWatch::Expected(const Seen& seen) const {
  return level_->over_spot_m + (seen.camera_height_m - level_->camera_height_m);
}

bool LaserWatch::StereoIsFresh(Timestamp now) const {
  return stereo_ && std::abs(SecondsBetween(stereo_->time, now)) <= kStereoFresh_s;
}

void LaserWatch::CallWrong(double ratio) {
  wrong_ = true;
  wrong_ratio_ = ratio;
  agree_run_ = 0;
}

void LaserWatch::AddRange(const LaserRange& range, const BeamPose& beam) {
  if (!std::isfinite(range.range_m) || !(range.range_m > 0)) {
    return;
  }
  last_return_ = range.time;
  FollowRepeats(range, beam);
  const Seen seen{range.time, range.range_m * beam.beam_down, beam.camera_height_m};
  if (std::isfinite(seen.over_spot_m) && std::isfinite(seen.camera_height_m)) {
    FollowLevel(range, seen);
  }
}

void LaserWatch::FollowRepeats(const LaserRange& range, const BeamPose& beam) {
  const bool same = previous_ && previous_->range_m == range.range_m;
  if (!same) {
    same_since_ = range.time;
    same_run_ = 0;
    same_height_m_ = beam.camera_height_m;
    stuck_ = false;
  }
  ++same_run_;
  previous_ = range;
  const bool long_enough =
      same_run_ >= kLeastSame && SecondsBetween(*same_since_, range.time) >= LaserHealth::kStuck_s;
  const bool noisy = returns_ >= kLearned && repeats_ < kMostRepeats * returns_;
  const bool moved = std::abs(beam.camera_height_m - same_height_m_) >= kSameHeight_m;
  stuck_ = long_enough && (noisy || moved || stuck_);
  if (!long_enough) {  // a run of equal ones must not teach that equal ones are usual
    ++returns_;
    repeats_ += same ? 1 : 0;
  }
}

void LaserWatch::FollowLevel(const LaserRange& range, const Seen& seen) {
  if (!level_) {
    level_ = seen;
    return;
  }
  const double expected_m = Expected(seen);
  const bool stepped =
      std::abs(seen.over_spot_m - expected_m) > std::max(kStep_m, LaserHealth::kWrong * expected_m);
  if (wrong_) {
    return;  // until stereo says otherwise
  }
  if (!stepped) {
    level_ = seen;
    step_run_ = 0;
    step_since_.reset();
    return;
  }
  step_since_ = step_since_.value_or(range.time);
  if (++step_run_ < kStepRun) {
    return;
  }
  if (StereoIsFresh(range.time)) {
    if (Near(stereo_->over_spot_m, seen.over_spot_m, LaserHealth::kAgrees)) {
      level_ = seen;
      step_run_ = 0;
    } else if (Near(stereo_->over_spot_m, expected_m, LaserHealth::kAgrees)) {
      CallWrong(seen.over_spot_m / expected_m);
    }
  } else if (SecondsBetween(*step_since_, range.time) >= kStepUnseen_s) {
    level_ = seen;
    step_run_ = 0;
  }
}

void LaserWatch::AddStereo(Timestamp time, double depth_m, const BeamPose& beam) {
  const Seen seen{time, depth_m * beam.beam_down, beam.camera_height_m};
  if (!std::isfinite(seen.over_spot_m) || !std::isfinite(seen.camera_height_m)) {
    return;
  }
  stereo_ = seen;
  if (!previous_ || std::abs(SecondsBetween(previous_->time, time)) > kStereoFresh_s) {
    return;
  }
  const Seen laser{previous_->time, previous_->range_m * beam.beam_down, beam.camera_height_m};
  if (wrong_) {
    wrong_ratio_ = laser.over_spot_m / seen.over_spot_m;
    agree_run_ =
        Near(laser.over_spot_m, seen.over_spot_m, LaserHealth::kAgrees) ? agree_run_ + 1 : 0;
    if (agree_run_ >= LaserHealth::kFinePairs) {
      wrong_ = false;
      step_run_ = 0;
      level_ = laser;
      reference_.reset();
    }
    return;
  }
  if (step_run_ == 0) {
    CompareScale(laser);
  }
}

void LaserWatch::CompareScale(const Seen& laser) {
  if (!reference_ || SecondsBetween(reference_->laser.time, laser.time) > kReferenceKept_s) {
    reference_ = Reference{laser, *stereo_};
    return;
  }
  const double climb_m = laser.camera_height_m - reference_->laser.camera_height_m;
  if (std::abs(climb_m) < kClimb_m) {
    return;
  }
  const double by_laser = (laser.over_spot_m - reference_->laser.over_spot_m) / climb_m;
  const double by_stereo = (stereo_->over_spot_m - reference_->stereo.over_spot_m) / climb_m;
  if (std::abs(by_laser - 1) > kLaserScale && std::abs(by_stereo - 1) < kStereoScale &&
      !Near(laser.over_spot_m, stereo_->over_spot_m, LaserHealth::kAgrees)) {
    CallWrong(laser.over_spot_m / stereo_->over_spot_m);
  }
  reference_ = Reference{laser, *stereo_};
}

void LaserWatch::Update(Timestamp now) {
  using State = LaserHealth::State;
  status_ = {};
  if (!last_return_) {
    return;
  }
  const double silent_s = SecondsBetween(*last_return_, now);
  if (silent_s > LaserHealth::kLost_s) {
    status_ = {State::kLost, silent_s, NAN};
    // What comes after a silence is of another place.
    level_.reset();
    step_run_ = 0;
    same_run_ = 0;
    previous_.reset();
    stuck_ = false;
  } else if (stuck_) {
    status_ = {State::kStuck, SecondsBetween(*same_since_, now), NAN};
  } else if (wrong_) {
    status_ = {State::kWrong, NAN, wrong_ratio_};
  } else {
    status_.state = State::kFine;
  }
}

}  // namespace palace
