#include "engine/tools/simulate_end.h"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iostream>

#include "engine/journal/log_index.h"

namespace palace {
namespace {

constexpr std::chrono::milliseconds kPatience{1200};  // most bundles are made in a tenth of it

}  // namespace

void SimulateEnd::Over() {
  const std::lock_guard held(hand_);
  over_ = true;
  over_now_.notify_all();
}

void SimulateEnd::EndUnflown() {
  const std::lock_guard held(hand_);
  if (!flown_ && flight_.stop_requested()) {
    GiveUp();
  }
}

void SimulateEnd::Asked() {
  flight_.request_stop();
  std::unique_lock held(hand_);
  if (!over_now_.wait_for(held, kPatience, [this] { return over_; })) {
    GiveUp();
  }
}

/// Under hand_, which nobody gets back.
void SimulateEnd::GiveUp() {
  std::error_code ignored;
  Status closed = Ok();
  if (log_ != nullptr && flown_) {
    closed = log_->Close();
  } else if (log_ != nullptr) {
    std::filesystem::remove(SidecarPath(log_->path()), ignored);
    std::filesystem::remove(log_->path(), ignored);
  }
  if (folder_ != nullptr && flown_) {
    const Result<std::uint64_t> pairs = folder_->Close();
    closed = pairs ? closed : Status(pairs.error());
  } else if (folder_ != nullptr) {
    folder_->Remove();
  }
  std::cerr << "palacectl simulate: "
            << (!closed  ? closed.error().message
                : flown_ ? "ended; the picture in hand was given up"
                         : "ended before the first picture was there; nothing was written")
            << "\n";
  std::fflush(stdout);
  _exit(!closed ? 1 : flown_ ? 0 : termination_.exit_code());
}

}  // namespace palace
