// A recorded flight of twelve bundles, 0.1 s apart, for the tests that replay it.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "engine/journal/replay_source.h"
#include "engine/wire/convert.h"
#include "tests/journal/journal_world.h"

namespace palace {

class ReplayTest : public JournalTest {
 protected:
  ReplayTest() : flight_(RecordFlight(folder_, 12, 61)) {}
  std::unique_ptr<ReplaySource> Open(ReplayOptions options) {
    auto source = ReplaySource::Open(flight_.log, options);
    EXPECT_TRUE(source.ok()) << source.error().message;
    return std::move(*source);
  }
  static ReplayOptions Fast() {
    ReplayOptions options;
    options.speed = 0;
    return options;
  }
  RecordedFlight flight_;
};

/// Bundles are equal when these are.
inline std::vector<std::vector<std::uint8_t>> Payloads(const FrameBundle& bundle) {
  std::vector<std::vector<std::uint8_t>> payloads;
  for (WireMessage& message : EncodeBundle(bundle, {})) {
    payloads.push_back(std::move(message.payload));
  }
  return payloads;
}

}  // namespace palace
