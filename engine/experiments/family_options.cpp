#include "engine/experiments/family_options.h"

#include <string_view>

#include <CLI/CLI.hpp>

#include "engine/core/text.h"
#include "engine/world/families/families.h"

namespace palace {

void FamilyOptions::Add(CLI::App& app) {
  app.add_option("--family", only,
                 "Only this family; may be given again. Default: all of palacectl worlds")
      ->check([](const std::string& name) {
        return IsFamily(name) ? std::string()
                              : "no family is called \"" + name +
                                    "\"; known: " + Joined(FamilyOptions{}.Families());
      });
}

std::vector<std::string> FamilyOptions::Families() const {
  const std::vector<std::string_view> all = FamilyNames();
  return only.empty() ? std::vector<std::string>(all.begin(), all.end()) : only;
}

std::string FamilyOptions::Text() const { return "families " + Joined(Families()); }

}  // namespace palace
