#include "engine/runtime/record_queue.h"

#include <chrono>
#include <iterator>
#include <utility>

namespace palace {
namespace {

constexpr std::size_t kMostWhole = 64;
constexpr std::size_t kMostEntries = 4000;

template <typename T>
void Prepend(std::vector<T>& older, std::vector<T>& newer) {
  older.insert(older.end(), std::make_move_iterator(newer.begin()),
               std::make_move_iterator(newer.end()));
  newer = std::move(older);
}

void Strip(RecordItem& item) {
  item.snapshot = nullptr;
  if (item.bundle && item.bundle->stereo) {
    item.bundle = std::make_shared<const FrameBundle>(WithoutPictures(*item.bundle));
    ++item.pairs_left_out;
  }
}

/// What `older` holds goes before what `newer` holds.
void HandOver(RecordItem older, RecordItem& newer) {
  Prepend(older.commands, newer.commands);
  Prepend(older.sent, newer.sent);
  Prepend(older.notes, newer.notes);
  newer.pairs_left_out += older.pairs_left_out;
  if (older.bundle) {
    newer.bundle = newer.bundle ? Join(*older.bundle, *newer.bundle).bundle : older.bundle;
  }
}

}  // namespace

std::uint64_t RecordQueue::Push(RecordItem item, bool may_wait) {
  std::unique_lock lock(mutex_);
  if (may_wait) {
    changed_.wait(lock, [&] { return hurries_ || entries_.size() < kMostWhole; });
  }
  const std::uint64_t ticket = ++last_ticket_;
  entries_.push_back({ticket, std::move(item)});
  MakeRoom();
  changed_.notify_all();
  return ticket;
}

void RecordQueue::MakeRoom() {
  if (entries_.size() - stripped_ > kMostWhole) {
    RecordItem& oldest = entries_[stripped_++].item;
    const std::uint64_t before = oldest.pairs_left_out;
    Strip(oldest);
    pairs_left_out_ += oldest.pairs_left_out - before;
  }
  if (entries_.size() > kMostEntries) {
    RecordItem oldest = std::move(entries_.front().item);
    entries_.pop_front();
    --stripped_;
    HandOver(std::move(oldest), entries_.front().item);
  }
}

std::optional<RecordQueue::Entry> RecordQueue::Pop(std::stop_token stop) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, stop, [&] { return !entries_.empty(); });
  if (entries_.empty()) {
    return std::nullopt;
  }
  std::optional<Entry> entry(std::move(entries_.front()));
  entries_.pop_front();
  stripped_ -= stripped_ > 0 ? 1 : 0;
  changed_.notify_all();
  return entry;
}

void RecordQueue::Done(std::uint64_t ticket, bool written) {
  const std::lock_guard lock(mutex_);
  // Those in between were joined to this one.
  const std::uint64_t first =
      done_ticket_ + kRemembered < ticket ? ticket - kRemembered + 1 : done_ticket_ + 1;
  for (std::uint64_t i = first; i <= ticket; ++i) {
    written_[i % kRemembered] = written;
  }
  done_ticket_ = ticket;
  changed_.notify_all();
}

Written RecordQueue::AwaitDone(std::uint64_t ticket, double seconds) {
  std::unique_lock lock(mutex_);
  if (!changed_.wait_for(lock, std::chrono::duration<double>(seconds),
                         [&] { return done_ticket_ >= ticket; })) {
    return Written::kLate;
  }
  return written_[ticket % kRemembered] ? Written::kYes : Written::kNo;
}

void RecordQueue::HurryUp() {
  const std::lock_guard lock(mutex_);
  hurries_ = true;
  changed_.notify_all();
}

std::uint64_t RecordQueue::pairs_left_out() const {
  const std::lock_guard lock(mutex_);
  return pairs_left_out_;
}

}  // namespace palace
