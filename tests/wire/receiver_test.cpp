// Between the socket and the reader: queues that do not starve each other, one sender a channel,
// refusals kept as evidence.
#include <gtest/gtest.h>

#include "engine/wire/channel_rules.h"
#include "engine/wire/receiver/bus_receiver.h"
#include "tests/support/lcm_datagrams.h"

namespace palace {
namespace {

constexpr SenderAddress kVehicle{0x0a000002, 7001};
constexpr SenderAddress kStranger{0x0a000009, 6666};

class Inbox : public ::testing::Test {
 protected:
  Inbox() {
    inbox_.Open("POSE",
                {.message_bytes = 256, .queue_messages = 4, .most_hz = 200, .one_sender_s = 1});
    inbox_.Open("PICTURE", {.message_bytes = 1000, .queue_messages = 16, .queue_bytes = 1500});
  }
  void Send(SenderAddress from, const std::string& channel, std::size_t bytes, double now_s) {
    const Bytes datagram = ShortDatagram(number_[from]++, channel, Bytes(bytes, 7));
    inbox_.Take({{from, datagram.data(), datagram.size()}}, {1000}, now_s);
  }
  std::vector<std::string> Channels() {
    std::vector<std::string> channels;
    while (auto next = inbox_.Pop()) {
      channels.push_back(next->message.channel);
    }
    return channels;
  }
  ChannelTraffic Of(const std::string& channel, double now_s) {
    for (const ChannelTraffic& row : inbox_.Traffic(now_s).channels) {
      if (row.channel == channel) {
        return row;
      }
    }
    return {};
  }
  BusInbox inbox_;
  std::map<SenderAddress, std::uint32_t> number_;
};

TEST_F(Inbox, MessagesComeOutInTheOrderOfTheirArrival) {
  for (const char* channel : {"POSE", "PICTURE", "POSE", "PICTURE"}) {
    Send(kVehicle, channel, 100, 1);
  }
  EXPECT_EQ(Channels(), (std::vector<std::string>{"POSE", "PICTURE", "POSE", "PICTURE"}));
}

TEST_F(Inbox, AFloodPushesOutNothingButItsOwn) {
  Send(kVehicle, "PICTURE", 100, 1);
  for (int i = 0; i < 1000; ++i) {
    Send(kVehicle, "POSE", 100, 1);
  }
  EXPECT_EQ(Channels(), (std::vector<std::string>{"PICTURE", "POSE", "POSE", "POSE", "POSE"}));
  EXPECT_EQ(Of("POSE", 1).overflowed, 996u);
  EXPECT_EQ(Of("POSE", 1).rate_hz, 1000);
  EXPECT_EQ(Of("PICTURE", 1).overflowed, 0u);
}

TEST_F(Inbox, AQueueIsBoundedInBytesToo) {
  for (int i = 0; i < 3; ++i) {
    Send(kVehicle, "PICTURE", 700, 1);
  }
  EXPECT_EQ(Channels().size(), 2u);
  EXPECT_EQ(Of("PICTURE", 1).overflowed, 1u);
}

TEST_F(Inbox, ASecondSenderIsKeptOutNamedAndForgotten) {
  Send(kVehicle, "POSE", 100, 1.0);
  Send(kStranger, "POSE", 100, 1.1);
  EXPECT_EQ(Of("POSE", 1.1).second_sender, "") << "the first may have fallen silent";
  Send(kVehicle, "POSE", 100, 1.2);
  EXPECT_EQ(Channels().size(), 2u);
  EXPECT_EQ(Of("POSE", 1.2).sender, "10.0.0.2:7001");
  EXPECT_EQ(Of("POSE", 1.2).second_sender, "10.0.0.9:6666");
  EXPECT_EQ(Of("POSE", 1.2).refused, 1u);
  EXPECT_EQ(Of("POSE", 1.2).received, 2u);
  EXPECT_EQ(Of("POSE", 11.2).second_sender, "");
}

TEST_F(Inbox, ARestartedSenderTakesOverWithoutAnAlarm) {
  Send(kVehicle, "POSE", 100, 1.0);
  const SenderAddress restarted{kVehicle.ip, 7002};
  for (double t = 1.5; t < 3; t += 0.1) {
    Send(restarted, "POSE", 100, t);
    EXPECT_EQ(Of("POSE", t).second_sender, "");
  }
  EXPECT_EQ(Of("POSE", 3).sender, "10.0.0.2:7002");
  EXPECT_GT(Of("POSE", 3).received, 9u);
}

// A forged answer would end the repeats of what it answers.
TEST_F(Inbox, AChannelMayBelongToTheSenderOfAnother) {
  inbox_.Open("ANSWER", {.message_bytes = 1001, .with_sender_of = "POSE"});
  Send(kStranger, "ANSWER", 100, 1.0);
  EXPECT_EQ(Channels().size(), 1u) << "nobody is known yet";
  Send(kVehicle, "POSE", 100, 1.0);
  EXPECT_EQ(Channels().size(), 1u);
  Send(kStranger, "ANSWER", 100, 1.1);
  EXPECT_TRUE(Channels().empty());
  EXPECT_EQ(Of("ANSWER", 1.1).refused, 1u);
  Send(kVehicle, "ANSWER", 100, 1.2);
  EXPECT_EQ(Channels().size(), 1u);
}

TEST_F(Inbox, ShareLostIsOfTheSendersInUse) {
  for (const std::uint32_t number : {1u, 2u, 5u, 6u, 10u}) {
    number_[kVehicle] = number;
    Send(kVehicle, "POSE", 100, 1);
  }
  number_[kStranger] = 1;
  Send(kStranger, "PICTURE", 100, 1);
  number_[kStranger] = 5000;
  Send(kStranger, "PICTURE", 100, 1);
  const BusTraffic traffic = inbox_.Traffic(1);
  EXPECT_EQ(traffic.received_of_used, 5u);
  EXPECT_EQ(traffic.lost_of_used, 5u);
  ASSERT_EQ(traffic.senders.size(), 2u);
  EXPECT_EQ(traffic.senders[0].address, "10.0.0.2:7001");
  EXPECT_TRUE(traffic.senders[0].used);
  EXPECT_FALSE(traffic.senders[1].used);
}

TEST_F(Inbox, RefusalsAreKeptAtAFewASecond) {
  for (int i = 0; i < 3000; ++i) {
    Send(kStranger, "POSE", 300, 1 + i * 1e-3);
  }
  const std::vector<RefusedDatagram> kept = inbox_.TakeRefused();
  ASSERT_EQ(kept.size(), 3u);
  EXPECT_EQ(kept[0].like_it, 1u);
  EXPECT_EQ(kept[1].like_it, 1000u) << "those in between are counted";
  EXPECT_EQ(kept[0].sender, "10.0.0.9:6666");
  EXPECT_EQ(kept[0].channel, "POSE");
  EXPECT_EQ(kept[0].reason, "over the channel's size limit");
  EXPECT_EQ(kept[0].bytes, 8u + 5 + 300);
  EXPECT_EQ(kept[0].head.size(), kRefusedBytesKept);
  EXPECT_EQ(kept[0].head[0], 'L');
  EXPECT_TRUE(inbox_.TakeRefused().empty());
  EXPECT_EQ(inbox_.Traffic(4).refused, 3000u);
  EXPECT_EQ(inbox_.Traffic(4).refused_why.at("over the channel's size limit"), 3000u);
}

TEST(ChannelRules, WhatAVehicleSaysOfItselfHasOneSender) {
  const ChannelNames names;
  for (const std::string& channel : names.FromVehicle()) {
    const ChannelLimits limits = LimitsOf(names, channel);
    EXPECT_TRUE(limits.one_sender_s > 0 || limits.with_sender_of == names.vehicle_status)
        << channel;
  }
}

TEST(ChannelRules, EveryChannelThatIsListenedToHasItsOwn) {
  const ChannelNames names;
  std::size_t most = 0;
  for (const auto& channels : {names.FromVehicle(), names.ToVehicle()}) {
    for (const std::string& channel : channels) {
      const ChannelLimits limits = LimitsOf(names, channel);
      EXPECT_NE(limits.message_bytes, ChannelLimits{}.message_bytes) << channel;
      EXPECT_GE(ReassemblerLimits{}.waiting_bytes_per_sender, limits.message_bytes) << channel;
      EXPECT_GE(limits.queue_bytes, limits.message_bytes) << channel;
      most += limits.queue_bytes;
    }
  }
  EXPECT_LE(most + ReassemblerLimits{}.waiting_bytes, 64u << 20) << "all that can ever wait";
}

}  // namespace
}  // namespace palace
