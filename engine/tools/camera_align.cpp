// palacectl camera align.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "engine/camera/alignment.h"
#include "engine/camera/cahvor.h"
#include "engine/camera/camera_pair.h"
#include "engine/core/files.h"
#include "engine/tools/camera_verbs.h"

namespace palace {
namespace {

bool IsCahv(const CameraModel& model) {
  const auto* cahvor = std::get_if<CahvorModel>(&model.lens);
  return cahvor != nullptr && IsLinear(*cahvor);
}

}  // namespace

int RunCameraAlign(const CameraOptions& options) {
  const std::filesystem::path folder = options.out;
  for (const char* name : {"left.cahv", "right.cahv"}) {
    if (const Status apart = CheckNoInput(folder / name, {options.left, options.right}); !apart) {
      return FailCamera(apart.error());
    }
  }
  const auto left = ReadCameraModel(options.left, options, StereoSide::kLeft);
  if (!left) {
    return FailCamera(left.error());
  }
  const auto right = ReadCameraModel(options.right, options, StereoSide::kRight);
  if (!right) {
    return FailCamera(right.error());
  }
  const auto placed = PlacePair(
      *left, *right, options.baseline_m > 0 ? std::optional(options.baseline_m) : std::nullopt,
      options.left, options.right);
  if (!placed) {
    return FailCamera(placed.error());
  }
  AlignmentOptions alignment;
  const bool average =
      options.form == "average" || (options.form == "auto" && IsCahv(*left) && IsCahv(*right));
  alignment.form = average                   ? AlignmentForm::kAverage
                   : options.form == "older" ? AlignmentForm::kColumns
                                             : AlignmentForm::kNormals;
  alignment.field = options.field == "covering" ? FieldOfView::kCovering : FieldOfView::kInside;
  const auto pair = AlignPair(placed->left, placed->right, alignment);
  if (!pair) {
    return FailCamera(
        {pair.error().code, options.left + ", " + options.right + ": " + pair.error().message});
  }
  const Eigen::Vector3d baseline = pair->right.C - pair->left.C;
  if (baseline.dot(PinholeFromCahv(pair->left).R_CF.row(0)) < 0) {
    return FailCamera(InvalidError(options.left + ", " + options.right +
                                   ": the right camera stands to the left of the left one, every "
                                   "disparity would be negative; exchange --left and --right"));
  }
  if (const Status made = MakeFolder(options.out); !made) {
    return FailCamera(made.error());
  }
  for (const auto& [name, model] :
       {std::pair{"left.cahv", &pair->left}, {"right.cahv", &pair->right}}) {
    if (const Status written = WriteCameraModel((folder / name).string(), CahvorToText(*model));
        !written) {
      return FailCamera(written.error());
    }
  }
  const CahvInternals internals = InternalsOf(pair->left);
  const double baseline_m = baseline.norm();
  std::printf("form          %s\n", average ? "mean scale and centre (CAHV)"
                                    : alignment.form == AlignmentForm::kColumns
                                        ? "older: mean of the columns"
                                        : "newer: mean of the axes");
  if (average) {
    std::printf(
        "field         %sthe average of two models keeps none, pixels at the border may "
        "have no source\n",
        options.field_is_given ? ("--field " + options.field + " is not used: ").c_str() : "");
  }
  std::printf("focal length  hs %.9f px, vs %.9f px\n", internals.hs_px, internals.vs_px);
  std::printf("image centre  hc %.9f px, vc %.9f px\n", internals.hc_px, internals.vc_px);
  std::printf("baseline      %.9f m (disparity x depth = %.6f px m)\n", baseline_m,
              internals.hs_px * baseline_m);
  std::printf("row error     max %.3g px over 1323 points 2 to 200 baselines away\n",
              WorstRowError(*pair));
  std::printf("written       %s, %s\n", (folder / "left.cahv").string().c_str(),
              (folder / "right.cahv").string().c_str());
  return 0;
}

}  // namespace palace
