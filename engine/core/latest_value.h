// LatestValue: the newest immutable value, handed from one thread to others.
#pragma once

#include <memory>
#include <mutex>

namespace palace {

/// The lock guards one pointer swap. A mutex, not std::atomic<shared_ptr>: the latter reports races
/// under ThreadSanitizer with g++ 12.
template <typename T>
class LatestValue {
 public:
  void Store(std::shared_ptr<const T> value) {
    const std::lock_guard lock(mutex_);
    value_.swap(value);
  }
  std::shared_ptr<const T> Load() const {
    const std::lock_guard lock(mutex_);
    return value_;
  }

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const T> value_;
};

}  // namespace palace
