// Which picture of a recorded source is due, and when: pace, pause, steps, seeks, the end.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <stop_token>

#include "engine/capture/picture_times.h"
#include "engine/model/command.h"
#include "engine/model/snapshot.h"

namespace palace {

/// Data time of the first recorded picture; files of pictures have no clock of their own.
inline constexpr Timestamp kRecordedStart{1'000'000'000'000};

/// Hands out the indices 0, 1, 2 ... of pictures as far apart as they were taken, paced to `speed`
/// times real time (0: as fast as asked for). Wait is called from one thread, the rest from any.
class PlaybackTurns {
 public:
  enum class AtEnd : std::uint8_t {
    kEnd,     ///< no more turns
    kWait,    ///< until somebody seeks or steps back
    kRunOn,   ///< indices grow past the end for ever
    kRestart  ///< at index 0
  };
  /// `count` 0: not known before EndsAt.
  PlaybackTurns(PictureTimes times, std::int64_t count, AtEnd at_end);

  /// Waits for the next turn and gives its index. Nothing when stopped or ended.
  std::optional<std::int64_t> Wait(std::stop_token stop);
  /// The index just given is not there: the end lies before it. Ask again.
  void EndsAt(std::int64_t count);

  void Control(const PlaybackControl& control);
  /// What these turns know of a status. Positions are those of the index last given.
  void FillStatus(SourceStatus& status) const;

 private:
  const PictureTimes times_;
  const AtEnd at_end_;
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::int64_t count_;  ///< 0 unknown
  bool count_found_;    ///< by reading to the end; until then it is what a header says
  std::int64_t next_index_ = 0;
  std::int64_t shown_index_ = -1;
  int steps_ = 0;  ///< single turns owed while paused
  bool paused_ = false;
  bool ended_ = false;
  double speed_ = 1;
  double speed_reached_ = 1;
  double due_s_ = 0;  ///< monotonic time of the next turn; 0 at once
};

}  // namespace palace
