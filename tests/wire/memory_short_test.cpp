// The receiver when memory is short: at whichever allocation it fails, the batch is dropped and
// counted, nothing escapes, and what comes after is received.
#include <numeric>

#include <gtest/gtest.h>

#include "engine/wire/receiver/bus_receiver.h"
#include "tests/support/lcm_datagrams.h"
#include "tests/support/short_memory.h"

namespace palace {
namespace {

using short_memory::allocations_left, short_memory::failed;

constexpr SenderAddress kVehicle{0x0a000002, 7001};

std::vector<Bytes> Sent(std::uint32_t number) {
  std::vector<Bytes> sent = {ShortDatagram(number, "POSE", Bytes(100, 7))};
  for (const Bytes& part : FragmentDatagrams(number + 1, "PICTURE", Bytes(5000, 8), 2000)) {
    sent.push_back(part);
  }
  return sent;
}

std::vector<UdpSocket::Datagram> BatchOf(const std::vector<Bytes>& sent) {
  std::vector<UdpSocket::Datagram> batch;
  for (const Bytes& datagram : sent) {
    batch.push_back({kVehicle, datagram.data(), datagram.size()});
  }
  return batch;
}

TEST(MemoryShort, DropsABatchAndGoesOn) {
  int allowed = 0;
  for (bool fails = true; fails; ++allowed) {
    SCOPED_TRACE("after " + std::to_string(allowed) + " allocations");
    BusInbox inbox;
    inbox.Open("POSE", {.message_bytes = 256, .queue_messages = 4, .queue_bytes = 1000});
    inbox.Open("PICTURE", {.message_bytes = 6000, .queue_messages = 4, .queue_bytes = 12000});
    const std::vector<Bytes> sent = Sent(1);
    const std::vector<UdpSocket::Datagram> batch = BatchOf(sent);
    failed = false;
    allocations_left = allowed;
    inbox.Take(batch, {1000}, 1);
    allocations_left = -1;
    fails = failed;
    while (inbox.Pop()) {
    }
    const std::uint64_t dropped = inbox.Traffic(1).refused;
    EXPECT_EQ(dropped, fails ? batch.size() : 0);
    EXPECT_EQ(inbox.Traffic(1).refused_why.count("memory was short"), fails ? 1u : 0u);
    for (std::uint32_t number = 11; number < 31; number += 10) {
      const std::vector<Bytes> next = Sent(number);
      inbox.Take(BatchOf(next), {2000}, 2);
    }
    int got = 0;
    while (inbox.Pop()) {
      ++got;
    }
    EXPECT_EQ(got, 4) << "two of each, as the queues have room for";
  }
  EXPECT_GT(allowed, 5);
}

}  // namespace
}  // namespace palace
