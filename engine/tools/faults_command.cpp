#include "engine/tools/faults_command.h"

#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "engine/core/text.h"
#include "engine/faults/fault_plan.h"
#include "engine/faults/fault_text.h"

namespace palace {
namespace {

std::string ValueWords(const FaultKindRow& row) {
  if (std::isnan(row.default_value)) {
    return "-";
  }
  return NumberText(row.default_value) + " " + row.unit + " (" + NumberText(row.least) + " to " +
         NumberText(row.most) + ")";
}

void PrintKinds() {
  std::printf("%-20s %-13s %-40s %s\n", "kind", "verb", "value: default and range", "what it does");
  for (const FaultKindRow& row : FaultKindTable()) {
    std::printf("%-20s %-13s %-40s %s\n", row.name, FaultVerbName(row.verb),
                ValueWords(row).c_str(), row.what);
  }
  std::vector<std::string> cameras, channels;
  for (const ChannelId id : ChannelsOf(FaultKind::kCameraBlack)) {
    cameras.push_back(FaultChannelName(id));
  }
  for (const ChannelId id : ChannelsOf(FaultKind::kMissing)) {
    channels.push_back(FaultChannelName(id));
  }
  std::printf(
      "\nA fault is kind[=value][@CHANNEL][:from-to], from and to in seconds of true flight:\n"
      "  gps_jump=3:20-30   missing@GPS:12-   camera_black@CAMERA_LEFT:5-8\n"
      "Channels of camera_...: %s; of missing, lost, corrupted, reordered,\n"
      "duplicated: %s.\n"
      "Without one, both cameras, or all of them; the other kinds take none.\n"
      "A camera that drops pictures: lost=30@CAMERA_LEFT; one that starts up late:\n"
      "camera_late=0.1@CAMERA_LEFT; a laser that is off: missing@LASER_RANGE; no GPS:\n"
      "missing@GPS.\n",
      Joined(cameras).c_str(), Joined(channels).c_str());
}

int ShowPlan(const std::string& file) {
  const Result<FaultPlan> plan = LoadFaultPlan(file);
  if (!plan) {
    std::cerr << "palacectl faults: " << plan.error().message << "\n";
    return plan.error().code == ErrorCode::kUsage ? 2 : 1;
  }
  for (const Fault& fault : plan->faults) {
    std::printf("%-36s %s\n", FaultText(fault).c_str(), FaultWords(fault).c_str());
  }
  return 0;
}

}  // namespace

void AddFaultsCommand(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "faults", "List what can fail in a simulated flight, or check a file of faults");
  const auto file = std::make_shared<std::string>();
  command->add_option("file", *file, "A plan of faults (TOML) to check and show as text");
  command->callback([file, &exit_code] {
    if (file->empty()) {
      PrintKinds();
      exit_code = 0;
    } else {
      exit_code = ShowPlan(*file);
    }
  });
}

}  // namespace palace
