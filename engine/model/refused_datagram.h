// RefusedDatagram: the beginning of what was not let in, kept as evidence.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/core/time.h"

namespace palace {

inline constexpr std::size_t kRefusedBytesKept = 64;

struct RefusedDatagram {
  Timestamp time;             ///< wall clock: a datagram has no data time
  std::string sender;         ///< "10.0.0.2:7667"; empty where unknown
  std::string channel;        ///< empty where none could be read
  std::string reason;         ///< for people
  std::uint32_t bytes = 0;    ///< of the whole
  std::uint64_t like_it = 1;  ///< refused for this reason since the last one kept, itself included
  std::vector<std::uint8_t> head{};  ///< the first kRefusedBytesKept
  friend bool operator==(const RefusedDatagram&, const RefusedDatagram&) = default;
};

}  // namespace palace
