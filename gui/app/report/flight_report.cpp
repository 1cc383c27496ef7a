#include "gui/app/report/flight_report.h"

#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "engine/core/files.h"
#include "engine/core/hash.h"
#include "engine/faults/fault_text.h"
#include "engine/report/html_page.h"
#include "engine/report/svg_plot.h"
#include "gui/app/options.h"
#include "gui/app/report/approvals.h"
#include "gui/app/session.h"
#include "gui/widgets/number_text.h"

namespace palace {
namespace {

/// One series over the flight, in seconds from its start.
PlotSeries SeriesOf(const char* name, const std::vector<HistorySample>& samples,
                    double (*value)(const HistorySample&)) {
  PlotSeries series;
  series.name = name;
  series.points = false;
  for (const HistorySample& sample : samples) {
    series.x.push_back(SecondsBetween(samples.front().time, sample.time));
    series.y.push_back(value(sample));
  }
  return series;
}

void AddPlots(HtmlPage& page, const std::vector<HistorySample>& samples) {
  if (samples.size() < 2) {
    return;
  }
  LinePlot height{"Height of the skids above the site", "flight time, s", "height, m"};
  height.series = {
      SeriesOf("estimate", samples, [](const HistorySample& s) { return s.height_above_site_m; }),
      SeriesOf("laser, above its spot", samples, [](const HistorySample& s) { return s.laser_m; }),
      SeriesOf("GPS", samples, [](const HistorySample& s) { return s.gps_height_m; }),
      SeriesOf("truth", samples, [](const HistorySample& s) { return s.truth_height_m; })};
  page.Figure(LinePlotSvg(height), "Gaps: not measured then.");
  LinePlot distance{"Distance of the skids from the site's centre", "flight time, s",
                    "distance, m"};
  distance.series = {
      SeriesOf("estimate", samples, [](const HistorySample& s) { return s.from_site_m; }),
      SeriesOf("GPS", samples, [](const HistorySample& s) { return s.from_site_gps_m; }),
      SeriesOf("truth", samples, [](const HistorySample& s) { return s.from_site_truth_m; })};
  page.Figure(LinePlotSvg(distance), "Horizontal distance.");
}

/// What was to fail; when it did stands among the events.
void AddFaults(HtmlPage& page, const std::vector<InjectedFault>& faults) {
  if (faults.empty()) {
    return;
  }
  std::vector<std::vector<std::string>> rows;
  for (const InjectedFault& each : faults) {
    const Fault& fault = each.fault;
    rows.push_back(
        {FaultWords(fault), Fixed(fault.from_s, 1) + " s",
         std::isfinite(fault.to_s) ? Fixed(fault.to_s, 1) + " s" : "the end of the flight",
         RowOf(fault.kind).what, FaultText(fault)});
  }
  page.Heading("Faults injected into this simulated flight")
      .Table({"Fault", "From", "To", "What it is", "As text"}, rows);
}

void AddEvents(HtmlPage& page, const EngineSnapshot& last) {
  if (!last.session->events || last.session->events->empty()) {
    return;
  }
  std::vector<std::vector<std::string>> rows;
  for (const Event& event : *last.session->events) {
    rows.push_back({ClockText(event.time), event.text});
  }
  page.Heading("Events").Table({"Time", "Event"}, rows);
}

void AddSettings(HtmlPage& page, const EngineSnapshot& last) {
  std::vector<std::vector<std::string>> rows;
  for (const SettingInfo& info : SettingTable()) {
    rows.push_back({info.name, FormatSetting(info, GetSetting(last.session->settings, info.name))});
  }
  page.Heading("Limits in force, " + ShortHash(last.session->settings_hash))
      .Table({"Setting", "Value"}, rows);
}

}  // namespace

Status WriteReport(const std::filesystem::path& file, const ReportInput& input) {
  HtmlPage page(input.title);
  page.List(input.lines);
  if (!input.log_name.empty()) {
    page.Link("Log:", input.log_name);
  }
  if (input.last) {
    AddApprovals(page, input.approvals, file.parent_path());
    if (input.last->flight->history) {
      AddPlots(page, *input.last->flight->history);
    }
    AddFaults(page, input.faults);
    AddEvents(page, *input.last);
    AddSettings(page, *input.last);
  }
  if (!input.screenshots.empty()) {
    page.Heading("Screenshots");
  }
  for (const std::string& shot : input.screenshots) {
    page.Picture(shot, shot);
  }
  return WriteTextFile(file, page.Text());
}

Status WriteFlightReport(const AppOptions& options, const Session& session,
                         const FlightSummary& summary, const std::vector<ApprovalRecord>& approvals,
                         const std::vector<std::string>& screenshots) {
  ReportInput report;
  report.title =
      options.source == SourceChoice::kSimulation
          ? "PALACE flight: scene " + options.scenario + ", seed " + std::to_string(options.seed)
          : "PALACE: " + options.source_path;
  report.lines = SummaryLines(summary);
  report.last = session.engine->Latest();
  report.approvals = approvals;
  report.faults = session.faulted ? session.faulted->faults().Faults() : report.faults;
  if (report.last && !report.last->session->authority.fingerprint.empty()) {
    const AuthorityStatus& authority = report.last->session->authority;
    report.lines.push_back("Key " + authority.key_name + ", fingerprint " + authority.fingerprint);
  }
  report.screenshots = screenshots;
  report.log_name = options.record ? "flight.lcm" : "";
  if (const Status made = MakeFolder(session.output_dir); !made) {
    return made;
  }
  return WriteReport(session.output_dir / "report.html", report);
}

}  // namespace palace
