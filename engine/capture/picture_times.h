// When the pictures of a recorded source were taken, in seconds since its first.
#pragma once

#include <cstdint>
#include <vector>

namespace palace {

class PictureTimes {
 public:
  /// Evenly, 1 / rate_hz apart, for ever.
  explicit PictureTimes(double rate_hz) : PictureTimes({0.0}, rate_hz) {}
  /// At these times, which begin with 0 and rise; what follows the last comes at rate_hz.
  PictureTimes(std::vector<double> taken_s, double rate_hz);

  double At(std::int64_t index) const;
  /// From this picture to the next.
  double Gap(std::int64_t index) const { return At(index + 1) - At(index); }
  /// The picture that was taken nearest to a time of 0 or more.
  std::int64_t Nearest(double time_s) const;

 private:
  std::vector<double> taken_s_;
  double rate_hz_;
};

}  // namespace palace
