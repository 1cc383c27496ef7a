// RefusalLog: the beginnings of refused datagrams, a few a second however many come.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "engine/model/refused_datagram.h"

namespace palace {

/// One a second for each pair of reason and channel, ten a second in all; the others are counted by
/// the next one kept.
class RefusalLog {
 public:
  struct Refused {
    std::string sender, channel, reason;
    const std::uint8_t* data = nullptr;
    std::size_t size = 0;
  };
  void Add(const Refused& refused, Timestamp wall, double now_s);
  /// What was kept since the last call.
  std::vector<RefusedDatagram> Take();

 private:
  struct Kind {
    double kept_s = 0;
    std::uint64_t skipped = 0;
  };
  std::map<std::string, Kind> kinds_;
  std::vector<RefusedDatagram> kept_;
  double second_s_ = -1;  ///< since when `in_second_` counts
  int in_second_ = 0;
};

}  // namespace palace
