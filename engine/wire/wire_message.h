// WireMessage: one message as it travels on the bus and lies in a log, not yet understood.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/core/time.h"

namespace palace {

struct WireMessage {
  std::string channel;
  Timestamp time;  ///< data time it was sent or recorded under
  std::vector<std::uint8_t> payload;
  std::string sender{};  ///< address and port, "10.0.0.2:7667"; empty of logs and memory
};

}  // namespace palace
