#include "engine/faults/fault_plan.h"

#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "engine/core/files.h"
#include "engine/core/plain_text.h"
#include "engine/core/text.h"
#include "engine/core/toml_table.h"
#include "engine/faults/fault_text.h"

namespace palace {
namespace {

constexpr double kLongest_s = 1e6;
constexpr NumberLimits kTimes{0, kLongest_s, "give seconds of flight"};

Error TooMany(const std::string& where, std::size_t count) {
  return InvalidError(where + std::to_string(count) + " faults; a flight has " +
                      std::to_string(kMostFaults) + " at most");
}

Result<Fault> ReadFault(const toml::table& row, const std::string& file) {
  TomlTable table = TomlTable::OfList(row, file, "fault");
  for (const char* key : {"value", "channel", "from_s", "to_s"}) {
    table.Allow(key);
  }
  const std::string kind = table.Text("kind");
  Fault fault;
  if (const std::optional<FaultKind> found = FindFaultKind(kind)) {
    fault.kind = *found;
  } else {
    table.FailKey("kind", " = \"" + kind + "\" is no kind; palacectl faults lists them");
  }
  const FaultKindRow& known = RowOf(fault.kind);
  if (table.Has("value") && std::isnan(known.default_value)) {
    table.FailKey("value", std::string(": ") + known.name + " takes none; leave it out");
  } else if (table.Has("value")) {
    const std::string remedy = std::string("give ") + known.unit;
    fault.value = table.Number("value", {known.least, known.most, remedy.c_str()});
  }
  if (table.Has("channel")) {
    const std::string channel = table.Text("channel");
    fault.channel = FindFaultChannel(channel);
    std::vector<std::string> may;
    bool can = false;
    for (const ChannelId id : ChannelsOf(fault.kind)) {
      may.push_back(FaultChannelName(id));
      can = can || fault.channel == id;
    }
    if (!can) {
      table.FailKey("channel", " = \"" + channel + "\": " + known.name +
                                   (may.empty() ? " takes none; leave it out"
                                                : " strikes one of " + Joined(may)));
    }
  }
  fault.from_s = table.NumberOr("from_s", kTimes, 0);
  fault.to_s = table.NumberOr("to_s", kTimes, std::numeric_limits<double>::infinity());
  if (!(fault.to_s > fault.from_s)) {
    table.FailKey("to_s", " = " + NumberText(fault.to_s) +
                              " lies not after from_s = " + NumberText(fault.from_s));
  }
  if (const Status read = table.Finish(); !read) {
    return read.error();
  }
  return fault;
}

}  // namespace

Result<FaultPlan> ParseFaultPlan(std::string_view text, const std::string& name) {
  const Result<toml::table> root = ParseToml(text, name);
  if (!root) {
    return root.error();
  }
  for (const auto& [key, node] : *root) {
    if (key.str() != "fault" || !node.is_array_of_tables()) {
      return InvalidError(name + ":" + std::to_string(node.source().begin.line) + ": " +
                          Printable(key.str()) +
                          " is unknown; a plan of faults has [[fault]] tables alone");
    }
  }
  const toml::array* rows = root->get_as<toml::array>("fault");
  FaultPlan plan;
  if (rows == nullptr) {
    return InvalidError(name + ": no [[fault]] in it; leave the file out to fly without faults");
  }
  if (rows->size() > kMostFaults) {
    return TooMany(name + ": ", rows->size());
  }
  std::string wrong;  // of each fault its first mistake
  for (const toml::node& row : *rows) {
    if (const Result<Fault> fault = ReadFault(*row.as_table(), name)) {
      plan.faults.push_back(*fault);
    } else {
      wrong += (wrong.empty() ? "" : "\n") + fault.error().message;
    }
  }
  return wrong.empty() ? Result<FaultPlan>(plan) : InvalidError(wrong);
}

std::string FaultPlanText(const FaultPlan& plan) {
  std::string text;
  for (const Fault& fault : plan.faults) {
    text += std::string(text.empty() ? "" : "\n") + "[[fault]]\nkind = \"" +
            RowOf(fault.kind).name + "\"\n";
    text += std::isnan(fault.value) ? "" : "value = " + ExactNumber(fault.value) + "\n";
    text += fault.channel ? "channel = \"" + FaultChannelName(*fault.channel) + "\"\n" : "";
    text += fault.from_s == 0 ? "" : "from_s = " + ExactNumber(fault.from_s) + "\n";
    text += std::isfinite(fault.to_s) ? "to_s = " + ExactNumber(fault.to_s) + "\n" : "";
  }
  return text;
}

Result<FaultPlan> LoadFaultPlan(const std::string& file) {
  const Result<std::string> text = ReadTextFile(file);
  return text ? ParseFaultPlan(*text, file) : UsageError(text.error().message);
}

Result<FaultPlan> ReadFaultPlan(const std::string& file, const std::vector<std::string>& texts) {
  FaultPlan plan;
  if (!file.empty()) {
    Result<FaultPlan> read = LoadFaultPlan(file);
    if (!read) {
      return UsageError("--faults: " + read.error().message);
    }
    plan = std::move(*read);
  }
  for (const std::string& text : texts) {
    const Result<Fault> fault = ParseFault(text);
    if (!fault) {
      return fault.error();
    }
    plan.faults.push_back(*fault);
  }
  if (plan.faults.size() > kMostFaults) {
    return TooMany("--fault and --faults together give ", plan.faults.size());
  }
  return plan;
}

}  // namespace palace
