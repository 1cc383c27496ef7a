// --family: which families of worlds an experiment runs over.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace palace {

struct FamilyOptions {
  std::vector<std::string> only{};  ///< none: all

  void Add(CLI::App& app);
  std::vector<std::string> Families() const;
  /// What a report says of them: "families rocks, kerbs".
  std::string Text() const;
};

}  // namespace palace
