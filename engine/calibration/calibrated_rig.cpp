#include "engine/calibration/calibrated_rig.h"

#include <algorithm>

#include "engine/calibration/calibration_report.h"
#include "engine/core/text.h"

namespace palace {
namespace {

std::string Quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    quoted += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  }
  return quoted + "\"";
}

/// File names may hold line ends, which would leave the comment.
std::string OneLine(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
  return text;
}

}  // namespace

std::string RigToToml(const Calibration& calibration, const RigPictures& pictures) {
  std::string text;
  for (const Criterion& criterion : Acceptance(calibration)) {
    if (!criterion.passed) {
      text += (text.empty() ? "# NOT PASSED: this calibration does not meet every criterion; do "
                              "not fly with it.\n# FAILED: "
                            : "# FAILED: ") +
              OneLine(criterion.text) + "\n";
    }
  }
  text +=
      "# Written by palacectl calibrate. Both models are in the left camera's own axes: x right,\n"
      "# y down, z forward, origin at its projection centre. report.html says how good they are.\n"
      "[left]\nmodel_file = \"left.cahvor\"\n\n[right]\nmodel_file = \"right.cahvor\"\n\n[rig]\n"
      "baseline_m = " +
      WithNumbers("%.6f", calibration.baseline_m()) +
      "\n\n[mount]\ntilt_deg = -45  # how the cameras look out of the aircraft: -90 down, 0 ahead; "
      "set it\n\n"
      "[pose]  # of the aircraft over the ground when pictures were taken; only used for pictures\n"
      "roll_deg = 0  # without a vehicle (analyze, --images), so set it to theirs\n"
      "pitch_deg = 0\nheading_deg = 0\nheight_m = 15.24  # 50 ft\n";
  if (!pictures.left.empty() && !pictures.right.empty()) {
    text +=
        "\n[images]  # the calibration's own pictures, to look at the result; set to yours\n"
        "left = " +
        Quoted(pictures.left) + "\nright = " + Quoted(pictures.right) + "\n";
  }
  return text;
}

}  // namespace palace
