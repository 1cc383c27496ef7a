// Datagrams become messages, whole or not at all, whatever is sent.
#include <fstream>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "engine/wire/receiver/lcm_reassembler.h"
#include "tests/support/lcm_datagrams.h"

namespace palace {
namespace {

using Outcome = LcmReassembler::Outcome;
constexpr SenderAddress kSender{0x0a000002, 7001};
constexpr std::size_t kPose = 256;
constexpr std::size_t kPicture = 1u << 20;

class Reassembler : public ::testing::Test {
 protected:
  Reassembler() {
    receiver_.Allow("POSE", kPose);
    receiver_.Allow("PICTURE", kPicture);
  }
  LcmReassembler::Taken Take(const Bytes& datagram, SenderAddress from = kSender) {
    LcmReassembler::Taken taken = receiver_.Take(from, datagram.data(), datagram.size(), now_s_);
    if (taken.outcome == Outcome::kMessage) {
      messages_.push_back(taken.message);
    }
    return taken;
  }
  TrafficCount Channel(const std::string& name) const {
    return receiver_.channels().find(name)->second;
  }
  LcmReassembler receiver_;
  std::vector<ReceivedMessage> messages_;
  double now_s_ = 100;
};

Bytes Numbered(std::size_t size, std::uint32_t seed = 1) {
  std::mt19937 random(seed);
  Bytes bytes(size);
  for (std::uint8_t& byte : bytes) {
    byte = static_cast<std::uint8_t>(random());
  }
  return bytes;
}

TEST_F(Reassembler, AShortMessageComesOutAsItWasSent) {
  const Bytes payload = Numbered(144);
  const auto taken = Take(ShortDatagram(7, "POSE", payload));
  ASSERT_EQ(taken.outcome, Outcome::kMessage);
  EXPECT_EQ(taken.message.channel, "POSE");
  EXPECT_EQ(taken.message.payload, payload);
  EXPECT_EQ(taken.message.number, 7u);
  EXPECT_EQ(ToText(taken.message.sender), "10.0.0.2:7001");
  EXPECT_EQ(Take(ShortDatagram(8, "POSE", {})).outcome, Outcome::kMessage);
  EXPECT_EQ(Channel("POSE").messages, 2u);
  EXPECT_EQ(Channel("POSE").bytes, 144u);
  EXPECT_EQ(receiver_.total().lost, 0u);
}

/// What each hostile datagram of the reference gets, as the first of its sender.
TEST_F(Reassembler, EveryHostileDatagramIsRefusedForItsReason) {
  const Bytes name = NameBytes("POSE");
  struct Case {
    const char* what;
    Bytes datagram;
    Refusal reason;
  };
  const std::vector<Case> cases = {
      {"nothing", {}, Refusal::kFormat},
      {"seven bytes", Bytes(7, 0), Refusal::kFormat},
      {"another magic number", Bytes(100, 0x4c), Refusal::kFormat},
      {"header only", ShortDatagram(1, Bytes{}, Bytes{}), Refusal::kChannelName},
      {"no closing zero", ShortDatagram(1, Bytes(5, 'A'), Bytes{}), Refusal::kChannelName},
      {"an empty name", ShortDatagram(1, Bytes{0}, Bytes(8, 1)), Refusal::kChannelName},
      {"a name of 64", ShortDatagram(1, std::string(64, 'A'), {}), Refusal::kChannelName},
      {"a name of 40,000", ShortDatagram(1, std::string(40000, 'A'), {}), Refusal::kChannelName},
      {"a name with a blank", ShortDatagram(1, "PO SE", {}), Refusal::kChannelName},
      {"a name with a control character", ShortDatagram(1, "PO\nSE", {}), Refusal::kChannelName},
      {"a name beyond ASCII", ShortDatagram(1, "PO\xc3\xa4", {}), Refusal::kChannelName},
      {"a pose of 257 bytes", ShortDatagram(1, "POSE", Bytes(257, 0)), Refusal::kTooLarge},
      {"half a fragment's header", Bytes{'L', 'C', '0', '3', 0, 0, 0, 1, 0, 0}, Refusal::kFormat},
      {"43 bytes that claim 63 MB", FragmentDatagram({.size = 63u << 20}, "POSE", Bytes(18, 0)),
       Refusal::kTooLarge},
      {"one fragment of 200 MB", FragmentDatagram({.size = 200u << 20}, "PICTURE", Bytes(18, 0)),
       Refusal::kTooLarge},
      {"4 GiB less one", FragmentDatagram({.size = 0xffffffff}, "PICTURE", Bytes(18, 0)),
       Refusal::kTooLarge},
      {"an offset that wraps 32 bits",
       FragmentDatagram({.size = 1000, .offset = 0xfffffff0, .fragment = 1, .fragments = 2}, "",
                        Bytes(100, 0)),
       Refusal::kOffset},
      {"a part beyond the message",
       FragmentDatagram({.size = 100, .offset = 50, .fragment = 1, .fragments = 2}, "",
                        Bytes(51, 0)),
       Refusal::kOffset},
      {"fragment 5 of 5",
       FragmentDatagram({.size = 100, .fragment = 5, .fragments = 5}, "", Bytes(10, 0)),
       Refusal::kFragment},
      {"of 0 fragments", FragmentDatagram({.size = 10, .fragments = 0}, "POSE", Bytes(10, 0)),
       Refusal::kFragment},
      {"65,535 fragments of 10 bytes",
       FragmentDatagram({.size = 10, .fragment = 1, .fragments = 65535}, "", Bytes(1, 0)),
       Refusal::kFragment},
      {"a part without bytes",
       FragmentDatagram({.size = 10, .fragment = 1, .fragments = 2}, "", {}), Refusal::kFragment},
      {"one fragment that is not whole", FragmentDatagram({.size = 100}, "POSE", Bytes(18, 0)),
       Refusal::kContradiction},
  };
  std::uint16_t port = 1;
  for (const Case& c : cases) {
    const auto taken = Take(c.datagram, {0x0a000003, port++});
    EXPECT_EQ(taken.outcome, Outcome::kRefused) << c.what;
    EXPECT_EQ(taken.reason, c.reason) << c.what << ": " << RefusalWords(taken.reason);
    EXPECT_EQ(receiver_.waiting_bytes(), 0u) << c.what;
  }
  EXPECT_EQ(receiver_.total().refused, cases.size());
  EXPECT_TRUE(messages_.empty());
}

/// The two datagrams that ended liblcm's process.
TEST_F(Reassembler, TheTwoKillingDatagramsAreRefusedAndTheNextMessageComes) {
  Take(FragmentDatagram({.number = 1, .size = 1000, .fragments = 2}, "POSE", Bytes(100, 1)));
  Take(FragmentDatagram(
      {.number = 1, .size = 1000, .offset = 0xffffff00, .fragment = 1, .fragments = 2}, "",
      Bytes(400, 1)));
  EXPECT_TRUE(messages_.empty());
  EXPECT_EQ(Take(ShortDatagram(2, "POSE", Bytes(8, 1))).outcome, Outcome::kMessage);
}

TEST_F(Reassembler, AFragmentTwiceAndAnotherMissingIsNoMessage) {
  const std::vector<Bytes> parts = FragmentDatagrams(1, "PICTURE", Numbered(3000), 1000);
  Take(parts[0]);
  EXPECT_EQ(Take(parts[1]).outcome, Outcome::kPart);
  EXPECT_EQ(Take(parts[1]).outcome, Outcome::kDuplicate);
  EXPECT_EQ(Take(parts[0]).outcome, Outcome::kDuplicate) << "the first twice";
  EXPECT_TRUE(messages_.empty());
  EXPECT_EQ(Take(parts[2]).outcome, Outcome::kMessage);
  EXPECT_EQ(messages_.at(0).payload, Numbered(3000));
  EXPECT_EQ(Take(parts[2]).outcome, Outcome::kDuplicate) << "after the end";
  EXPECT_EQ(Channel("PICTURE").duplicated, 2u) << "one of them told no channel";
  EXPECT_EQ(receiver_.waiting_bytes(), 0u);
}

TEST_F(Reassembler, FragmentsThatContradictEachOtherMakeNoMessage) {
  const std::vector<Bytes> parts = FragmentDatagrams(1, "PICTURE", Numbered(3000), 1000);
  Take(parts[0]);
  const auto refused = [&](const FragmentFields& fields, const Bytes& part) {
    const auto taken = Take(FragmentDatagram(fields, "PICTURE", part));
    return taken.outcome == Outcome::kRefused && taken.reason == Refusal::kContradiction;
  };
  EXPECT_TRUE(refused({1, 3001, 1000, 1, 3}, Bytes(1000, 0))) << "another size";
  EXPECT_TRUE(refused({1, 3000, 1000, 1, 4}, Bytes(1000, 0))) << "another count";
  EXPECT_TRUE(refused({1, 3000, 0, 0, 3}, Bytes(1000, 0))) << "other bytes";
  EXPECT_TRUE(refused({1, 3000, 0, 1, 3}, Bytes(2999, 0))) << "more bytes than the message has";
  EXPECT_EQ(Take(parts[1]).outcome, Outcome::kPart);
  EXPECT_EQ(Take(parts[2]).outcome, Outcome::kMessage) << "the true ones still make it";
  EXPECT_EQ(messages_.at(0).payload, Numbered(3000));
  // Parts that overlap leave a hole elsewhere, though their bytes add up.
  Take(FragmentDatagram({2, 2000, 0, 0, 2}, "PICTURE", Bytes(1000, 0)));
  EXPECT_TRUE(refused({2, 2000, 500, 1, 2}, Bytes(1000, 0)));
  EXPECT_EQ(messages_.size(), 1u);
}

TEST_F(Reassembler, ChannelsNobodyAskedForAreCountedAndNotKept) {
  EXPECT_EQ(Take(ShortDatagram(1, "OTHER", Bytes(100, 0))).outcome, Outcome::kForeign);
  const std::vector<Bytes> parts = FragmentDatagrams(2, "OTHER", Bytes(40u << 20), 60000);
  Take(parts[1]);
  for (const Bytes& part : parts) {
    Take(part);
  }
  EXPECT_EQ(receiver_.waiting_bytes(), 0u);
  EXPECT_EQ(receiver_.total().foreign, 1 + parts.size());
  EXPECT_EQ(receiver_.total().refused, 1u) << "the one ahead of the first told no channel";
  EXPECT_TRUE(messages_.empty());
}

TEST_F(Reassembler, GapsCountAsLostUntilTheMessageComesAfterAll) {
  const auto send = [&](std::uint32_t number) {
    Take(ShortDatagram(number, "POSE", Numbered(8, number)));
  };
  const auto lost = [&] { return receiver_.Senders().at(kSender).count.lost; };
  send(10);
  send(11);
  EXPECT_EQ(lost(), 0u);
  send(15);
  EXPECT_EQ(lost(), 3u);
  send(13);
  EXPECT_EQ(lost(), 2u);
  EXPECT_EQ(Channel("POSE").reordered, 1u);
  send(13);
  EXPECT_EQ(Channel("POSE").duplicated, 1u);
  EXPECT_EQ(lost(), 2u);
  Take(ShortDatagram(13, "POSE", Numbered(8, 99)));
  EXPECT_EQ(messages_.size(), 5u) << "another message under a used number is none of the same";
  send(15 + 200000);
  EXPECT_EQ(lost(), 2u) << "so far ahead it began anew";
  send(1);
  EXPECT_EQ(lost(), 2u);
  send(0xffffffff);
  send(2);
  EXPECT_EQ(lost(), 2u) << "numbers wrap";
}

TEST_F(Reassembler, AMessageOfWhichAPartNeverComesIsGivenUpAndCounted) {
  const std::vector<Bytes> parts = FragmentDatagrams(1, "PICTURE", Numbered(3000), 1000);
  Take(parts[0]);
  Take(parts[1]);
  EXPECT_GT(receiver_.waiting_bytes(), 2000u);
  receiver_.Age(now_s_ + 0.9);
  EXPECT_GT(receiver_.waiting_bytes(), 0u);
  receiver_.Age(now_s_ + 1.1);
  EXPECT_EQ(receiver_.waiting_bytes(), 0u);
  EXPECT_EQ(Channel("PICTURE").lost, 1u);
  EXPECT_EQ(Take(parts[2]).outcome, Outcome::kPart) << "too late";
  EXPECT_EQ(receiver_.waiting_bytes(), 0u);
}

/// Messages of one sender interleave, come in any order and twice: each comes out once, as it was.
TEST(ReassemblerProperty, AnyOrderAndAnyRepetitionGivesExactlyTheMessagesSent) {
  for (std::uint32_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const auto below = [&](std::size_t n) { return random() % n; };
    LcmReassembler receiver;
    receiver.Allow("A", 100000);
    receiver.Allow("B", 100000);
    std::map<std::pair<std::uint16_t, std::uint32_t>, Bytes> sent;
    std::vector<std::pair<SenderAddress, Bytes>> datagrams;
    for (std::uint16_t port = 1; port <= 3; ++port) {
      for (std::uint32_t number = 0; number < 8; ++number) {
        const Bytes payload = Numbered(below(20000), random());
        sent[{port, number}] = payload;
        const std::string channel = below(2) == 0 ? "A" : "B";
        for (const Bytes& datagram :
             below(2) == 0 ? std::vector<Bytes>{1, ShortDatagram(number, channel, payload)}
                           : FragmentDatagrams(number, channel, payload, 1 + below(3000))) {
          for (std::size_t copies = 1 + below(2); copies > 0; --copies) {
            datagrams.push_back({{1, port}, datagram});
          }
        }
      }
    }
    std::shuffle(datagrams.begin(), datagrams.end(), random);
    std::map<std::pair<std::uint16_t, std::uint32_t>, Bytes> got;
    for (const auto& [from, datagram] : datagrams) {
      auto taken = receiver.Take(from, datagram.data(), datagram.size(), 1);
      ASSERT_NE(taken.outcome, Outcome::kRefused) << RefusalWords(taken.reason);
      if (taken.outcome == Outcome::kMessage) {
        ASSERT_TRUE(
            got.try_emplace({from.port, taken.message.number}, taken.message.payload).second);
      }
    }
    ASSERT_EQ(got, sent);
    EXPECT_EQ(receiver.total().lost, 0u);
    EXPECT_EQ(receiver.waiting_bytes(), 0u);
  }
}

/// Rubbish with true headers from many senders: the memory stays within its cap, and a true message
/// still comes out.
TEST(ReassemblerProperty, MemoryNeverExceedsItsCap) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
    const ReassemblerLimits limits{
        .waiting_bytes = 1u << 20, .waiting_bytes_per_sender = 300000, .senders = 8};
    LcmReassembler receiver(limits);
    receiver.Allow("PICTURE", 250000);
    const Bytes picture = Numbered(200000, seed);
    for (std::uint32_t i = 0; i < 5000; ++i) {
      const std::uint32_t size = below(4) == 0 ? random() : below(300000);
      const FragmentFields fields{below(20), size, below(2) == 0 ? below(size + 1) : 0,
                                  static_cast<std::uint16_t>(below(4)),
                                  static_cast<std::uint16_t>(2 + below(60000))};
      const Bytes datagram =
          FragmentDatagram(fields, below(3) == 0 ? "OTHER" : "PICTURE", Bytes(below(3000)));
      receiver.Take({1, static_cast<std::uint16_t>(below(30))}, datagram.data(), datagram.size(),
                    i * 1e-4);
      ASSERT_LE(receiver.waiting_bytes(), limits.waiting_bytes);
      ASSERT_LE(receiver.Senders().size(), limits.senders);
    }
    bool whole = false;
    for (const Bytes& part : FragmentDatagrams(1, "PICTURE", picture, 60000)) {
      auto taken = receiver.Take({2, 2}, part.data(), part.size(), 0.6);
      whole = taken.outcome == Outcome::kMessage && taken.message.payload == picture;
    }
    EXPECT_TRUE(whole);
  }
}

