#include "engine/journal/log_tools.h"

#include <algorithm>
#include <functional>
#include <map>
#include <system_error>
#include <utility>

#include "engine/core/plain_text.h"
#include "engine/core/text.h"
#include "engine/journal/log_index.h"
#include "engine/journal/log_writer.h"
#include "engine/journal/sidecar.h"
#include "engine/wire/convert.h"

namespace palace {
namespace {

constexpr std::size_t kMostFaultEvents = 1000;  // told of one log
constexpr std::uint64_t kMostLost = 10000;      // a longer jump is a damaged number

void RemoveLog(const std::filesystem::path& log) {
  std::error_code ignored;
  std::filesystem::remove(log, ignored);
  std::filesystem::remove(SidecarPath(log), ignored);
}

/// Events that were numbered between two that follow each other in the log.
std::uint64_t LostBetween(const LogEntry& before, const LogEntry& after) {
  const auto lost =  // as unsigned: a damaged number may be the largest there is
      static_cast<std::uint64_t>(after.number) - static_cast<std::uint64_t>(before.number) - 1;
  return lost < kMostLost ? lost : 0;
}

/// Copies the readable events that `keep` wants, and the jumps in number of what is lost between
/// them: a copy of a damaged log is no whole one. Whatever fails, closed or not.
Result<CopiedLog> CopyInto(LogWriter writer, const LogFile& file, const LogIndex& index,
                           const std::function<bool(const LogEntry&)>& keep) {
  CopiedLog copied;
  for (std::size_t i = 0; i < index.entries.size(); ++i) {
    const LogEntry& entry = index.entries[i];
    if (!keep(entry)) {
      continue;
    }
    if (writer.events() > 0) {
      writer.CountLost(LostBetween(index.entries[i - 1], entry));
    }
    const Result<WireMessage> message = ReadEvent(file, entry, index.channels);
    if (!message) {
      ++copied.left_out;
      writer.CountLost(writer.events() > 0 ? 1 : 0);
      continue;
    }
    if (const Status written = writer.Write(*message); !written) {
      return written.error();
    }
  }
  const Status closed = writer.Close();
  if (!closed) {
    return closed.error();
  }
  copied.events = writer.events();
  return copied;
}

/// Into a neighbour of `out`, which takes the name when it is whole: of a copy that was ended, or
/// found the disk full, nothing says that it is a log.
Result<CopiedLog> CopyEvents(const LogFile& file, const LogIndex& index,
                             const std::filesystem::path& out,
                             const std::function<bool(const LogEntry&)>& keep) {
  std::error_code error;
  for (const std::filesystem::path& name : {out, SidecarPath(out)}) {
    if (std::filesystem::exists(name, error)) {
      return UnavailableError(
          name.string() + ": it exists already; logs are never overwritten, name another --out");
    }
  }
  std::filesystem::path part = out;
  part += ".part";
  RemoveLog(part);
  Result<LogWriter> writer = LogWriter::Create(part);
  if (!writer) {
    return writer.error();
  }
  const Result<CopiedLog> copied = CopyInto(std::move(*writer), file, index, keep);
  if (!copied || copied->events == 0) {
    RemoveLog(part);
    return copied ? Result<CopiedLog>(UsageError(
                        out.string() + ": not written, no event that is wanted can be read"))
                  : copied;
  }
  // The sidecar first: a log without its checksums looks whole.
  std::filesystem::rename(SidecarPath(part), SidecarPath(out), error);
  if (!error) {
    std::filesystem::rename(part, out, error);
  }
  if (error) {
    RemoveLog(part);
    return UnavailableError(out.string() + ": cannot take its name (" + error.message() + ")");
  }
  return copied;
}

/// Of the first event that has a time; what was sent before anything was heard has none.
Timestamp StartOf(const LogIndex& index) {
  for (const LogEntry& entry : index.entries) {
    if (entry.time != Timestamp{}) {
      return entry.time;
    }
  }
  return {};
}

Timestamp EndOf(const LogIndex& index) {
  Timestamp end;
  for (const LogEntry& entry : index.entries) {
    end = std::max(end, entry.time);
  }
  return end;
}

/// What the log says was injected into a simulated flight. Its words may be anybody's.
std::vector<Event> FaultsOf(const LogFile& file, const LogIndex& index,
                            const ChannelNames& channels) {
  std::vector<Event> faults;
  for (const LogEntry& entry : index.entries) {
    if (index.channels[entry.channel] != channels.event || faults.size() == kMostFaultEvents) {
      continue;
    }
    const Result<WireMessage> message = ReadEvent(file, entry, index.channels);
    const Result<Event> event = message ? DecodeEvent(*message) : Result<Event>(message.error());
    if (event && event->kind == EventKind::kFault) {
      faults.push_back(*event);
      faults.back().text = PlainText(event->text, kLongestReason);
    }
  }
  return faults;
}

}  // namespace

Result<LogDescription> DescribeLog(const std::filesystem::path& log, bool verify,
                                   const ChannelNames& channels) {
  const Result<LogFile> file = LogFile::Open(log);
  if (!file) {
    return file.error();
  }
  const Result<LogIndex> index = verify ? VerifyLog(*file) : BuildIndex(*file);
  if (!index) {
    return index.error();
  }
  struct Span {
    ChannelSummary row;
    Timestamp first;
    Timestamp last;
    std::uint64_t at_first = 0;  ///< a bundle's events have one time
  };
  std::map<std::string, Span> spans;
  LogDescription description;
  description.report = index->report;
  description.first = description.last = StartOf(*index);
  for (const LogEntry& entry : index->entries) {
    Span& span = spans[index->channels[entry.channel]];
    if (span.row.events == 0 || entry.time < span.first) {
      span.first = entry.time;
      span.at_first = 0;
    }
    span.at_first += entry.time == span.first ? 1 : 0;
    span.last = span.row.events == 0 ? entry.time : std::max(span.last, entry.time);
    ++span.row.events;
    span.row.bytes += entry.length;
    if (entry.time != Timestamp{}) {
      description.first = std::min(description.first, entry.time);
    }
    description.last = std::max(description.last, entry.time);
  }
  for (auto& [name, span] : spans) {
    span.row.name = name;
    const double span_s = SecondsBetween(span.first, span.last);
    span.row.rate_hz =
        span_s > 0 ? static_cast<double>(span.row.events - span.at_first) / span_s : 0;
    description.channels.push_back(span.row);
  }
  const std::vector<BundleMark> bundles = FindBundles(*file, *index, channels);
  description.bundles = bundles.size();
  description.parts = FindParts(bundles);
  description.duration_s = SecondsBetween(description.first, description.last);
  description.faults = FaultsOf(*file, *index, channels);
  return description;
}

Result<CopiedLog> RepairLog(const std::filesystem::path& log, const std::filesystem::path& out) {
  const Result<LogFile> file = LogFile::Open(log);
  if (!file) {
    return file.error();
  }
  const Result<LogIndex> index = VerifyLog(*file);
  if (!index) {
    return index.error();
  }
  return CopyEvents(*file, *index, out, [](const LogEntry&) { return true; });
}

Result<CopiedLog> CutLog(const std::filesystem::path& log, const std::filesystem::path& out,
                         double from_s, double to_s) {
  if (!(from_s >= 0)) {
    return UsageError("--from-s " + NumberText(from_s) + ": a log begins at 0 s");
  }
  if (!(from_s <= to_s)) {
    return UsageError("the cut runs from " + NumberText(from_s) + " s to " + NumberText(to_s) +
                      " s; give --from-s below --to-s");
  }
  const Result<LogFile> file = LogFile::Open(log);
  if (!file) {
    return file.error();
  }
  const Result<LogIndex> index = BuildIndex(*file);
  if (!index) {
    return index.error();
  }
  const Timestamp start = StartOf(*index);
  const double last_s = index->entries.empty() ? 0 : SecondsBetween(start, EndOf(*index));
  if (from_s > last_s || to_s < 0) {
    return UsageError("the cut runs from " + NumberText(from_s) + " s to " + NumberText(to_s) +
                      " s, the log from 0 to " + NumberText(last_s) + " s");
  }
  return CopyEvents(*file, *index, out, [&](const LogEntry& entry) {
    const double at_s = SecondsBetween(start, entry.time);
    return at_s >= from_s && at_s <= to_s;
  });
}

}  // namespace palace
