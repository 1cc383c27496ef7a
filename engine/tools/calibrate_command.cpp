#include "engine/tools/calibrate_command.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "engine/calibration/calibrated_rig.h"
#include "engine/calibration/calibration.h"
#include "engine/calibration/calibration_quality.h"
#include "engine/calibration/calibration_report.h"
#include "engine/calibration/target_file.h"
#include "engine/calibration/target_sheet.h"
#include "engine/calibration/target_sightings.h"
#include "engine/camera/files/camera_files.h"
#include "engine/capture/image_folder_source.h"
#include "engine/capture/picture_file.h"
#include "engine/core/command_line.h"
#include "engine/core/files.h"

namespace palace {
namespace {

namespace fs = std::filesystem;

struct Options {
  fs::path target;
  std::vector<std::string> left;
  std::vector<std::string> right;
  fs::path out;
  bool write_target = false;
  bool overwrite = false;
  int hold_out_every = 4;
};

/// Files of one side, in the order of the patterns and of their names within one.
Result<std::vector<fs::path>> FilesOf(const std::vector<std::string>& patterns,
                                      const std::string& option) {
  std::vector<fs::path> files;
  for (const std::string& pattern : patterns) {
    const std::vector<fs::path> matching = ExpandPattern("", pattern);
    if (matching.empty()) {
      return UnavailableError(option + ": no file matches " + pattern +
                              "; check the folder, and put a pattern in quotes");
    }
    files.insert(files.end(), matching.begin(), matching.end());
  }
  return files;
}

/// Before minutes of work: the folder can be made and written, and holds nothing of these names.
Status CheckFolder(const Options& options, const std::vector<const char*>& names) {
  std::error_code error;
  const fs::path& folder = options.out;
  fs::path there = fs::absolute(folder, error).lexically_normal();
  while (!fs::exists(there, error) && there.has_relative_path()) {
    there = there.parent_path();
  }
  if (!fs::is_directory(there, error) || access(there.c_str(), W_OK) != 0) {
    return UnavailableError(
        folder.string() + ": cannot be made or written: " + there.string() +
        (fs::is_directory(there, error) ? " may not be written" : " is no folder") +
        "; choose another --out");
  }
  for (const char* name : names) {
    if (!options.overwrite && fs::exists(folder / name, error)) {
      return UsageError(folder.string() + " holds " + name +
                        " already; choose another --out, or add --overwrite to replace it");
    }
  }
  return Ok();
}

Result<Sightings> Sight(const std::vector<fs::path>& left, const std::vector<fs::path>& right,
                        const CalibrationTarget& target) {
  const bool shows_progress = isatty(STDERR_FILENO) == 1;
  PictureReader reader{.read = ReadGreyPicture};
  if (shows_progress) {
    reader.before = [](std::size_t number, std::size_t of) {
      std::fprintf(stderr, "\rcalibrate: picture %zu of %zu", number, of);
    };
  }
  auto sightings = SightTarget(left, right, target, reader);
  if (shows_progress) {
    std::fputc('\n', stderr);
  }
  return sightings;
}

/// Patterns with their folder, where each side is one.
RigPictures PicturesOf(const Options& options) {
  if (options.left.size() != 1 || options.right.size() != 1) {
    return {};
  }
  const auto absolute = [](const std::string& pattern) {
    std::error_code error;
    const fs::path path = fs::absolute(pattern, error);
    return error ? pattern : path.string();
  };
  return {absolute(options.left[0]), absolute(options.right[0])};
}

Status WriteAll(const fs::path& folder,
                const std::vector<std::pair<std::string, std::string>>& files) {
  if (const Status made = MakeFolder(folder); !made) {
    return made;
  }
  for (const auto& [name, text] : files) {
    if (const Status written = WriteTextFile(folder / name, text); !written) {
      return written;
    }
    std::cout << "wrote " << (folder / name).string() << "\n";
  }
  return Ok();
}

Status WriteTarget(const Options& options) {
  if (const Status free = CheckFolder(options, {"target.svg", "TARGET.toml"}); !free) {
    return free;
  }
  CalibrationTarget target = DefaultTarget();
  if (!options.target.empty()) {
    const auto loaded = LoadTargetFile(options.target);
    if (!loaded) {
      return loaded.error();
    }
    target = *loaded;
  }
  const auto sheet = TargetSheetSvg(target);
  if (!sheet) {
    return sheet.error();
  }
  return WriteAll(options.out, {{"target.svg", *sheet}, {"TARGET.toml", TargetToText(target)}});
}

/// With too few views the pictures' own reasons say more than the count.
Error WithReasons(Error error, const Sightings& sightings) {
  if (!sightings.unseen.empty()) {
    error.message += "; the target was not found in " + std::to_string(sightings.unseen.size()) +
                     " pictures, first " + sightings.unseen.front();
  }
  return error;
}

void PrintSummary(const Calibration& calibration, const Sightings& sightings) {
  for (const std::string& reason : sightings.unseen) {
    std::cout << "not found in " << reason << "\n";
  }
  const auto both = std::count_if(
      calibration.views.begin(), calibration.views.end(),
      [](const ViewResult& view) { return view.left_points > 0 && view.right_points > 0; });
  std::printf(
      "%zu views, %td of them seen by both cameras; %d points, %d outlier%s; rms left %.4f px, "
      "right %.4f px\n",
      calibration.views.size(), both, calibration.points, calibration.outliers,
      calibration.outliers == 1 ? "" : "s", calibration.left_rms_px, calibration.right_rms_px);
  std::printf("focal length left %.3f +- %.3f px, right %.3f +- %.3f px; baseline %.5f +- %.5f m\n",
              calibration.estimate.lens[0][kHs], std::sqrt(calibration.covariance(kHs, kHs)),
              calibration.estimate.lens[1][kHs],
              std::sqrt(calibration.covariance(kRightLens + kHs, kRightLens + kHs)),
              calibration.baseline_m(), calibration.baseline_sigma_m());
  if (!std::isfinite(calibration.held_out_rms_px)) {
    std::printf(
        "no view was held out (8 views are the least; --hold-out-every): the fit is not "
        "checked on views it never saw\n");
  }
  for (const Criterion& criterion : Acceptance(calibration)) {
    std::printf("%s: %s\n", criterion.passed ? "passed" : "FAILED", criterion.text.c_str());
  }
  std::printf("%s\n", NextView(calibration).c_str());
  std::fflush(stdout);
}

Result<bool> Run(const Options& options) {
  if (options.write_target) {
    const Status written = WriteTarget(options);
    return written ? Result<bool>(true) : written.error();
  }
  if (options.target.empty() || options.left.empty() || options.right.empty()) {
    return UsageError("--target, --left and --right are needed (or --write-target)");
  }
  if (options.hold_out_every == 1) {
    return UsageError(
        "--hold-out-every 1 would hold out every view and leave none to fit; give 0 for none, or 2 "
        "and more");
  }
  if (const Status free = CheckFolder(
          options, {"left.cahvor", "right.cahvor", "RIG.toml", "calibration.json", "report.html"});
      !free) {
    return free.error();
  }
  const auto target = LoadTargetFile(options.target);
  if (!target) {
    return target.error();
  }
  const auto left = FilesOf(options.left, "--left");
  if (!left) {
    return left.error();
  }
  const auto right = FilesOf(options.right, "--right");
  if (!right) {
    return right.error();
  }
  const auto sightings = Sight(*left, *right, *target);
  if (!sightings) {
    return sightings.error();
  }
  CalibrationOptions calibration_options;
  calibration_options.width = sightings->width;
  calibration_options.height = sightings->height;
  calibration_options.hold_out_every = options.hold_out_every;
  const auto calibration = Calibrate(*target, sightings->views, calibration_options);
  if (!calibration) {
    return WithReasons(calibration.error(), *sightings);
  }
  PrintSummary(*calibration, *sightings);
  const CalibrationNotes notes{sightings->unseen, options.target.string()};
  const Status written =
      WriteAll(options.out, {{"left.cahvor", CahvorToText(calibration->LeftModel())},
                             {"right.cahvor", CahvorToText(calibration->RightModel())},
                             {"RIG.toml", RigToToml(*calibration, PicturesOf(options))},
                             {"calibration.json", CalibrationToJson(*calibration, *target, notes)},
                             {"report.html", CalibrationToHtml(*calibration, *target, notes)}});
  if (!written) {
    return written.error();
  }
  const auto criteria = Acceptance(*calibration);
  return std::all_of(criteria.begin(), criteria.end(),
                     [](const Criterion& criterion) { return criterion.passed; });
}

}  // namespace

void AddCalibrateCommand(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand(
      "calibrate", "pictures of a dot target or chessboard: two CAHVOR models, RIG.toml, report");
  auto options = std::make_shared<Options>();
  verb->add_option("--target", options->target,
                   "TARGET.toml: what the board looks like, in metres");
  verb->add_option("--left", options->left,
                   "left pictures: a quoted pattern ('l*.png') or file names");
  verb->add_option("--right", options->right, "right pictures, in the same order");
  verb->add_option("--out", options->out,
                   "folder for left.cahvor, right.cahvor, RIG.toml, calibration.json, report.html")
      ->required();
  verb->add_flag("--write-target", options->write_target,
                 "write a sheet to print (target.svg) and its TARGET.toml instead; of --target, or "
                 "an A4 board of dots");
  verb->add_flag("--overwrite", options->overwrite, "replace what an earlier run wrote to --out");
  verb->add_option(
          "--hold-out-every", options->hold_out_every,
          "every n-th of 8 and more views is kept out of a second fit; 0: none, 1 is refused")
      ->check(FiniteRange(0, 1000))
      ->capture_default_str();
  verb->callback([options, &exit_code] {
    const Result<bool> accepted = Run(*options);
    if (!accepted) {
      std::cerr << "palacectl calibrate: " << accepted.error().message << '\n';
      exit_code = accepted.error().code == ErrorCode::kUsage ? 2 : 1;
    } else if (!*accepted) {
      std::cerr << "palacectl calibrate: the calibration does not meet every criterion; see "
                << (options->out / "report.html").string() << '\n';
      exit_code = 1;
    }
  });
}

}  // namespace palace
