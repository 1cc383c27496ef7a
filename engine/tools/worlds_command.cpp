#include "engine/tools/worlds_command.h"

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "engine/core/command_line.h"
#include "engine/experiments/world_gallery.h"
#include "engine/world/families/families.h"
#include "engine/world/scene_library.h"

namespace palace {
namespace {

struct WorldsOptions {
  std::string gallery;
  std::vector<std::string> families;
  std::uint64_t seed = 1;
};

int Fail(const Error& error) {
  std::cerr << "palacectl worlds: " << error.message << "\n";
  return error.code == ErrorCode::kUsage ? 2 : 1;
}

void List() {
  std::printf("Plain scenes, on flat ground with a clear place for certain:\n ");
  for (const std::string_view name : PlainSceneNames()) {
    std::printf(" %s", std::string(name).c_str());
  }
  std::printf("\nFamilies, drawn from the seed (--gallery shows them):\n");
  for (const std::string_view name : FamilyNames()) {
    std::printf("  %-12s %s\n", std::string(name).c_str(),
                std::string(FamilySummary(name)).c_str());
  }
  std::printf("To be searched:\n  %-12s %s\n", "search",
              "80 by 80 m of hazards with one safe place, mostly out of sight");
}

int Worlds(const WorldsOptions& options) {
  if (options.gallery.empty()) {
    List();
    return 0;
  }
  WorldGallery gallery;
  gallery.folder = options.gallery;
  gallery.seed = options.seed;
  gallery.families = options.families;
  if (gallery.families.empty()) {
    for (const std::string_view name : FamilyNames()) {
      gallery.families.emplace_back(name);
    }
  }
  for (const std::string& name : gallery.families) {
    if (const Result<World> world = IsFamily(name) ? World{} : MakeFamily(name, 1); !world) {
      return Fail(world.error());
    }
  }
  const std::filesystem::path page = gallery.folder / "gallery.html";
  std::error_code none;
  const bool replaces = std::filesystem::exists(page, none);
  const Status written = WriteWorldGallery(gallery, [](const std::string& family) {
    std::printf("%s\n", family.c_str());
    std::fflush(stdout);
  });
  if (!written) {
    return Fail(written.error());
  }
  if (replaces) {
    std::cerr << "palacectl: warning: an earlier gallery in " << options.gallery
              << " was replaced\n";
  }
  std::printf("%s\n", page.string().c_str());
  return 0;
}

}  // namespace

void AddWorldsCommand(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "worlds", "List the simulated worlds; with --gallery draw them and their truth");
  const auto options = std::make_shared<WorldsOptions>();
  CLI::Option* gallery = command->add_option(
      "--gallery", options->gallery,
      "Folder for a page with each family's left picture at 8, 15 and 30 m and its truth map");
  command->add_option("--family", options->families, "Only these; may be repeated")->needs(gallery);
  command->add_option("--seed", options->seed, "One seed, one world")
      ->check(Seed())
      ->needs(gallery);
  command->callback([options, &exit_code] { exit_code = Worlds(*options); });
}

}  // namespace palace
