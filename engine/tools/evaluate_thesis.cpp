#include "engine/tools/evaluate_thesis.h"

#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "engine/core/command_line.h"
#include "engine/experiments/thesis_page.h"

namespace palace {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> results;
  fs::path out;
  std::uint64_t seed = 1;
};

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
    const Status done = WriteThesisPage(experiments, options->results, options->out, options->seed);
    if (done) {
      std::cout << "wrote " << (options->out / "thesis.html").string() << "\n";
    } else {
      std::cerr << "palacectl: " << done.error().message << "\n";
      exit_code = done.error().code == ErrorCode::kUsage ? 2 : 1;
    }
  });
}

}  // namespace palace
