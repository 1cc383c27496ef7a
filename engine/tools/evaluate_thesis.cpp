#include "engine/tools/evaluate_thesis.h"

#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>

#include "engine/core/command_line.h"
#include "engine/core/files.h"
#include "engine/experiments/thesis_figures.h"
#include "engine/experiments/thesis_pictures.h"

namespace palace {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> results;
  fs::path out;
  std::uint64_t seed = 1;
};

/// Tables by the name of their experiment.
using Tables = std::map<std::string, TrialFile, std::less<>>;

const Experiment* Named(const std::vector<Experiment>& experiments, std::string_view name) {
  for (const Experiment& experiment : experiments) {
    if (experiment.name == name) {
      return &experiment;
    }
  }
  return nullptr;
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
      AddResult(page, *Named(experiments, figure.experiment), tables);
    }
  }
  return page;
}

Status WriteThesisPage(const std::vector<Experiment>& experiments, const Options& options) {
  const Result<Tables> tables = ReadTables(experiments, options.results);
  if (!tables) {
    return tables.error();
  }
  if (const Status made = MakeFolder(options.out); !made) {
    return made;
  }
  const auto pictures = WriteThesisPictures(options.out, options.seed);
  if (!pictures) {
    return pictures.error();
  }
  const fs::path page = options.out / "thesis.html";
  const Status written = WriteTextFile(page, MakePage(experiments, *tables, *pictures).Text());
  if (written) {
    std::cout << "wrote " << page.string() << "\n";
  }
  return written;
}

}  // namespace

void AddEvaluateThesis(CLI::App& evaluate, const std::vector<Experiment>& experiments,
                       int& exit_code) {
  CLI::App* verb = evaluate.add_subcommand(
      "thesis",
      "The thesis's figures beside ours: one page of results that were made before, with "
      "its maps drawn anew");
  auto options = std::make_shared<Options>();
  verb->add_option("results", options->results, "Folders or CSV files of experiments");
  verb->add_option("--out", options->out, "Folder for thesis.html and its pictures")->required();
  verb->add_option("--seed", options->seed, "Seed of the worlds that are drawn")
      ->check(Seed())
      ->capture_default_str();
  verb->callback([experiments, options, &exit_code] {
    const Status done = WriteThesisPage(experiments, *options);
    if (!done) {
      std::cerr << "palacectl: " << done.error().message << "\n";
      exit_code = done.error().code == ErrorCode::kUsage ? 2 : 1;
    }
  });
}

}  // namespace palace
