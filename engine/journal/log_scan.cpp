#include <algorithm>
#include <cstring>
#include <map>
#include <optional>

#include "engine/journal/big_endian.h"
#include "engine/journal/log_reader.h"

namespace palace {
namespace {

constexpr std::size_t kWindowBytes = 16 << 10;
constexpr std::size_t kSearchBytes = 1 << 20;
constexpr std::size_t kLongestHead = kLogHeaderBytes + kLogLongestChannel;
constexpr std::size_t kMostGaps = 1000;
constexpr std::size_t kMostChannels = 0xFFFF;
constexpr std::uint64_t kMostMissing = 10000;  ///< events a gap may plausibly have swallowed

/// Header and channel of an event that passed every check its own bytes allow.
struct Head {
  std::int64_t number = 0;
  Timestamp time;
  std::uint64_t end = 0;
  std::string channel;
};

class Scanner {
 public:
  Scanner(const LogFile& file, LogScan& scan) : file_(file), scan_(scan) {
    for (std::size_t i = 0; i < scan.channels.size(); ++i) {
      ids_[scan.channels[i]] = static_cast<std::uint16_t>(i);
    }
    if (!scan.entries.empty()) {
      last_number_ = scan.entries.back().number;
    }
  }

  void Run(std::uint64_t at, std::stop_token stop, const std::function<void(double)>& progress) {
    std::uint64_t reported = at;
    while (at < file_.size()) {
      if (stop.stop_requested()) {
        scan_.report.cancelled = true;
        return;
      }
      if (progress && at - reported > (16u << 20)) {
        reported = at;
        progress(static_cast<double>(at) / static_cast<double>(file_.size()));
      }
      at = Step(at, stop);
    }
  }

 private:
  /// Takes the event at `at`, or skips to the next one. Returns where to go on.
  std::uint64_t Step(std::uint64_t at, std::stop_token stop) {
    const std::optional<Head> head = ParseHead(at, true);
    if (!head) {
      const std::uint64_t next = FindEvent(at + 1, stop);
      AddGap(at, next);
      return next;
    }
    if (EndsWell(*head)) {
      Accept(at, *head, false);
      return head->end;
    }
    // The word after this event is no sync: either this event's length is wrong (the next event
    // begins inside it), or what follows is damaged.
    const std::uint64_t next = FindEvent(at + 1, stop);
    if (next < head->end) {
      AddGap(at, next);
      return next;
    }
    // Followed by an event that lost only its sync word, this one is whole; else its tail may be
    // missing.
    const std::optional<Head> beheaded = ParseHead(head->end, false);
    Accept(at, *head, !(beheaded && beheaded->end == next));
    AddGap(head->end, next);
    return next;
  }

  std::optional<Head> ParseHead(std::uint64_t at, bool need_sync) {
    const std::uint8_t* p = nullptr;
    const std::size_t bytes = Look(at, kLongestHead, &p);
    if (bytes <= kLogHeaderBytes || (need_sync && GetBig<std::uint32_t>(p) != kLogSync)) {
      return std::nullopt;
    }
    const auto channel_length = GetBig<std::uint32_t>(p + 20);
    const auto data_length = GetBig<std::uint32_t>(p + 24);
    if (channel_length < 1 || channel_length > kLogLongestChannel ||
        data_length > kLogLargestData || bytes < kLogHeaderBytes + channel_length) {
      return std::nullopt;
    }
    Head head;
    head.number = GetBig<std::int64_t>(p + 4);
    head.time = {GetBig<std::int64_t>(p + 12)};
    head.end = at + kLogHeaderBytes + channel_length + data_length;
    head.channel.assign(p + kLogHeaderBytes, p + kLogHeaderBytes + channel_length);
    const bool printable = std::all_of(head.channel.begin(), head.channel.end(),
                                       [](char c) { return c > ' ' && c <= '~'; });
    if (head.end > file_.size() || !printable) {
      return std::nullopt;
    }
    return head;
  }

  /// The event is followed by a sync word or by the end of the file.
  bool EndsWell(const Head& head) {
    const std::uint8_t* p = nullptr;
    return head.end == file_.size() ||
           (Look(head.end, 4, &p) == 4 && GetBig<std::uint32_t>(p) == kLogSync);
  }

