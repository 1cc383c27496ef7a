// What the scenarios share: a folder of their own, the two programs, and what a flight left.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "engine/journal/replay_source.h"
#include "tests/support/own_path.h"
#include "tests/support/process.h"

namespace palace {

/// A folder of its own for each test, removed afterwards; programs run in it.
class Scenario : public testing::Test {
 protected:
  Scenario() {
    folder_ = OwnPath();
    std::filesystem::create_directories(folder_);
  }
  ~Scenario() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  std::filesystem::path WriteFile(const std::string& name, std::string_view content) const {
    const std::filesystem::path path = folder_ / name;
    std::ofstream(path, std::ios::binary) << content;
    return path;
  }
  ProcessOptions Palace(std::vector<std::string> arguments) const {
    return Command(PALACE_PROGRAM, std::move(arguments));
  }
  ProcessOptions Palacectl(std::vector<std::string> arguments) const {
    return Command(PALACECTL_PROGRAM, std::move(arguments));
  }

  std::filesystem::path folder_;

 private:
  ProcessOptions Command(const char* program, std::vector<std::string> arguments) const {
    ProcessOptions options;
    options.command = std::move(arguments);
    options.command.insert(options.command.begin(), program);
    options.without = {"DISPLAY", "WAYLAND_DISPLAY"};
    options.folder = folder_;
    return options;
  }
};

/// The folders of flights below a record folder.
inline std::vector<std::filesystem::path> FlightsIn(const std::filesystem::path& records) {
  std::vector<std::filesystem::path> flights;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(records, none)) {
    flights.push_back(entry.path());
  }
  return flights;
}

inline std::unique_ptr<ReplaySource> OpenLog(const std::filesystem::path& log) {
  ReplayOptions options;
  options.speed = 0;
  auto source = ReplaySource::Open(log, options);
  EXPECT_TRUE(source.ok()) << (source.ok() ? "" : source.error().message);
  return source.ok() ? std::move(*source) : nullptr;
}

/// The states a flight went through, in order, without repetition.
inline std::vector<MissionState> StatesOf(const FlightRecord& record) {
  std::vector<MissionState> states;
  for (const FlightRecordSample& sample : record.samples) {
    if (states.empty() || states.back() != sample.state) {
      states.push_back(sample.state);
    }
  }
  return states;
}

}  // namespace palace
