#include "engine/runtime/recorder.h"

#include <filesystem>
#include <iterator>
#include <utility>
#include <vector>

namespace palace {
namespace {

constexpr std::uint64_t kItemsBetweenSpaceChecks = 50;

template <typename T>
void Prepend(std::vector<T>& older, std::vector<T>& newer) {
  older.insert(older.end(), std::make_move_iterator(newer.begin()),
               std::make_move_iterator(newer.end()));
  newer = std::move(older);
}

/// What `older` holds goes before what `newer` holds; of two bundles with pictures the newer's
/// stay.
void HandOver(RecordItem older, RecordItem& newer) {
  Prepend(older.commands, newer.commands);
  Prepend(older.sent, newer.sent);
  if (older.bundle && newer.bundle) {
    newer.bundle = Join(*older.bundle, *newer.bundle).bundle;
  }
}

}  // namespace

Recorder::Recorder(std::unique_ptr<RecordSink> sink, bool threaded)
    : sink_(std::move(sink)), path_(sink_->Path()) {
  if (threaded) {
    thread_ = std::jthread([this](std::stop_token stop) {
      while (auto item = queue_.Pop(stop)) {
        Write(*item);
      }
      while (auto item = queue_.TryPop()) {
        Write(*item);
      }
    });
  }
}

Recorder::~Recorder() { (void)Close(); }

void Recorder::Record(RecordItem item, bool may_wait) {
  HandOver(std::exchange(held_, {}), item);
  if (!item.bundle) {
    held_ = std::move(item);
  } else if (!thread_.joinable()) {
    Write(item);
  } else if (may_wait) {
    queue_.Push(std::move(item));
  } else {
    dropped_ += queue_.PushOrFold(std::move(item), HandOver);
  }
}

void Recorder::Write(const RecordItem& item) {
  if (!ok_) {
    return;
  }
  const Status done = sink_->Record(item);
  if (!done) {
    const std::lock_guard lock(error_mutex_);
    error_ = done.error().message;
    ok_ = false;
    return;
  }
  EstimateSpace(item);
}

void Recorder::EstimateSpace(const RecordItem& item) {
  if (!item.bundle) {
    return;
  }
  if (items_ == 0) {
    first_ = item.bundle->time;
  }
  if (++items_ % kItemsBetweenSpaceChecks != 0) {
    return;
  }
  std::error_code error;
  const auto written = std::filesystem::file_size(path_, error);
  const auto space = std::filesystem::space(std::filesystem::path(path_).parent_path(), error);
  const double seconds = SecondsBetween(first_, item.bundle->time);
  if (!error && written > 0 && seconds > 0) {
    minutes_left_ =
        static_cast<double>(space.available) / static_cast<double>(written) * seconds / 60;
  }
}

Status Recorder::Close() {
  if (closed_) {
    return Ok();
  }
  closed_ = true;
  if (thread_.joinable()) {
    thread_.request_stop();
    thread_.join();
  }
  if (!held_.commands.empty() || !held_.sent.empty()) {
    Write(held_);
  }
  const Status done = sink_->Close();
  if (!ok_) {
    return UnavailableError(error());
  }
  return done;
}

std::string Recorder::error() const {
  const std::lock_guard lock(error_mutex_);
  return error_;
}

}  // namespace palace
