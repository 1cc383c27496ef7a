// Persistence: a condition comes on, and goes off, only after several samples in a row that say so.
#pragma once

namespace palace {

class Persistence {
 public:
  static constexpr int kSamples = 3;

  /// True when this sample turned the condition on or off.
  bool Add(bool present, int samples = kSamples) {
    streak_ = present == on_ ? 0 : streak_ + 1;
    if (streak_ < samples) {
      return false;
    }
    streak_ = 0;
    on_ = present;
    return true;
  }
  bool on() const { return on_; }

 private:
  bool on_ = false;
  int streak_ = 0;  // samples in a row that disagree with on_
};

}  // namespace palace
