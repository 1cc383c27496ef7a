#include "engine/experiments/ground_report.h"

#include <array>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include "engine/core/text.h"
#include "engine/experiments/ground_field.h"
#include "engine/experiments/hidden_fit.h"
#include "engine/report/figure_text.h"
#include "engine/slad/hazards/hidden_things.h"

namespace palace {
namespace {

int Count(const TrialTable& table, const char* kind) {
  return static_cast<int>(table.Where("kind", kind).rows.size());
}

/// Those whose verdict is that or worse.
int AtLeast(const TrialTable& table, SiteTruth::Verdict verdict) {
  int count = 0;
  for (int i = static_cast<int>(verdict); i < kSiteVerdictCount; ++i) {
    count += static_cast<int>(
        table.Where("verdict", SiteVerdictName(static_cast<SiteTruth::Verdict>(i))).rows.size());
  }
  return count;
}

std::string Share(int hits, int trials) { return ShareText(hits, trials, 1); }

/// Fields, by their first row, of which `column` reads 1, and those of them with a site.
std::array<int, 2> Offered(const TrialTable& table, const char* column) {
  std::array<int, 2> counts{};
  const std::vector<double> rank = table.Numbers("rank"), in_view = table.Numbers(column);
  for (std::size_t i = 0; i < rank.size(); ++i) {
    if (rank[i] <= 1 && in_view[i] > 0.5) {
      ++counts[0];
      counts[1] += rank[i] > 0.5 ? 1 : 0;
    }
  }
  return counts;
}

std::vector<std::string> RowOfReport(const std::string& name, const TrialTable& table) {
  const TrialTable confirmed = table.Where("kind", "confirmed"),
                   provisional = table.Where("kind", "provisional"),
                   looks = table.Where("kind", "look");
  const int n = Count(table, "confirmed"), m = Count(table, "provisional"),
            k = Count(table, "look");
  const auto safe = Offered(table, "safe_in_view"), easy = Offered(table, "easy_in_view");
  using V = SiteTruth::Verdict;
  return {name,
          Share(AtLeast(confirmed, V::kOver), n),
          Share(AtLeast(confirmed, V::kUnsafe), n),
          Share(AtLeast(confirmed, V::kGrosslyUnsafe), n),
          Share(AtLeast(provisional, V::kUnsafe), m),
          Share(AtLeast(looks, V::kUnsafe), k),
          Share(safe[1], safe[0]),
          Share(easy[1], easy[0])};
}

std::vector<JudgedSite> JudgedSites(const TrialTable& table) {
  std::vector<JudgedSite> sites;
  const std::size_t family = table.Index("family"), verdict = table.Index("verdict");
  std::vector<std::vector<double>> hidden;
  for (const double density : kHiddenDensities) {
    hidden.push_back(table.Numbers(HiddenColumn(density)));
  }
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    JudgedSite site{table.rows[i][family], {}, false};
    for (const std::vector<double>& of_density : hidden) {
      site.hidden.push_back(of_density[i]);
    }
    const std::string& is = table.rows[i][verdict];
    site.unsafe = is == SiteVerdictName(SiteTruth::Verdict::kUnsafe) ||
                  is == SiteVerdictName(SiteTruth::Verdict::kGrosslyUnsafe);
    if (!std::isnan(site.hidden.front())) {
      sites.push_back(std::move(site));
    }
  }
  return sites;
}

/// Probabilities said against the share of sites that were safe, in bins.
void AddCalibration(const TrialTable& table, HtmlPage& page) {
  constexpr double kEdges[] = {0, 0.5, 0.7, 0.8, 0.9, 0.95, 0.98, 1.0001};
  const std::vector<double> said = table.Numbers("probability");
  const std::size_t verdict = table.Index("verdict");
  std::vector<std::vector<std::string>> rows;
  for (std::size_t k = 0; k + 1 < std::size(kEdges); ++k) {
    double sum = 0;
    int count = 0, safe = 0;
    for (std::size_t i = 0; i < said.size(); ++i) {
      if (said[i] >= kEdges[k] && said[i] < kEdges[k + 1]) {
        const std::string& is = table.rows[i][verdict];
        sum += said[i];
        ++count;
        safe += is == SiteVerdictName(SiteTruth::Verdict::kWithin) ||
                        is == SiteVerdictName(SiteTruth::Verdict::kOver)
                    ? 1
                    : 0;
      }
    }
    if (count > 0) {
      rows.push_back({WithNumbers("%.2f to ", kEdges[k]) + WithNumbers("%.2f", kEdges[k + 1]),
                      WithNumbers("%.3f", sum / count), Share(safe, count)});
    }
  }
  page.Heading("Probability said and found").Table({"Said", "Mean", "Safe up to 1.2 x"}, rows);
}

void AddLeaveOneOut(const TrialTable& table, ExperimentReport& report) {
  const std::vector<JudgedSite> sites = JudgedSites(table);
  const std::vector<LeftOut> left_out = LeaveOneOut(sites);
  if (left_out.empty()) {
    return;
  }
  std::vector<std::vector<std::string>> rows;
  for (const LeftOut& one : left_out) {
    rows.push_back({one.family, WithNumbers("%.4f", one.things_per_m2),
                    WithNumbers("%.1f %%", 100 * one.said_unsafe), Share(one.unsafe, one.sites)});
  }
  report.lines.push_back("Hidden rocks and holes a square metre, fitted on all these sites: " +
                         WithNumbers("%.4f, in force %.4f", FitDensity(sites), kThingsPer_m2));
  report.page.Heading("Leave one family out")
      .Paragraph(
          "Rocks and holes hidden a square metre, fitted on the sites of all other families; by it "
          "the mean chance that something over 1.2 times a limit hides under a site of this "
          "family, and the share of its sites that were so. Nothing else is fitted.")
      .Table({"Family left out", "Fitted, 1/m2", "Said unsafe", "Unsafe"}, rows);
}

/// The best place of each field, one row for all who propose one. Ours counts twice: as it is
/// listed, and without places that are only to be looked at first.
void AddOthers(const TrialTable& table, ExperimentReport& report) {
  const std::size_t kind = table.Index("kind");
  const auto row = [&](const std::string& name, const TrialTable& first) {
    int offered = 0, unsafe = 0, gross = 0, nowhere = 0;
    const auto safe = Offered(first, "safe_in_view");
    for (const char* is : {"confirmed", "provisional", "look", "place"}) {
      const TrialTable of_kind = first.Where("kind", is);
      offered += static_cast<int>(of_kind.rows.size());
      unsafe += AtLeast(of_kind, SiteTruth::Verdict::kUnsafe);
      gross += AtLeast(of_kind, SiteTruth::Verdict::kGrosslyUnsafe);
      nowhere += static_cast<int>(of_kind.Where("family", "nowhere").rows.size());
    }
    return std::vector<std::string>{
        name,
        Share(offered, static_cast<int>(first.rows.size())),
        Share(safe[1], safe[0]),
        Share(unsafe, offered),
        Share(gross, offered),
        Share(nowhere, static_cast<int>(first.Where("family", "nowhere").rows.size()))};
  };
  std::vector<std::vector<std::string>> rows;
  for (const std::string& by : table.Values("by")) {
    const TrialTable all = table.Where("by", by);
    const std::vector<double> rank = all.Numbers("rank");
    TrialTable first{.columns = all.columns, .rows = {}}, best = first;
    for (std::size_t i = 0; i < all.rows.size(); ++i) {
      if (rank[i] <= 1) {
        first.rows.push_back(all.rows[i]);
        best.rows.push_back(all.rows[i]);
      } else if (!best.rows.empty() && best.rows.back()[kind] == "look") {
        // The list runs by rank: the first that is not to be looked at first.
        best.rows.back() = all.rows[i];
        best.rows.back()[all.Index("rank")] = "1";
      }
    }
    rows.push_back(row(by, first));
    if (by == kByPalace) {
      for (std::vector<std::string>& place : best.rows) {
        if (place[kind] == "look") {
          place[kind] = "none";
          place[all.Index("rank")] = "0";
        }
      }
      rows.push_back(row(by + std::string(", best but \"look first\""), best));
    }
  }
  if (rows.size() <= 2) {
    return;
  }
  report.page.Heading("Best place of each field, by whose rule")
      .Paragraph(
          "The best place of a field by each rule, on the same pictures and judged alike, over "
          "this vehicle's whole clear disc. thesis: the thesis's SLAD on the newest pair. raster, "
          "auterion, alhat: on the fused map; px4: on the points of all frames. Rules are those of "
          "their authors, in our own words (landing_peers.h); the vehicles that they were made for "
          "are other ones.")
      .Table({"Rule", "Fields with a place", "Safe disc in view: offered", "Over 1.2 x",
              "Over 1.5 x", "nowhere: offered"},
             rows);
  for (const std::vector<std::string>& one : rows) {
    report.lines.push_back("Best place by " + one[0] + ": over 1.2 times a limit " + one[3] +
                           "; offered where a safe disc is in view " + one[2] + "; in nowhere " +
                           one[5]);
  }
}

}  // namespace

