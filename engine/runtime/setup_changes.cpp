#include "engine/runtime/setup_changes.h"

namespace palace {
namespace {

std::vector<std::string> Between(const SimulationSetup& was, const SimulationSetup& is) {
  std::vector<std::string> changes;
  for (const SimulationRow& row : SimulationTable()) {
    const std::string before = FormatSetting(row.info, was.*row.field);
    const std::string now = FormatSetting(row.info, is.*row.field);
    if (before != now) {
      changes.push_back(row.info.label + ": " + before + " to " + now);
    }
  }
  return changes;
}

}  // namespace

std::vector<std::string> SetupChanges::Note(const SimulationSetup& in_force, Timestamp now) {
  if (!told_) {
    told_ = in_force;
  }
  const double since_s = told_at_ ? SecondsBetween(*told_at_, now) : kEvery_s;
  if (since_s >= 0 && since_s < kEvery_s) {
    return {};
  }
  std::vector<std::string> changes = Between(*told_, in_force);
  if (!changes.empty()) {
    told_ = in_force;
    told_at_ = now;
  }
  return changes;
}

}  // namespace palace
