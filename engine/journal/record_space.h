// RecordSpace: how a recording gives way to a disk that fills up. Pictures are 97 % of a flight's
// record, so they are thinned first; telemetry, decisions and transitions are kept to the last.
//
//   left at the full rate   below 120 s   60 s        30 s
//   pairs of pictures       every 2nd     every 4th   none
//
// Space must have grown to 1.5 times a limit before more pictures are written again.
#pragma once

#include <cstdint>

namespace palace {

class RecordSpace {
 public:
  /// A pass that came `seconds` after the one before takes so many bytes with all its pictures, and
  /// so many without.
  void Add(double seconds, std::uint64_t full_bytes, std::uint64_t bytes_without_pictures);
  /// Of the pairs of pictures every n-th may be written with so much room: 1 all, 0 none.
  int Decide(std::uint64_t free_bytes);
  int every() const { return every_; }
  /// At the present rate; NaN while no rate is known.
  double SecondsIn(std::uint64_t bytes) const;

 private:
  double RateWith(int every) const;

  double seconds_ = 0;
  double full_bytes_ = 0;
  double slim_bytes_ = 0;
  int every_ = 1;
};

}  // namespace palace
