#include "engine/tools/analyze_report.h"

#include <cmath>
#include <vector>

#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/core/version.h"
#include "engine/model/cell_explanation.h"
#include "engine/model/site_standing.h"
#include "engine/report/html_page.h"
#include "engine/survey/map_pictures.h"

namespace palace {
namespace {

/// "3.1 ± 0.4 °, room 6.9 °": with its three sigma and what is left to the limit.
std::string Against(const Figure& figure, double shown_per_unit, double limit, const char* unit) {
  const std::string value = WithNumbers("%.2f ± %.2f ", figure.value * shown_per_unit,
                                        figure.three_sigma * shown_per_unit);
  return value + unit + WithNumbers(", room %.2f ", limit - figure.value * shown_per_unit) + unit;
}

/// Without the sign of what is nothing.
double Hundredths(double value) { return std::round(100 * value) / 100 + 0.0; }

std::vector<std::vector<std::string>> SiteRows(const SiteSelection& selection,
                                               const SladSettings& slad) {
  std::vector<std::vector<std::string>> rows;
  for (const LandingSite& site : selection.sites) {
    const bool modern = slad.mode == SladMode::kModern;
    rows.push_back({site.letter,
                    WithNumbers("%.2f N, %.2f E, %.2f up", Hundredths(site.p_WS.x()),
                                Hundredths(site.p_WS.y()), Hundredths(site.height_m.value)),
                    WithNumbers("%.2f m to the nearest hazard, %.2f m needed", site.safe_distance_m,
                                site.clear_radius_m),
                    Against(site.slope_rad, kDegPerRad, slad.limits.max_slope_deg, "°"),
                    Against(site.roughness_m, 100, 100 * slad.limits.max_deviation_m, "cm"),
                    modern ? Against(site.step_m, 100, 100 * slad.limits.max_step_m, "cm")
                           : "not in thesis mode",
                    modern ? WithNumbers("%.4f, limit %.4f", site.safe_probability,
                                         slad.limits.min_safe_probability)
                           : "not in thesis mode",
                    site.flags == 0 ? "none" : FlagWords(site.flags),
                    StandingWord(StandingOf(site, slad)) +
                        (site.confirmed ? "" : ": " + WhyProvisional(site, slad)),
                    site.reason});
  }
  return rows;
}

/// What was done with several pairs.
std::string PairsText(const AnalyzeInput& input) {
  return input.pairs_in_map == input.pairs
             ? WithNumbers("%.0f pairs fused in order of time", input.pairs)
             : WithNumbers("%.0f pairs, of which thesis mode takes the last: nothing is fused",
                           input.pairs);
}

std::vector<std::string> Summary(const AnalyzeOutcome& o) {
  const SiteSelection& selection = o.selection();
  const HazardMaps& hazards = o.hazards();
  const GridGeometry& g = o.map().geometry;
  std::vector<std::string> lines;
  lines.push_back(selection.sites.empty()       ? "No landing site: " + selection.none_reason
                  : selection.sites.size() == 1 ? std::string("One landing site, A")
                                                : WithNumbers("%.0f landing sites; the best is A",
                                                              double(selection.sites.size())));
  lines.push_back("From " + Joined(o.files) + ", by palacectl " + kProgramVersion);
  if (o.input.pairs > 1) {
    lines.push_back(PairsText(o.input));
  }
  lines.push_back(WithNumbers("Map of %.0f x %.0f cells of %.3g m", g.rows, g.cols, g.cell_m));
  const RejectedCells& n = hazards.rejected;
  const double all = std::max(1.0, double(g.rows) * g.cols);
  lines.push_back(
      WithNumbers("Cells that could bear the lander: %.1f %%", 100 * hazards.safe_cells / all));
  lines.push_back(
      WithNumbers("Not safe for slope %.1f %%, roughness or step %.1f %%, unknown %.1f %%",
                  100 * n.slope / all, 100 * n.roughness / all, 100 * n.unknown / all));
  lines.push_back(
      WithNumbers("Not safe for a flag (raised surface, water, wire ..) %.1f %%, not sure enough "
                  "%.1f %%, footprint %.1f %%",
                  100 * n.flagged / all, 100 * n.doubtful / all, 100 * n.footprint / all));
  for (const std::string& warning : o.input.warnings) {
    lines.push_back("Warning: " + warning);
  }
  return lines;
}

}  // namespace

std::string AnalyzeReport(const AnalyzeOutcome& o, const std::filesystem::path& folder) {
  const SiteSelection& selection = o.selection();
  HtmlPage page("PALACE: landing sites");
  page.List(Summary(o));
  const auto picture = [&](const char* name, const char* caption) {
    const std::string data = PictureAsDataUri(folder / (std::string(name) + ".png"));
    if (!data.empty()) {
      page.Picture(data, caption);
    }
  };
  picture("overlay",
          "Left picture. Rings: clear radius of each site; cross: the best. Inside the blue rim no "
          "cell "
          "is over a limit by itself, but the lander needs its whole ring there; hatched parts are "
          "over "
          "a limit or unknown.");
  if (!selection.sites.empty()) {
    page.Heading("Sites, best first")
        .Table({"Site", "Place, m", "Room", "Slope", "Roughness", "Step", "Safe probability",
                "Flags", "State", "Why this rank"},
               SiteRows(selection, o.settings.slad));
  }
  page.Heading("Maps").Paragraph("North is up. Grey or black cells of a map are unknown.");
  picture(
      "safe_landing",
      "Ground in relief, lit from the north-west. Blue: safe with room; grey: safe but too near "
      "a hazard; orange: hazard; black: unknown.");
  picture("elevation", "Elevation");
  picture("elevation_sigma", "Standard deviation of the elevation");
  picture("slope", "Slope of the ground plane under the lander");
  picture("roughness", "Roughness: largest deviation from that plane");
  picture("hazard", "Cells over a limit by themselves");
  picture("safe_distance", "Distance to the nearest hazard");
  picture("cost", "Cost");
  std::vector<std::vector<std::string>> rows;
  for (const SettingInfo& info : SettingTable()) {
    if (info.name.rfind("slad.", 0) == 0) {
      rows.push_back(
          {info.label, FormatSetting(info, GetSetting(o.settings, info.name)), info.name});
    }
  }
  page.Heading("Settings").Table({"Setting", "Value", "Name"}, rows);
  std::vector<std::vector<std::string>> times;
  for (const StageTime& time : o.input.watch.times()) {
    times.push_back({time.stage, WithNumbers("%.1f", time.milliseconds)});
  }
  page.Heading("Time").Table({"Stage", "ms"}, times);
  return page.Text();
}

}  // namespace palace
