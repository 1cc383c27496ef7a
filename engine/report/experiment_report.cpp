#include "engine/report/experiment_report.h"

namespace palace {

void ExperimentReport::Judge(bool met, const std::string& text) {
  page.Verdict(met, text);
  lines.push_back((met ? "passed: " : "FAILED: ") + text);
  passed = passed && met;
}

}  // namespace palace
