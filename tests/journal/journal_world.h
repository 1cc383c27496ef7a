// A scratch folder and small logs, for the tests of the journal.
#pragma once

#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <climits>
#include <gtest/gtest.h>

#include "engine/journal/flight_recorder.h"
#include "tests/support/own_path.h"
#include "tests/wire/wire_samples.h"

namespace palace {

/// A folder of its own for each test, removed afterwards.
class JournalTest : public ::testing::Test {
 protected:
  JournalTest() {
    folder_ = OwnPath();
    std::filesystem::create_directories(folder_);
  }
  ~JournalTest() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  std::filesystem::path folder_;
};

inline std::vector<std::uint8_t> ReadBytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

inline void WriteBytes(const std::filesystem::path& path, const std::vector<std::uint8_t>& bytes) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
}

/// Everything a flight leaves: bundles, commands before some of them, outputs after each.
struct RecordedFlight {
  std::vector<RecordItem> items;
  std::filesystem::path log;
};

/// From bundle `restart` on the vehicle's clock runs anew.
inline RecordedFlight RecordFlight(const std::filesystem::path& folder, int bundles,
                                   std::uint64_t seed, int restart = INT_MAX) {
  RandomStream random(seed);
  RecordedFlight flight;
  const auto rig = std::make_shared<const StereoRig>(RandomRig(random));
  auto recorder = FlightRecorder::Open(folder, "flight", {});
  EXPECT_TRUE(recorder.ok()) << recorder.error().message;
  auto events = std::make_shared<std::vector<Event>>();
  for (int i = 0; i < bundles; ++i) {
    RecordItem item;
    item.bundle =
        RandomBundle(random, static_cast<std::uint64_t>(i < restart ? i : i - restart), rig);
    if (i % 3 == 1) {
      item.commands.push_back(
          {CommandOrigin::kOperator, SetSetting{"slad.max_slope_deg", 5.0 + i}});
      item.commands.push_back({CommandOrigin::kScript, ApproveSite{random.NextBits(), 4}});
    }
    auto snapshot = std::make_shared<EngineSnapshot>(RandomSnapshot(random, *item.bundle));
    events->push_back({item.bundle->time, EventKind::kState, "event " + std::to_string(i),
                       static_cast<std::uint64_t>(i + 1)});
    snapshot->session.Edit().events = std::make_shared<const std::vector<Event>>(*events);
    item.snapshot = snapshot;
    PositionEstimate estimate;
    estimate.time = item.bundle->time;
    estimate.source = EstimateSource::kGps;
    estimate.p_WB = RandomVector(random);
    item.sent.emplace_back(std::in_place_type<PositionEstimate>, estimate);
    const Status recorded = (*recorder)->Record(item);
    EXPECT_TRUE(recorded.ok());
    flight.items.push_back(std::move(item));
  }
  EXPECT_TRUE((*recorder)->Close().ok());
  flight.log = (*recorder)->Path();
  return flight;
}

}  // namespace palace
