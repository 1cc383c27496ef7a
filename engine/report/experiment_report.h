// What an experiment says: a page, lines for the terminal, and whether all that is asked was met.
#pragma once

#include <string>
#include <vector>

#include "engine/report/html_page.h"

namespace palace {

struct ExperimentReport {
  HtmlPage page;
  std::vector<std::string> lines{};  ///< for the terminal
  bool passed = true;                ///< false: exit code 1

  /// One thing that is asked: told on the page and, as "passed: " or "FAILED: ", on the terminal.
  void Judge(bool met, const std::string& text);
};

}  // namespace palace
