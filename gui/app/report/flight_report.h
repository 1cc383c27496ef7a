// report.html of one flight: figures, settings, events and screenshots on one page.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/faults/fault_injector.h"
#include "engine/runtime/approval_record.h"
#include "engine/runtime/flight_summary.h"

namespace palace {

struct ReportInput {
  std::string title;
  std::vector<std::string> lines;
  std::shared_ptr<const EngineSnapshot> last;
  std::vector<ApprovalRecord> approvals;
  std::vector<std::string> screenshots;  ///< file names beside the report
  std::vector<InjectedFault> faults{};   ///< of a simulated flight
  std::string log_name;                  ///< file name beside the report; empty: not recorded
};

Status WriteReport(const std::filesystem::path& file, const ReportInput& input);

struct AppOptions;
struct Session;
/// report.html in the session's folder, and the pictures of the approvals beside it.
Status WriteFlightReport(const AppOptions& options, const Session& session,
                         const FlightSummary& summary, const std::vector<ApprovalRecord>& approvals,
                         const std::vector<std::string>& screenshots);

}  // namespace palace
