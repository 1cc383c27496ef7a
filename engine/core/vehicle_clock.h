// VehicleClock: the vehicle's clock against this station's monotonic one, from one-way messages.
//
// A message stamped u that arrives at station time t has u - t = offset - delay, delay >= 0, so
// the offset is the upper envelope of u - t: the least delay ever seen counts as none. The
// envelope rises with the message that shows it; it falls only when messages say so, and no faster
// than a clock may drift, so that a link that slows down shows as age and not as a clock:
//
//   offset(t) = max(u - t, offset(t0) - drift_limit (t - t0))
//
// Only the channels that vote (pose, status) are followed: a stamp that fits may still be ahead by
// the limit, and again and again. The others are measured against them; they are asked only before
// the first vote and where nobody votes any more. Hear no stamps of senders that are no clock.
//
// A stamp that cannot be is refused and changes nothing: ahead of the estimate by more than the
// limit (a message cannot arrive before it was sent), or more than 10 s behind it. Only when
// several messages in a row of the channels that vote agree on another offset over
// 0.2 s, with none between them that fits the present one, has the clock stepped. A clock that
// went back is seen by stamps that do. A delay that stays the same for 10 s is taken for a step
// too: it can no longer be told from one.
//
// The drift comes from the envelope over the last minute. The clock of a simulation keeps the pace
// of its processor: it may fall behind by almost any rate, and is followed. While this machine
// stood still nothing was heard: what queued is late by our fault, by as long as it stood at most,
// and the envelope falls only for what is later than that. (Where it never fell after a stall, a
// slow simulation on a machine that stalls again and again lagged until it was taken for a step.)
//
// No clocks, no threads: every time is passed in. Source: Moon, Skelly and Towsley 1999 (envelope
// of one-way delays); limits ours.
#pragma once

#include <cmath>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>

#include "engine/core/time.h"

namespace palace {

/// What the station knew of the vehicle's clock when it handed a bundle on. Recorded with it.
struct ClockReading {
  double station_s = NAN;  ///< monotonic, of this machine: the moment that the bundle's time names
  bool estimating = true;  ///< too little was heard for ages to be trusted
  double drift_ppm = NAN;  ///< the vehicle's clock gains so much; NaN: not known yet
  double jitter_s = NAN;   ///< mean delay of the voting messages beyond the least
  double stepped_s = 0;    ///< the vehicle's clock stepped by this since the bundle before
  double stalled_s = 0;    ///< this machine did not run for so long since the bundle before
  friend bool operator==(const ClockReading&, const ClockReading&) = default;
};

class VehicleClock {
 public:
  static constexpr double kAheadLimit_s = 0.05;  ///< once the estimate is sure ...
  static constexpr double kAheadUnsure_s = 0.5;  ///< ... until then, and of a simulation's clock
  static constexpr double kBehindLimit_s = 10;
  static constexpr double kBackLimit_s = 0.3;    ///< stamps of a vote that go back by more
  static constexpr double kDriftLimit = 500e-6;  ///< s a second; quartz has 100e-6
  static constexpr double kSlowestPace = 0.1;    ///< of a simulation
  static constexpr int kVotes = 3;
  static constexpr double kVoteSpan_s = 0.2;
  static constexpr double kDeaf_s = 2;      ///< nothing fitted for so long: anybody votes
  static constexpr double kQueue_s = 3;     ///< after a stall: what queued may be read so long
  static constexpr double kLateFor_s = 10;  ///< a delay that stays is a step
  static constexpr double kLate_s = 0.25;

  enum class Heard : std::uint8_t {
    kFits,
    kAhead,    ///< refused: stamped in the future
    kBehind,   ///< refused: stamped too far in the past
    kStepped,  ///< the clock stepped; this message belongs to the new time
  };
  /// `votes`: a message of a channel that may move the clock.
  Heard Hear(Timestamp stamp, double arrival_s, bool votes);
  /// This machine did not run for so long until now; what queued meanwhile is heard next, and says
  /// nothing of how late the vehicle's clock is.
  void Stalled(double seconds, double now_s) {
    fitted_s_ += seconds;
    stalled_s_ = now_s < queue_until_s_ ? std::fmax(stalled_s_, seconds) : seconds;
    queue_until_s_ = now_s + kQueue_s;
  }
  /// Whether a stamp can be, nothing else: nothing is learned from it. Before the clock is known
  /// any can.
  bool CanBe(Timestamp stamp, double arrival_s) const;
  /// A simulation labelled so: its clock may run slow, see above.
  void FollowSimulation(bool simulated) { simulated_ = simulated; }

  bool known() const { return known_; }
  /// The vehicle's time at a station time. Only when known.
  Timestamp At(double station_s) const;
  bool estimating() const;
  /// Size of the last step; 0 before one.
  double step_s() const { return step_s_; }
  double drift_ppm() const;
  double jitter_s() const { return jitter_s_; }

 private:
  struct Suspect {
    std::int64_t offset_us = 0;
    double first_s = 0, last_s = 0;
    int votes = 0;
  };
  /// Least delay of one second.
  struct Window {
    double start_s = 0;
    std::int64_t offset_us = 0;
  };
  Heard Judge(std::int64_t offset_us, double arrival_s) const;
  void Begin(std::int64_t offset_us, double arrival_s);
  bool IsNearerSuspect(std::int64_t offset_us) const;
  Heard Doubt(std::int64_t offset_us, double arrival_s, bool votes, Heard verdict);
  Heard Step(std::int64_t offset_us, double arrival_s);
  void Follow(std::int64_t offset_us, double arrival_s);
  /// Size of a delay that stayed the same for long enough; 0: none did.
  std::int64_t StandingDelay_us(const Window& done);

  double queue_until_s_ = -std::numeric_limits<double>::infinity();
  double stalled_s_ = 0;   ///< the longest stall of what may still queue
  double followed_s_ = 0;  ///< arrival of the vote that was followed last
  bool known_ = false;
  bool voted_ = false;
  bool simulated_ = false;
  std::int64_t offset_us_ = 0;
  double began_s_ = 0;
  double fitted_s_ = 0;  ///< a message fitted last
  int fitted_ = 0;
  Timestamp newest_vote_;
  std::optional<Suspect> suspect_;
  Window window_;
  std::deque<Window> windows_;
  std::optional<Window> late_;  ///< since when, and at which level, the least delay stands
  double step_s_ = 0;
  double jitter_s_ = NAN;
};

/// StallWatch: was this thread run? Call it at each turn of a loop that never waits long.
class StallWatch {
 public:
  static constexpr double kStall_s = 0.3;  ///< a loop of 20 ms turns does not take so long
  /// Seconds of the gap that ends now when it was a stall, else 0.
  double Turn(double now_s) {
    const double gap_s = last_s_ ? now_s - *last_s_ : 0;
    last_s_ = now_s;
    return gap_s >= kStall_s ? gap_s : 0;
  }

 private:
  std::optional<double> last_s_;
};

}  // namespace palace
