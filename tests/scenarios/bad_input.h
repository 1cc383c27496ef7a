// Rows of bad input: a command line, its exit code, and what its one message says.
#pragma once

#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/scenarios/scenario.h"

namespace palace {

struct BadInput {
  const char* name;
  bool station;  ///< palace, else palacectl
  std::vector<std::string> arguments;
  int exit_code;
  std::vector<std::string> said;  ///< parts of the one message: the thing, the remedy
  std::vector<std::pair<std::string, std::string>> environment = {};
};

inline void PrintTo(const BadInput& row, std::ostream* out) { *out << row.name; }

/// A folder with all that is wrong.
class BadInputs : public Scenario, public testing::WithParamInterface<BadInput> {
 protected:
  BadInputs();
  void WriteCameras(const std::string& name, const std::string& left, const std::string& right);
  /// The good rig with one thing changed.
  void WriteRig(const std::string& name, const std::string& from, const std::string& to);
  std::set<std::string> Files() const;
};

/// Names a row in the list of tests.
inline std::string NameOfRow(const testing::TestParamInfo<BadInput>& info) {
  return info.param.name;
}

/// `palace --headless` with more words.
inline std::vector<std::string> H(std::vector<std::string> words) {
  words.insert(words.begin(), "--headless");
  return words;
}

}  // namespace palace