TEST(ReassemblerProperty, ASenderOfOursIsNotForgottenForStrangers) {
  LcmReassembler receiver({.senders = 8});
  receiver.Allow("PICTURE", 250000);
  const Bytes first = ShortDatagram(1, "PICTURE", Bytes(8, 1));
  receiver.Take(kSender, first.data(), first.size(), 0);
  const std::vector<Bytes> parts = FragmentDatagrams(2, "PICTURE", Numbered(100000), 30000);
  std::size_t messages = 0;
  for (const Bytes& part : parts) {
    for (std::uint16_t port = 1; port <= 500; ++port) {
      const Bytes rubbish(20, static_cast<std::uint8_t>(port));
      receiver.Take({7, port}, rubbish.data(), rubbish.size(), 0.1);
    }
    messages += receiver.Take(kSender, part.data(), part.size(), 0.1).outcome == Outcome::kMessage;
  }
  EXPECT_EQ(messages, 1u);
  EXPECT_EQ(receiver.Senders().at(kSender).count.messages, 2u);
}

/// A stranger needs only bytes that look like ours to count as one of ours. Sending more of them
/// than the first sender did must not push that one out.
TEST(ReassemblerProperty, StrangersThatSendMuchDoNotPushOutTheFirst) {
  LcmReassembler receiver({.senders = 8});
  receiver.Allow("PICTURE", 250000);
  const Bytes first = ShortDatagram(1, "PICTURE", Bytes(8, 1));
  receiver.Take(kSender, first.data(), first.size(), 0);
  for (std::uint32_t number = 1; number <= 20; ++number) {
    for (std::uint16_t port = 1; port <= 65; ++port) {
      const Bytes forged = ShortDatagram(number, "PICTURE", Bytes(8, 2));
      receiver.Take({7, port}, forged.data(), forged.size(), 0.1 + 0.01 * number);
    }
  }
  EXPECT_EQ(receiver.Senders().count(kSender), 1u);
}

