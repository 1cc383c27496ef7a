#include "engine/tools/capture_command.h"

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <system_error>

#include <CLI/CLI.hpp>

#include "engine/capture/cameras.h"
#include "engine/capture/picture_file.h"
#include "engine/core/command_line.h"
#include "engine/core/files.h"

namespace palace {
namespace {

namespace fs = std::filesystem;

struct CaptureOptions {
  fs::path rig;
  fs::path out;
  int count = 20;
  double every_s = 2;
};

fs::path PictureName(const fs::path& folder, const char* side, int index) {
  char name[32];
  std::snprintf(name, sizeof name, "%s_%03d.png", side, index);
  return folder / name;
}

/// No picture of an earlier run is written over.
Status PrepareFolder(const fs::path& folder, int count) {
  if (const Status made = MakeFolder(folder); !made) {
    return made;
  }
  std::error_code error;
  for (int index = 0; index < count; ++index) {
    for (const char* side : {"left", "right"}) {
      const fs::path picture = PictureName(folder, side, index);
      if (fs::exists(picture, error)) {
        return UsageError(picture.string() + " exists already; choose another --out");
      }
    }
  }
  return Ok();
}

/// Stamps of a film are whole microseconds: 0.1 s may read as 0.099999.
constexpr double kStampRounding_s = 1e-4;

/// Pairs at least every_s apart in data time.
Status Run(const CaptureOptions& options) {
  Result<std::unique_ptr<Source>> source = OpenCameras(options.rig, /*wait_at_end=*/false);
  if (!source) {
    return source.error();
  }
  if (const Status ready = PrepareFolder(options.out, options.count); !ready) {
    return ready;
  }
  (*source)->Control({PlaybackControl::Kind::kSpeed, 0});
  std::optional<Timestamp> last;
  for (int taken = 0; taken < options.count;) {
    const auto bundle = (*source)->Next({});
    if (!bundle && bundle.error().code == ErrorCode::kEnd) {
      return UnavailableError("the film ended after " + std::to_string(taken) + " of " +
                              std::to_string(options.count) +
                              " pairs; give a smaller --count or --every-s, or a longer film");
    }
    if (!bundle) {
      return bundle.error();
    }
    const auto& pair = (*bundle)->stereo;
    if (!pair || (last && SecondsBetween(*last, pair->time) < options.every_s - kStampRounding_s)) {
      continue;
    }
    for (const auto& [side, image] : {std::pair("left", &pair->left), {"right", &pair->right}}) {
      if (Status written = WriteGreyPicture(PictureName(options.out, side, taken), *image);
          !written) {
        return written;
      }
    }
    last = pair->time;
    std::printf("pair %d of %d\n", ++taken, options.count);
    std::fflush(stdout);
  }
  return Ok();
}

}  // namespace

void AddCaptureCommand(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand(
      "capture", "stereo pairs from the cameras of RIG.toml's [capture] as PNG, to calibrate with");
  auto options = std::make_shared<CaptureOptions>();
  verb->add_option("--rig", options->rig, "RIG.toml with a [capture] table")->required();
  verb->add_option("--out", options->out, "folder for left_000.png, right_000.png ...")->required();
  verb->add_option("--count", options->count, "pairs to take")
      ->check(FiniteRange(1, 1000))
      ->capture_default_str();
  verb->add_option("--every-s", options->every_s, "seconds between two pairs: move the board")
      ->check(FiniteRange(0.0, 3600.0))
      ->capture_default_str();
  verb->callback([options, &exit_code] {
    if (const Status done = Run(*options); !done) {
      std::cerr << "palacectl capture: " << done.error().message << '\n';
      exit_code = done.error().code == ErrorCode::kUsage ? 2 : 1;
    }
  });
}

}  // namespace palace
