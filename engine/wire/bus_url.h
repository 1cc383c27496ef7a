// The URL of a bus: what of LCM's is taken, and what PALACE adds.
#pragma once

#include <string>

#include "engine/core/result.h"
#include "engine/wire/receiver/udp_socket.h"

namespace palace {

/// `url` with recv_buf_size=4194304 and ttl=0 appended where it is udpm and does not say so itself.
/// An empty url is LCM's default multicast group.
std::string CompleteLcmUrl(const std::string& url);

struct BusPlace {
  bool in_memory = false;  ///< memq: within one process, for tests
  UdpGroup group{};        ///< of udpm
};
/// kUsage, with an example, for what is no bus, and for the transports of liblcm through which it
/// would receive in this process (tcpq, mpudpm, file).
Result<BusPlace> ParseBusUrl(const std::string& complete_url);

}  // namespace palace
