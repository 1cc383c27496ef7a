// AlarmBoard: the alarms that stand, with persistence and acknowledgement.
//
// An alarm comes on, and goes off, only after three samples in a row. It disappears only when its
// cause is gone; acknowledging only silences (I15). A cleared warning or caution that nobody
// acknowledged stays, marked not active, in the words of its worst sample. Advisories go with their
// cause.
// Source: reference/station-gui.md 3.2, look.md 10.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "engine/mission/watch/persistence.h"
#include "engine/model/mission/mission_status.h"

namespace palace {

/// One condition of one sample. `text`: what, number, limit, then what to do.
struct AlarmCondition {
  AlarmId id = AlarmId::kCameraLeft;
  AlarmLevel level = AlarmLevel::kAdvisory;
  bool present = false;
  std::string text;
  bool immediate = false;  ///< events need no persistence: the vehicle's refusal, a wave-off
  double figure = NAN;     ///< held against the limit, or how bad it is; NaN: there is none
  bool less_is_worse = false;
  std::string figure_words{};  ///< with its unit
};

class AlarmBoard {
 public:
  /// Once a sample, with the same set of ids each time.
  void Update(const std::vector<AlarmCondition>& conditions, Timestamp now);
  /// False when that alarm is not on the board.
  bool Acknowledge(AlarmId id);
  bool IsAcknowledged(AlarmId id) const;
  /// What it said last, on the board or not; empty: it was never told.
  std::string LastText(AlarmId id) const;
  /// Text of the worst warning nobody acknowledged, empty when there is none; of one that is over
  /// what it was: "Vision lost for 2.0 s, limit 0.3 s (over)".
  std::string UnacknowledgedWarning() const;
  /// What stands before what is over, then worst first; of that what nobody acknowledged, then the
  /// newest: one sentence has room in the strip, and an old caution must not hide a new one.
  std::vector<Alarm> Shown() const;
  /// Alarms that came on in the last Update.
  const std::vector<Alarm>& raised() const { return raised_; }
  /// Warnings and cautions whose cause went away in the last Update, acknowledged or not.
  const std::vector<Alarm>& ended() const { return ended_; }

 private:
  struct Entry {
    Alarm alarm;
    Persistence standing;
    bool shown = false;
    double worst = NAN;  ///< figure, and the text that told it
    std::string worst_text;

    void TakeWorst(const AlarmCondition& condition);
  };
  Entry& Find(const AlarmCondition& condition);
  std::vector<Entry> entries_;
  std::vector<Alarm> raised_, ended_;
};

}  // namespace palace
