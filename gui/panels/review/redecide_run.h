// RedecideRun: deciding a whole recorded flight again, from the start at full speed.
//
// Begins, is stopped by the reviewer, or ends with the log or with a jump to elsewhere, after which
// it would skip a part; the speed from before is then set again.
#pragma once

#include <cstdint>
#include <optional>

#include "engine/model/source_status.h"
#include "gui/app/intent.h"

namespace palace {

class RedecideRun {
 public:
  Intents Begin(const SourceStatus& source, double ui_time_s);
  /// Pauses where it is.
  Intents Stop();
  /// Once a frame. What is asked for when the log has ended, or somebody paused it or jumped in it.
  Intents Follow(const SourceStatus& source, double ui_time_s);

  bool running() const { return running_; }
  /// 0 to 1 of the log.
  double share() const { return share_; }
  /// By the pace so far; empty before there is one.
  std::optional<double> left_s() const;
  /// Of the last run that came to the end.
  std::optional<double> took_s() const { return took_s_; }

 private:
  bool running_ = false;
  bool under_way_ = false;   // seen playing at full speed, from the start
  std::uint64_t jumps_ = 0;  // SourceStatus::jumps: before it, and once it is under way
  double began_s_ = 0;
  double elapsed_s_ = 0;
  double share_ = 0;
  double speed_before_ = 1;
  std::optional<double> took_s_;
};

}  // namespace palace
