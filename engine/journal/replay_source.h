// ReplaySource: a recorded flight as a source of bundles. It has no way to a vehicle.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "engine/journal/log_index.h"
#include "engine/journal/log_reader.h"
#include "engine/model/flight_record.h"
#include "engine/runtime/source.h"
#include "engine/wire/bundle_assembler.h"

namespace palace {

using RecordedTrack = FlightRecord;

struct ReplayOptions {
  bool paused = false;
  double speed = 1;          ///< times real time; 0 as fast as possible
  bool wait_at_end = false;  ///< true (screens): Next waits at the end for a seek; false: kEnd
  double longest_gap_s = 5;  ///< a gap in the log is not waited for longer
  int part = 0;              ///< of a log in which the vehicle restarted, from 1; 0: the longest
  ChannelNames channels;
};

/// Every bundle, in order, bit-equal to what the engine was given, with the commands that were
/// posted before it in recorded_commands. After a jump (seek, step back) reading simply goes on
/// from there and the first bundle carries `discontinuity`. A seek while paused delivers one
/// bundle, so that the screen follows. Play at the end plays from the start again. Damaged
/// stretches are skipped and counted; an event that the file holds twice in a row, its number
/// included, is taken once and counted. Of a log in which the vehicle's clock began anew one part
/// is played: seconds of two clocks have no common timeline.
class ReplaySource final : public Source {
 public:
  /// Errors name the path and the remedy: missing, a folder, empty, not a log, no bundle, not
  /// so many parts in it.
  static Result<std::unique_ptr<ReplaySource>> Open(const std::filesystem::path& path);
  static Result<std::unique_ptr<ReplaySource>> Open(const std::filesystem::path& path,
                                                    const ReplayOptions& options);
  Result<std::shared_ptr<const FrameBundle>> Next(std::stop_token stop) override;
  bool IsLockstep() const override { return true; }
  SourceStatus Status() const override;
  /// After kEnd a seek makes Next deliver again.
  void Control(const PlaybackControl& control) override;

  /// What the flight decided when it was recorded.
  std::shared_ptr<const RecordedTrack> recorded() const { return recorded_; }
  const std::vector<BundleMark>& bundles() const { return bundles_; }

 private:
  ReplaySource(LogFile file, LogIndex index, const ReplayOptions& options);
  ::palace::Status Prepare(const std::filesystem::path& path);
  ::palace::Status ChoosePart(const std::filesystem::path& path);
  void ReadTrack();
  /// To each touchdown what the last TRUTH of its bundle says.
  void AddTruth(FlightRecord& record) const;
  std::shared_ptr<const FrameBundle> ReadBundle();
  std::shared_ptr<const FrameBundle> Deliver(std::shared_ptr<const FrameBundle> bundle);
  bool WaitForTurn(std::unique_lock<std::mutex>& lock, std::stop_token stop);
  void JumpTo(std::size_t bundle);
  /// Nothing is left to deliver. Under the mutex.
  bool AtEnd() const { return next_bundle_ >= bundles_.size() && !jump_pending_; }

  LogFile file_;
  LogIndex index_;
  ReplayOptions options_;
  std::vector<BundleMark> bundles_;            ///< of the part
  std::size_t end_event_ = 0;                  ///< of the part
  std::size_t first_told_ = 0, end_told_ = 0;  ///< of the part, what the station told
  int part_ = 1, parts_ = 1;
  std::shared_ptr<const RecordedTrack> recorded_;
  BundleAssembler assembler_;
  std::size_t next_event_ = 0;                    ///< reader's position; Next's thread only
  bool was_jump_ = false;                         ///< Next's thread only
  std::atomic<std::uint64_t> events_refused_{0};  ///< could not be read or decoded on the way

  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::size_t next_bundle_ = 0;
  std::uint64_t generation_ = 0;  ///< counts jumps
  bool jump_pending_ = false;
  int steps_ = 0;  ///< bundles to deliver although paused
  bool paused_ = false;
  double speed_ = 1;
  double speed_reached_ = 1;
  std::optional<double> last_delivery_s_;  ///< monotonic
  std::optional<Timestamp> last_time_;

  std::uint64_t written_twice_ = 0;  ///< events, of which one was taken
};

}  // namespace palace
