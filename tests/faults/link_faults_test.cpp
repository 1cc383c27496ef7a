#include "engine/faults/link_faults.h"

#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include "engine/wire/convert.h"
#include "tests/faults/fault_rig.h"

namespace palace {
namespace {

using Messages = std::vector<WireMessage>;

constexpr int kBundles = 200;

/// All messages of a flight under one fault.
Messages Struck(const Fault& fault, std::uint64_t seed = 5) {
  LinkFaults faults(seed);
  Messages all;
  for (int i = 0; i < kBundles; ++i) {
    FrameBundle bundle = BundleOfEverything(i);
    for (WireMessage& message :
         faults.Apply(EncodeBundle(bundle, ChannelNames{}), {fault}, 0.1 * i)) {
      all.push_back(std::move(message));
    }
  }
  return all;
}

Messages Whole() { return Struck({.kind = FaultKind::kLost, .value = 0}); }

std::map<std::string, int> Count(const Messages& messages) {
  std::map<std::string, int> counts;
  for (const WireMessage& message : messages) {
    ++counts[message.channel];
  }
  return counts;
}

bool Same(const WireMessage& a, const WireMessage& b) {
  return a.channel == b.channel && a.payload == b.payload;
}

TEST(LinkFaults, AMissingChannelIsMissingAndNothingElse) {
  const auto whole = Count(Whole());
  auto counts = Count(Struck({.kind = FaultKind::kMissing, .channel = ChannelId::kGps}));
  EXPECT_EQ(counts.count("GPS"), 0u);
  counts["GPS"] = whole.at("GPS");
  EXPECT_EQ(counts, whole);
  const auto silence = Count(Struck({.kind = FaultKind::kMissing}));
  EXPECT_EQ(silence.size(), 1u) << "only the truth";
  EXPECT_EQ(silence.count("TRUTH"), 1u);
}

TEST(LinkFaults, LosesDuplicatesAndCorruptsTheShareThatWasAsked) {
  const double total = static_cast<double>(Whole().size() - 5 * kBundles);  // without TRUTH
  for (const double percent : {1.0, 10.0, 30.0, 50.0}) {
    const double sigma = std::sqrt(total * percent / 100 * (1 - percent / 100));
    const double lost = static_cast<double>(
        Whole().size() - Struck({.kind = FaultKind::kLost, .value = percent}).size());
    EXPECT_NEAR(lost, total * percent / 100, 4 * sigma) << percent;
    const double twice = static_cast<double>(
        Struck({.kind = FaultKind::kDuplicated, .value = percent}).size() - Whole().size());
    EXPECT_NEAR(twice, total * percent / 100, 4 * sigma) << percent;
  }
  const Messages whole = Whole(), corrupted = Struck({.kind = FaultKind::kCorrupted, .value = 5});
  ASSERT_EQ(corrupted.size(), whole.size());
  int changed = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    changed += Same(whole[i], corrupted[i]) ? 0 : 1;
  }
  EXPECT_NEAR(changed, 0.05 * total, 4 * std::sqrt(0.05 * 0.95 * total));
}

TEST(LinkFaults, ReorderedMessagesAllArriveInAnotherOrder) {
  const Messages whole = Whole(), reordered = Struck({.kind = FaultKind::kReordered, .value = 20});
  EXPECT_NEAR(static_cast<double>(reordered.size()), static_cast<double>(whole.size()), 8);
  int elsewhere = 0;
  for (std::size_t i = 0; i < reordered.size(); ++i) {
    const auto first = static_cast<std::ptrdiff_t>(i > 60 ? i - 60 : 0);
    const auto last = static_cast<std::ptrdiff_t>(std::min(whole.size(), i + 60));
    EXPECT_TRUE(std::any_of(whole.begin() + first, whole.begin() + last,
                            [&](const WireMessage& m) { return Same(m, reordered[i]); }));
    elsewhere += i < whole.size() && !Same(whole[i], reordered[i]) ? 1 : 0;
  }
  EXPECT_GT(elsewhere, kBundles);
}

TEST(LinkFaults, OneSeedGivesOneStream) {
  const Fault fault{.kind = FaultKind::kLost, .value = 30};
  const Messages a = Struck(fault, 9), b = Struck(fault, 9);
  ASSERT_EQ(a.size(), b.size());
  EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), Same));
  EXPECT_NE(a.size(), Struck(fault, 10).size());
}

}  // namespace
}  // namespace palace
