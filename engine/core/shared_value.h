// SharedValue: a value that copies of its holder share until one of them changes it.
//
// Snapshots are immutable and follow each other ten times a second; what a pass does not renew is
// carried on by sharing it. Copying is a reference count; Edit() copies the value first when
// somebody else holds it too (copy on write). Reading needs no lock: what is shared never changes.
#pragma once

#include <memory>

namespace palace {

template <typename T>
class SharedValue {
 public:
  SharedValue() : value_(std::make_shared<T>()) {}

  const T& operator*() const { return *value_; }
  const T* operator->() const { return value_.get(); }

  /// The value as it is now, to keep; Edit() then works on a copy.
  std::shared_ptr<const T> Share() const { return value_; }

  /// The value to change. Only by the thread that builds the holder, before it is handed on.
  T& Edit() {
    if (value_.use_count() != 1) {
      value_ = std::make_shared<T>(*value_);
    }
    return *value_;
  }

 private:
  std::shared_ptr<T> value_;
};

}  // namespace palace
