// Handover: when the vision filter may replace the GPS filter, and whether it still may be flown
// on.
//
//   kGps -> kSettling  vision started
//   kSettling -> kReady  2 s of accepted fixes without a gap over 0.5 s, mean normalised innovation
//                        squared <= 3 + 3 sqrt(6/N), fixes at most 5 times as rough as they
//                        state, |v_vision - v_gps| < 0.3 m/s
//   kReady -> kVision  allowed (the vehicle accepted the approval)
//   kReady -> kSettling  a condition no longer holds
// kVision ends only by Stop. Lost: no accepted fix for 0.5 s, or 5 rejections in a row.
// After reference simulation.md 4.2.
#pragma once

#include <deque>
#include <string>

#include "engine/core/time.h"
#include "engine/model/navigation_status.h"

namespace palace {

/// One fix, as the vision filter judged it.
struct HandoverSample {
  Timestamp time;
  bool accepted = false;
  double nis = 0;               ///< scaled to three degrees of freedom
  double velocity_gap_mps = 0;  ///< |v_vision - v_gps|; 0 when there is no GPS
  double variance_factor = 1;   ///< that the filter widens fixes by (position_filter.h)
};

class Handover {
 public:
  using State = NavigationStatus::Handover;

  void Start(Timestamp time);
  void Stop();
  void Allow(bool allowed) { allowed_ = allowed; }
  /// A fix that was judged.
  void AddFix(const HandoverSample& sample);
  /// Time passed, with or without a fix. True when this call switched to vision.
  bool Advance(Timestamp now);

  State state() const { return state_; }
  /// What it waits for, in words; empty in kGps.
  const std::string& reason() const { return reason_; }
  /// Vision delivers: flown on or not, its estimate may be trusted at `now`.
  bool Healthy(Timestamp now) const;

 private:
  std::string WaitingFor(Timestamp now) const;

  State state_ = State::kGps;
  bool allowed_ = false;
  std::string reason_;
  Timestamp started_;
  Timestamp settled_since_;
  Timestamp last_accepted_;
  int rejected_in_row_ = 0;
  std::deque<HandoverSample> samples_;
};

}  // namespace palace
