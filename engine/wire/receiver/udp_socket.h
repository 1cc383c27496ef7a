// UdpSocket: datagrams of one multicast group, many at a time, with their senders.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/wire/receiver/lcm_reassembler.h"

namespace palace {

struct UdpGroup {
  std::uint32_t ip = 0xef'ff'4c'43;  ///< host byte order; LCM's default 239.255.76.67
  std::uint16_t port = 7667;
  int receive_buffer_bytes = 4194304;
};

/// Only what is sent to the group is received, not what is sent to the port of this machine. Other
/// programs on it may join the same group.
class UdpSocket {
 public:
  /// kUnavailable, with the system's reason.
  static Result<UdpSocket> Join(const UdpGroup& group);
  UdpSocket(UdpSocket&& other) noexcept;
  UdpSocket& operator=(UdpSocket&&) = delete;
  ~UdpSocket();

  struct Datagram {
    SenderAddress from;
    const std::uint8_t* data = nullptr;
    std::size_t size = 0;
  };
  /// The datagrams that wait, at most 32; waits for the first up to 0.1 s. They live until the next
  /// call. Empty after that time, or when the network is down.
  const std::vector<Datagram>& Receive();
  /// Datagrams that the kernel threw away because its buffer was full.
  std::uint64_t overrun() const { return overrun_; }

 private:
  explicit UdpSocket(int file);
  int file_ = -1;
  std::vector<std::uint8_t> buffer_;
  std::vector<Datagram> datagrams_;
  std::uint64_t overrun_ = 0;
  std::uint32_t kernel_overrun_ = 0;
};

}  // namespace palace