std::string HiddenColumn(double density) { return "hidden_" + CsvNumber(density); }

ExperimentReport ReportOfGround(const TrialTable& all_places) {
  const TrialTable table = all_places.Where("by", kByPalace);
  ExperimentReport report{HtmlPage("PALACE: sites on every family of worlds")};
  std::vector<std::vector<std::string>> rows;
  for (const std::string& family : table.Values("family")) {
    rows.push_back(RowOfReport(family, table.Where("family", family)));
  }
  for (const std::string& height : table.Values("height_m")) {
    rows.push_back(RowOfReport(height + " m", table.Where("height_m", height)));
  }
  rows.push_back(RowOfReport("all", table));
  const std::vector<std::string>& all = rows.back();
  const TrialTable nowhere = table.Where("family", "nowhere");
  const int offered =
      Count(nowhere, "confirmed") + Count(nowhere, "provisional") + Count(nowhere, "look");
  const int gross = AtLeast(table.Where("kind", "confirmed"), SiteTruth::Verdict::kGrosslyUnsafe);
  report.passed = gross == 0 && offered == 0;
  report.lines = {"Confirmed sites over a limit: " + all[1],
                  "Confirmed sites over 1.2 times a limit (unsafe): " + all[2],
                  "Confirmed sites over 1.5 times a limit (grossly unsafe): " + all[3],
                  "Provisional sites over 1.2 times a limit: " + all[4],
                  "Places to look at first over 1.2 times a limit: " + all[5],
                  "Fields with a safe disc in view that are offered a site: " + all[6],
                  "Fields with an easy disc in view that are offered a site: " + all[7],
                  "Sites offered where nothing is safe (nowhere): " + WithNumbers("%.0f", offered)};
  report.page.List(report.lines)
      .Paragraph(
          "Shares with 95 % intervals (Wilson). A site is judged by the worst touchdown within the "
          "navigation error of its middle; limits as set. Water and what moves count as grossly "
          "unsafe. An easy disc keeps six tenths of every limit. Sites of one field are related.")
      .Table({"Family or height", "Confirmed: over a limit", "Confirmed: over 1.2 x",
              "Confirmed: over 1.5 x", "Provisional: over 1.2 x", "Look first: over 1.2 x",
              "Safe disc in view: offered", "Easy disc in view: offered"},
             rows);
  AddCalibration(table, report.page);
  AddLeaveOneOut(table, report);
  AddOthers(all_places, report);
  return report;
}

}  // namespace palace
