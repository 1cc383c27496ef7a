#include "gui/app/report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "engine/core/hash.h"
#include "gui/app/options.h"
#include "gui/app/session.h"

namespace palace {
namespace {

constexpr const char* kStyle = R"(<style>
body{background:#090c10;color:#e8ecf1;font:15px Roboto,sans-serif;margin:32px auto;max-width:1200px;padding:0 16px}
h1{font-size:24px}h2{font-size:18px;margin-top:32px}table{border-collapse:collapse}
td,th{padding:4px 16px 4px 0;text-align:left;border-bottom:1px solid #2b3541}th{color:#aeb8c4;font-weight:500}
td.n{text-align:right}img{width:100%;border:1px solid #2b3541;border-radius:4px;margin:6px 0 2px}
figcaption{color:#aeb8c4;font-size:13px}figure{margin:0 0 24px}svg{background:#0c1015;width:100%;height:220px}
</style>)";

std::string Escape(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '&':
        out += "&amp;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

/// One polyline of a plot; NaN breaks it.
void AddSeries(std::ostream& out, const std::vector<HistorySample>& samples,
               double (*value)(const HistorySample&), const char* colour, double top) {
  const double span = std::max(1e-3, SecondsBetween(samples.front().time, samples.back().time));
  std::ostringstream points;
  const auto flush = [&] {
    if (!points.str().empty()) {
      out << "<polyline fill=\"none\" stroke=\"" << colour << "\" stroke-width=\"2\" points=\""
          << points.str() << "\"/>\n";
    }
    points.str("");
  };
  for (const HistorySample& sample : samples) {
    const double v = value(sample);
    if (!std::isfinite(v)) {
      flush();
      continue;
    }
    const double x = SecondsBetween(samples.front().time, sample.time) / span * 1000;
    points << x << ',' << 200 - 190 * std::clamp(v / top, 0.0, 1.0) << ' ';
  }
  flush();
}

void AddPlots(std::ostream& out, const std::vector<HistorySample>& samples) {
  if (samples.size() < 2) {
    return;
  }
  out << "<h2>Height above the site, 0 to 20 m</h2><p>blue: estimate, teal: laser slant range, "
         "grey: truth of the body's height</p>\n<svg viewBox=\"0 0 1000 210\" "
         "preserveAspectRatio=\"none\">\n";
  AddSeries(
      out, samples, [](const HistorySample& s) { return -s.truth_p_WB.z(); }, "#8e99a8", 20);
  AddSeries(
      out, samples, [](const HistorySample& s) { return s.laser_m; }, "#54c7b5", 20);
  AddSeries(
      out, samples, [](const HistorySample& s) { return s.height_above_site_m; }, "#5cb2ff", 20);
  out << "</svg>\n<h2>Distance of the skids from the site centre, 0 to 5 m</h2><p>blue: estimate, "
         "pink: GPS, "
         "grey: truth</p>\n<svg viewBox=\"0 0 1000 210\" preserveAspectRatio=\"none\">\n";
  AddSeries(
      out, samples, [](const HistorySample& s) { return s.from_site_truth_m; }, "#8e99a8", 5);
  AddSeries(
      out, samples, [](const HistorySample& s) { return s.from_site_gps_m; }, "#e08fc0", 5);
  AddSeries(
      out, samples, [](const HistorySample& s) { return s.from_site_m; }, "#5cb2ff", 5);
  out << "</svg>\n";
}

void AddEvents(std::ostream& out, const EngineSnapshot& last) {
  if (!last.events || last.events->empty()) {
    return;
  }
  const Timestamp start = last.events->front().time;
  out << "<h2>Events</h2>\n<table><tr><th>Time</th><th>Event</th></tr>\n";
  for (const Event& event : *last.events) {
    char time[32];
    std::snprintf(time, sizeof time, "%.1f s", SecondsBetween(start, event.time));
    out << "<tr><td class=\"n\">" << time << "</td><td>" << Escape(event.text) << "</td></tr>\n";
  }
  out << "</table>\n";
}

void AddSettings(std::ostream& out, const EngineSnapshot& last) {
  out << "<h2>Limits in force, " << ShortHash(last.settings_hash)
      << "</h2>\n<table><tr><th>Setting</th><th>Value</th></tr>\n";
  for (const SettingInfo& info : SettingTable()) {
    out << "<tr><td>" << info.name << "</td><td class=\"n\">"
        << Escape(FormatSetting(info, GetSetting(last.settings, info.name))) << "</td></tr>\n";
  }
  out << "</table>\n";
}

}  // namespace

Status WriteReport(const std::filesystem::path& file, const ReportInput& input) {
  std::ostringstream page;
  page << "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>"
       << Escape(input.title) << "</title>" << kStyle << "</head><body>\n<h1>"
       << Escape(input.title) << "</h1>\n<ul>\n";
  for (const std::string& line : input.lines) {
    page << "<li>" << Escape(line) << "</li>\n";
  }
  page << "</ul>\n";
  if (!input.log_name.empty()) {
    page << "<p>Log: <a href=\"" << Escape(input.log_name) << "\">" << Escape(input.log_name)
         << "</a></p>\n";
  }
  if (input.last) {
    if (input.last->history) {
      AddPlots(page, *input.last->history);
    }
    AddEvents(page, *input.last);
    AddSettings(page, *input.last);
  }
  page << "<h2>Screenshots</h2>\n";
  for (const std::string& shot : input.screenshots) {
    page << "<figure><img src=\"" << Escape(shot) << "\" alt=\"" << Escape(shot)
         << "\"><figcaption>" << Escape(shot) << "</figcaption></figure>\n";
  }
  page << "</body></html>\n";
  std::ofstream out(file, std::ios::trunc);
  out << page.str();
  out.close();
  if (!out) {
    return UnavailableError("cannot write " + file.string() + "; choose a folder you may write to");
  }
  return Ok();
}

Status WriteFlightReport(const AppOptions& options, const Session& session,
                         const FlightSummary& summary,
                         const std::vector<std::string>& screenshots) {
  ReportInput report;
  report.title =
      options.source == SourceChoice::kSimulation
          ? "PALACE flight: scene " + options.scenario + ", seed " + std::to_string(options.seed)
          : "PALACE: " + options.source_path;
  report.lines = SummaryLines(summary);
  report.last = session.engine->Latest();
  report.screenshots = screenshots;
  report.log_name = options.record ? "flight.lcm" : "";
  std::error_code error;
  std::filesystem::create_directories(session.output_dir, error);
  return WriteReport(session.output_dir / "report.html", report);
}

}  // namespace palace