  /// First event at or after `from` that can be believed: it ends well, or its number continues.
  /// A header look-alike inside a payload does neither. The file's size when there is none.
  std::uint64_t FindEvent(std::uint64_t from, std::stop_token stop) {
    std::vector<std::uint8_t> chunk(kSearchBytes);
    while (from + kLogHeaderBytes < file_.size() && !stop.stop_requested()) {
      const std::size_t bytes = file_.ReadAt(from, chunk.data(), chunk.size());
      const std::uint8_t* p = chunk.data();
      const std::uint8_t* const end = p + bytes;
      while (end - p >= 4) {
        p = static_cast<const std::uint8_t*>(
            std::memchr(p, kLogSync >> 24, static_cast<std::size_t>(end - p) - 3));
        if (p == nullptr) {
          break;
        }
        if (GetBig<std::uint32_t>(p) == kLogSync) {
          const std::uint64_t at = from + static_cast<std::uint64_t>(p - chunk.data());
          const std::optional<Head> head = ParseHead(at, true);
          if (head && (EndsWell(*head) || Continues(*head))) {
            return at;
          }
        }
        ++p;
      }
      if (bytes < 4) {
        break;
      }
      from += bytes - 3;
    }
    return file_.size();
  }

  bool Continues(const Head& head) const {
    // As unsigned: a damaged number may be the largest there is.
    return last_number_ &&
           static_cast<std::uint64_t>(head.number) - static_cast<std::uint64_t>(*last_number_) - 1 <
               kMostMissing;
  }

  void Accept(std::uint64_t at, const Head& head, bool suspect) {
    const auto [id, is_new] =
        ids_.try_emplace(head.channel, static_cast<std::uint16_t>(scan_.channels.size()));
    if (is_new) {
      if (scan_.channels.size() >= kMostChannels) {
        ids_.erase(id);
        AddGap(at, head.end);
        return;
      }
      scan_.channels.push_back(head.channel);
    }
    LogEntry entry;
    entry.offset = at;
    entry.length = static_cast<std::uint32_t>(head.end - at);
    entry.channel = id->second;
    entry.suspect = suspect;
    entry.number = head.number;
    entry.time = head.time;
    scan_.entries.push_back(entry);
    last_number_ = head.number;
  }

  void AddGap(std::uint64_t from, std::uint64_t to) {
    if (to <= from) {
      return;
    }
    LogReport& report = scan_.report;
    report.skipped_bytes += to - from;
    ++report.gap_count;
    if (report.gaps.size() < kMostGaps) {
      report.gaps.push_back({from, to - from});
    }
  }

  /// Up to `wanted` bytes at `at`, from a small window over the file.
  std::size_t Look(std::uint64_t at, std::size_t wanted, const std::uint8_t** bytes) {
    if (at >= file_.size()) {
      return 0;
    }
    const bool inside = at >= window_start_ && at + wanted <= window_start_ + window_.size();
    if (!inside) {
      window_.resize(kWindowBytes);
      window_start_ = at;
      window_.resize(file_.ReadAt(at, window_.data(), kWindowBytes));
    }
    *bytes = window_.data() + (at - window_start_);
    return std::min<std::uint64_t>(wanted, window_start_ + window_.size() - at);
  }

  const LogFile& file_;
  LogScan& scan_;
  std::map<std::string, std::uint16_t> ids_;
  std::optional<std::int64_t> last_number_;
  std::vector<std::uint8_t> window_;
  std::uint64_t window_start_ = 0;
};

}  // namespace

void ScanLog(const LogFile& file, std::uint64_t from, LogScan& scan, std::stop_token stop,
             const std::function<void(double)>& progress) {
  scan.report.file_bytes = file.size();
  Scanner(file, scan).Run(from, stop, progress);
  LogReport& report = scan.report;
  report.events = scan.entries.size();
  report.suspect = report.time_regressions = report.number_jumps = 0;
  for (std::size_t i = 0; i < scan.entries.size(); ++i) {
    const LogEntry& entry = scan.entries[i];
    report.suspect += entry.suspect ? 1 : 0;
    if (i > 0) {
      const LogEntry& before = scan.entries[i - 1];
      report.time_regressions += entry.time < before.time ? 1 : 0;
      // As unsigned: a damaged number may be the largest there is.
      const auto step =
          static_cast<std::uint64_t>(entry.number) - static_cast<std::uint64_t>(before.number);
      report.number_jumps += step != 1 ? 1 : 0;
    }
  }
}

}  // namespace palace
