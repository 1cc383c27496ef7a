#include "engine/experiments/thesis_page.h"

#include <functional>
#include <map>
#include <string_view>
#include <utility>

#include "engine/core/check.h"
#include "engine/core/files.h"
#include "engine/experiments/thesis_figures.h"
#include "engine/experiments/thesis_pictures.h"

namespace palace {
namespace {

/// Tables by the name of their experiment.
using Tables = std::map<std::string, TrialFile, std::less<>>;

const Experiment& Named(const std::vector<Experiment>& experiments, std::string_view name) {
  const Experiment* named = nullptr;
  for (const Experiment& experiment : experiments) {
    named = experiment.name == name ? &experiment : named;
  }
  PALACE_CHECK(named != nullptr, name);
  return *named;
}

Result<Tables> ReadTables(const std::vector<Experiment>& experiments,
                          const std::vector<std::string>& paths) {
  Tables tables;
  for (const std::string& path : paths) {
    Result<TrialFile> file = ReadTrials(experiments, path);
    if (!file) {
      return file.error();
    }
    if (!file->header.shard.whole()) {
      return UsageError("thesis: " + path + " is one shard; join them with `evaluate merge` first");
    }
    const std::string name = file->header.experiment;
    if (!tables.emplace(name, std::move(*file)).second) {
      return UsageError("thesis: " + path + ": results of " + name + " were given twice");
    }
  }
  return tables;
}

void AddResult(HtmlPage& page, const Experiment& experiment, const Tables& tables) {
  const auto found = tables.find(experiment.name);
  if (found == tables.end()) {
    page.Paragraph("Here: not run. palacectl evaluate " + experiment.name +
                   " --out DIR, then give DIR.");
    return;
  }
  const TrialHeader& header = found->second.header;
  const ExperimentReport report = experiment.report(found->second.table);
  page.Paragraph("Here: palacectl evaluate " + experiment.name + ", " +
                 std::to_string(header.trials) + " trials, seed " + std::to_string(header.seed) +
                 "; " + header.setup)
      .List(report.lines)
      .Fold("The whole report", report.page);
}

HtmlPage MakePage(const std::vector<Experiment>& experiments, const Tables& tables,
                  const std::vector<ThesisPicture>& pictures) {
  HtmlPage page("The figures of the thesis, and ours");
  page.Paragraph(
      "J. Hintze, Autonomous landing of a rotary unmanned aerial vehicle in a non-cooperative "
      "environment using machine vision, Brigham Young University, 2004: every figure and table "
      "that shows a result, what it reports, and what this program measures for it. Figures of "
      "geometry and screens (1.1 to 2.2, 3.2 to 3.6) and tables of parameters (4.1 to 4.4) have "
      "no result to compare.");
  for (const ThesisFigure& figure : ThesisFigures()) {
    page.Heading(std::string(figure.figure) + ": " + std::string(figure.title))
        .Paragraph("The thesis: " + std::string(figure.found));
    if (!figure.differs.empty()) {
      page.Paragraph("Ours differs: " + std::string(figure.differs));
    }
    for (const ThesisPicture& picture : pictures) {
      if (picture.figure == figure.pictures) {
        page.Picture(picture.file, picture.caption);
      }
    }
    if (!figure.experiment.empty()) {
      AddResult(page, Named(experiments, figure.experiment), tables);
    }
  }
  return page;
}

}  // namespace

Status WriteThesisPage(const std::vector<Experiment>& experiments,
                       const std::vector<std::string>& results, const std::filesystem::path& out,
                       std::uint64_t seed) {
  const Result<Tables> tables = ReadTables(experiments, results);
  if (!tables) {
    return tables.error();
  }
  if (const Status made = MakeFolder(out); !made) {
    return made;
  }
  const auto pictures = WriteThesisPictures(out, seed);
  if (!pictures) {
    return pictures.error();
  }
  return WriteTextFile(out / "thesis.html", MakePage(experiments, *tables, *pictures).Text());
}

}  // namespace palace
