// RecordQueue: what waits for the disk, in order. A slow disk costs pictures first.
#pragma once

#include <array>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <stop_token>

#include "engine/runtime/record_sink.h"

namespace palace {

/// What became of something that was to be written.
enum class Written : std::uint8_t {
  kYes,
  kLate,  ///< not yet
  kNo,    ///< the disk refused it, or it was never tried
};

/// Several threads put in, one takes out. At most 64 whole passes wait: of an older one the
/// pictures go, and the snapshot, but commands, messages and samples stay. When 4000 such remains
/// wait, minutes of a disk that stands still, the oldest two become one.
class RecordQueue {
 public:
  struct Entry {
    std::uint64_t ticket = 0;
    RecordItem item;
  };
  /// `may_wait`: waits for room instead of leaving pictures out, until HurryUp. Returns the item's
  /// ticket; tickets rise.
  std::uint64_t Push(RecordItem item, bool may_wait);
  /// Waits for an entry. Empty when stop was requested and nothing is left.
  std::optional<Entry> Pop(std::stop_token stop);
  /// Everything up to this ticket is dealt with, the last of it `written` or not.
  void Done(std::uint64_t ticket, bool written);
  /// Waits until it is, at most so long. Ask soon: only the newest are remembered.
  Written AwaitDone(std::uint64_t ticket, double seconds);
  /// Nobody waits for room any more.
  void HurryUp();
  /// Pairs of pictures that were left out.
  std::uint64_t pairs_left_out() const;

 private:
  static constexpr std::size_t kRemembered = 256;
  void MakeRoom();

  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<Entry> entries_;
  std::size_t stripped_ = 0;  ///< entries at the front that have no pictures any more
  std::uint64_t last_ticket_ = 0;
  std::uint64_t done_ticket_ = 0;
  std::array<bool, kRemembered> written_{};  ///< of the newest tickets that are done, by turns
  bool hurries_ = false;
  std::uint64_t pairs_left_out_ = 0;
};

}  // namespace palace