/// Strangers that were there before it, in all places: who is used stays none the less.
TEST(ReassemblerProperty, WhoIsUsedIsNotForgotten) {
  LcmReassembler receiver({.senders = 8});
  receiver.Allow("PICTURE", 250000);
  double now_s = 0;
  const auto flood = [&] {
    for (std::uint16_t port = 1; port <= 65; ++port) {
      const Bytes forged = ShortDatagram(port, "PICTURE", Bytes(8, 2));
      receiver.Take({7, port}, forged.data(), forged.size(), now_s += 0.001);
    }
  };
  flood();
  std::size_t messages = 0;
  for (std::uint32_t number = 1; number <= 5; ++number) {
    const Bytes pose = ShortDatagram(10 * number, "PICTURE", Bytes(8, 1));
    receiver.Take(kSender, pose.data(), pose.size(), now_s);
    receiver.Keep(kSender, now_s);
    for (const Bytes& part :
         FragmentDatagrams(10 * number + 1, "PICTURE", Numbered(100000), 30000)) {
      flood();
      messages +=
          receiver.Take(kSender, part.data(), part.size(), now_s).outcome == Outcome::kMessage;
    }
  }
  EXPECT_EQ(messages, 5u);
  for (int i = 0; i < 200; ++i) {  // silent: it gives way
    flood();
  }
  EXPECT_EQ(receiver.Senders().count(kSender), 0u);
}

/// An integrator takes the two files into his vehicle: they must need nothing else.
TEST(ReassemblerFiles, NeedTheStandardLibraryOnly) {
  const std::string base = std::string(PALACE_SOURCE_DIR) + "/engine/wire/receiver/lcm_reassembler";
  for (const char* suffix : {".h", ".cpp"}) {
    std::ifstream file(base + suffix);
    ASSERT_TRUE(file.good());
    for (std::string line; std::getline(file, line);) {
      if (line.rfind("#include", 0) == 0 && line.find('"') != std::string::npos) {
        EXPECT_EQ(line, "#include \"engine/wire/receiver/lcm_reassembler.h\"") << suffix;
      }
      EXPECT_EQ(line.rfind("#include <lcm", 0), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace palace
