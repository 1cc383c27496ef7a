#include "engine/wire/receiver/udp_socket.h"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

namespace palace {
namespace {

constexpr std::size_t kBatch = 32;
constexpr std::size_t kLargestDatagram = 65536;
constexpr timeval kWait{0, 100'000};

template <typename T>
bool SetOption(int file, int level, int option, const T& value) {
  return setsockopt(file, level, option, &value, sizeof value) == 0;
}

Error JoinError(const char* step) {
  return UnavailableError(std::string(step) + ": " + std::strerror(errno));
}

}  // namespace

UdpSocket::UdpSocket(int file) : file_(file), buffer_(kBatch * kLargestDatagram) {
  datagrams_.reserve(kBatch);
}

UdpSocket::UdpSocket(UdpSocket&& other) noexcept
    : file_(std::exchange(other.file_, -1)),
      buffer_(std::move(other.buffer_)),
      datagrams_(std::move(other.datagrams_)) {}

UdpSocket::~UdpSocket() {
  if (file_ >= 0) {
    close(file_);
  }
}

Result<UdpSocket> UdpSocket::Join(const UdpGroup& group) {
  const int file = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (file < 0) {
    return JoinError("no socket");
  }
  UdpSocket joined(file);
  // As every program on a bus does, so that all of this machine can listen.
  if (!SetOption(file, SOL_SOCKET, SO_REUSEADDR, 1)) {
    return JoinError("cannot share the port");
  }
  SetOption(file, SOL_SOCKET, SO_RCVBUF, group.receive_buffer_bytes);
  SetOption(file, SOL_SOCKET, SO_RXQ_OVFL, 1);
  SetOption(file, SOL_SOCKET, SO_RCVTIMEO, kWait);
  SetOption(file, IPPROTO_IP, IP_MULTICAST_ALL, 0);
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_addr.s_addr = htonl(group.ip);
  place.sin_port = htons(group.port);
  if (bind(file, reinterpret_cast<const sockaddr*>(&place), sizeof place) != 0) {
    return JoinError("cannot listen to the group's port");
  }
  const ip_mreq membership{place.sin_addr, {htonl(INADDR_ANY)}};
  if (!SetOption(file, IPPROTO_IP, IP_ADD_MEMBERSHIP, membership)) {
    return JoinError("cannot join the group");
  }
  return joined;
}

const std::vector<UdpSocket::Datagram>& UdpSocket::Receive() {
  std::array<mmsghdr, kBatch> headers{};
  std::array<iovec, kBatch> places{};
  std::array<sockaddr_in, kBatch> senders{};
  std::array<std::array<char, 64>, kBatch> notes{};
  for (std::size_t i = 0; i < kBatch; ++i) {
    places[i] = {buffer_.data() + i * kLargestDatagram, kLargestDatagram};
    headers[i].msg_hdr = {.msg_name = &senders[i],
                          .msg_namelen = sizeof senders[i],
                          .msg_iov = &places[i],
                          .msg_iovlen = 1,
                          .msg_control = notes[i].data(),
                          .msg_controllen = notes[i].size(),
                          .msg_flags = 0};
  }
  datagrams_.clear();
  const int got = recvmmsg(file_, headers.data(), kBatch, MSG_WAITFORONE, nullptr);
  if (got < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR) {
    usleep(static_cast<useconds_t>(kWait.tv_usec));  // the network is down: wait, do not spin
  }
  for (int n = 0; n < got; ++n) {
    const auto i = static_cast<std::size_t>(n);
    for (cmsghdr* note = CMSG_FIRSTHDR(&headers[i].msg_hdr); note != nullptr;
         note = CMSG_NXTHDR(&headers[i].msg_hdr, note)) {
      if (note->cmsg_level == SOL_SOCKET && note->cmsg_type == SO_RXQ_OVFL) {
        std::uint32_t total = 0;  // since the socket was made, modulo 2^32
        std::memcpy(&total, CMSG_DATA(note), sizeof total);
        overrun_ += total - kernel_overrun_;
        kernel_overrun_ = total;
      }
    }
    datagrams_.push_back({{ntohl(senders[i].sin_addr.s_addr), ntohs(senders[i].sin_port)},
                          buffer_.data() + i * kLargestDatagram,
                          headers[i].msg_len});
  }
  return datagrams_;
}

}  // namespace palace
