#include "engine/journal/log_tools.h"

#include <algorithm>
#include <functional>
#include <map>

#include "engine/core/plain_text.h"
#include "engine/journal/log_index.h"
#include "engine/journal/log_writer.h"
#include "engine/wire/convert.h"

namespace palace {
namespace {

constexpr std::size_t kMostFaultEvents = 1000;  // told of one log

/// Copies the readable events that `keep` wants.
Result<CopiedLog> CopyEvents(const LogFile& file, const LogIndex& index,
                             const std::filesystem::path& out,
                             const std::function<bool(const LogEntry&)>& keep) {
  Result<LogWriter> writer = LogWriter::Create(out);
  if (!writer) {
    return writer.error();
  }
  CopiedLog copied;
  for (const LogEntry& entry : index.entries) {
    if (!keep(entry)) {
      continue;
    }
    const Result<WireMessage> message = ReadEvent(file, entry, index.channels);
    copied.left_out += message ? 0 : 1;
    const Status written = message ? writer->Write(*message) : Ok();
    if (!written) {
      return written.error();
    }
  }
  const Status closed = writer->Close();
  if (!closed) {
    return closed.error();
  }
  copied.events = writer->events();
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
  };
  std::map<std::string, Span> spans;
  LogDescription description;
  description.report = index->report;
  description.first = description.last = StartOf(*index);
  for (const LogEntry& entry : index->entries) {
    Span& span = spans[index->channels[entry.channel]];
    span.first = span.row.events == 0 ? entry.time : std::min(span.first, entry.time);
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
    span.row.rate_hz = span_s > 0 ? static_cast<double>(span.row.events - 1) / span_s : 0;
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
  if (!(from_s <= to_s)) {
    return UsageError("the cut runs from " + std::to_string(from_s) + " s to " +
                      std::to_string(to_s) + " s; give --from-s below --to-s");
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
  return CopyEvents(*file, *index, out, [&](const LogEntry& entry) {
    const double at_s = SecondsBetween(start, entry.time);
    return at_s >= from_s && at_s <= to_s;
  });
}

}  // namespace palace
