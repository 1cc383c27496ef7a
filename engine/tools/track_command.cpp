#include "engine/tools/track_command.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include <CLI/CLI.hpp>

#include "engine/capture/picture_file.h"
#include "engine/capture/single_pictures.h"
#include "engine/core/command_line.h"
#include "engine/core/files.h"
#include "engine/core/termination.h"
#include "engine/core/text.h"
#include "engine/core/time.h"
#include "engine/tools/track_files.h"
#include "engine/tracking/template_selection.h"

namespace palace {
namespace {

namespace fs = std::filesystem;

constexpr int kMostUndecodable = 100;  // in a row
constexpr int kMostChanges = 40;       // whose pictures are written without --pictures
constexpr double kWholeShare = 0.98;   // of the pictures announced; less was cut short

struct TrackOptions {
  std::string source;
  fs::path out;
  std::string feature;  ///< "X,Y", or empty
  FollowerOptions follower;
  bool keep_template = false;
  int frames = 0;    ///< 0: all
  int pictures = 0;  ///< every n-th; 0: ends and changes of state
  std::string size = "640x480";
};

Result<std::optional<Eigen::Vector2d>> ParseFeature(const std::string& text) {
  if (text.empty()) {
    return std::optional<Eigen::Vector2d>();
  }
  Eigen::Vector2d pixel;
  char rest = '\0';
  if (std::sscanf(text.c_str(), "%lf,%lf%c", &pixel.x(), &pixel.y(), &rest) != 2 ||
      !pixel.allFinite()) {
    return UsageError("--feature " + text + ": must be X,Y in pixels, e.g. 320,240");
  }
  return std::optional<Eigen::Vector2d>(pixel);
}

Status ParseSize(const std::string& text, int& width, int& height) {
  char rest = '\0';
  if (std::sscanf(text.c_str(), "%5dx%5d%c", &width, &height, &rest) != 2 || width < 1 ||
      height < 1 || width > 16384 || height > 16384) {
    return UsageError("--size " + text +
                      ": must be WIDTHxHEIGHT in whole pixels from 1 to 16384, e.g. 640x480");
  }
  return Ok();
}

/// Follows the pictures of one source and writes what is asked for.
class Tracking {
 public:
  explicit Tracking(const TrackOptions& options) : options_(options) {}

  Status Run() {
    const Termination termination;
    if (const Status ready = Prepare(); !ready) {
      return ready;
    }
    const Status followed = FollowAll(termination);
    if (track_.pictures.empty()) {
      return followed ? UnavailableError(pictures_.name + ": no picture came before it was ended")
                      : followed;
    }
    if (!followed) {
      track_.ended = followed.error().message;
    }
    if (const Status written = WriteFiles(); !written) {
      return written;
    }
    std::printf("%s\n", TrackSummary(track_).c_str());
    return followed;
  }

 private:
  Status Prepare() {
    FollowerOptions follower = options_.follower;
    follower.update = !options_.keep_template;
    if (const Status fine = CheckFollowerOptions(follower); !fine) {
      return fine;
    }
    auto given = ParseFeature(options_.feature);
    if (!given) {
      return given.error();
    }
    given_ = *given;
    int width = 0, height = 0;
    if (const Status fine = ParseSize(options_.size, width, height); !fine) {
      return fine;
    }
    if (options_.pictures > 0 && options_.out.empty()) {
      return UsageError("--pictures needs --out, a folder to write them to");
    }
    std::error_code ignored;
    if (!options_.out.empty() && fs::exists(options_.out / "track.csv", ignored)) {
      return UsageError(options_.out.string() + " holds a track already; choose another --out");
    }
    Result<SinglePictures> pictures =
        OpenSinglePictures(options_.source, fs::path(), width, height);
    if (!pictures) {
      return pictures.error();
    }
    pictures_ = std::move(pictures).value();
    track_.source = pictures_.name;
    track_.options = follower;
    return options_.out.empty() ? Ok() : MakeFolder(options_.out);
  }

  /// Until the source ends, --frames are done or somebody asks for the end.
  Status FollowAll(const Termination& termination) {
    int undecodable = 0;
    for (int frame = 0; !termination.asked() && (options_.frames == 0 || frame < options_.frames);
         ++frame) {
      Result<CameraPicture> picture = pictures_.device.read();
      if (!picture && picture.error().code == ErrorCode::kEnd) {
        TellIfCutShort(frame);
        return frame > 0 ? Ok() : InvalidError(pictures_.name + ": holds no pictures");
      }
      if (!picture && picture.error().code == ErrorCode::kInvalid) {
        std::fprintf(stderr, "palacectl track: frame %d is left out: %s\n", frame,
                     picture.error().message.c_str());
        ++track_.undecodable;
        if (++undecodable > kMostUndecodable) {
          return picture.error();
        }
        continue;
      }
      if (!picture) {
        return picture.error();
      }
      undecodable = 0;
      if (const Status done = Take(frame, std::move(picture).value()); !done) {
        return done;
      }
    }
    return Ok();
  }

  /// A film that ends early looks like a short one. Containers count by their length in seconds and
  /// may be some pictures off.
  void TellIfCutShort(int frames) {
    const double announced = static_cast<double>(pictures_.device.frame_count);
    if (frames == 0 || frames >= kWholeShare * announced - 1) {
      return;
    }
    track_.ended = pictures_.name + WithNumbers(
                                        " ends after %.0f of the %.0f pictures that it "
                                        "announces; it may be cut short",
                                        frames, announced);
    std::fprintf(stderr, "palacectl track: warning: %s\n", track_.ended.c_str());
  }

  Status Take(int frame, CameraPicture picture) {
    TrackedPicture tracked;
    tracked.frame = frame;
    tracked.time_s = TimeOf(picture.time_s);
    if (!follower_) {
      if (const Status started = Start(picture.grey); !started) {
        return started;
      }
      tracked.told = follower_->first();
    } else {
      if (picture.grey.width() != track_.width || picture.grey.height() != track_.height) {
        return InvalidError(pictures_.name + ": frame " + std::to_string(frame) + " is " +
                            SizeText(picture.grey.width(), picture.grey.height()) +
                            ", the first was " + SizeText(track_.width, track_.height) +
                            "; give pictures of one size");
      }
      const double start_s = MonotonicSeconds();
      tracked.told = follower_->Follow(picture.grey);
      tracked.follow_ms = (MonotonicSeconds() - start_s) * 1e3;
    }
    const FollowedFeature& told = tracked.told;
    const bool change = told.pictures_lost == 1 || told.state == FollowState::kReacquired;
    if (change) {
      std::printf("%s\n", TrackEvent(tracked).c_str());
      std::fflush(stdout);
    }
    if (!options_.out.empty()) {
      const bool asked = options_.pictures > 0 && frame % options_.pictures == 0;
      const bool worth = track_.pictures.empty() || (change && changes_++ < kMostChanges);
      if (asked || worth) {
        if (const Status written = WriteAnnotated(picture.grey, tracked); !written) {
          return written;
        }
      }
      newest_ = std::move(picture.grey);
    }
    track_.pictures.push_back(std::move(tracked));
    return Ok();
  }

  /// Since the first picture; NaN where the source's clock does not advance.
  double TimeOf(double source_s) {
    if (!std::isfinite(source_s) || (std::isfinite(newest_s_) && source_s <= newest_s_)) {
      return NAN;
    }
    newest_s_ = source_s;
    first_s_ = std::isfinite(first_s_) ? first_s_ : source_s;
    return source_s - first_s_;
  }

  Status Start(const ImageU8& picture) {
    const FollowerOptions& follower = track_.options;
    track_.width = picture.width();
    track_.height = picture.height();
    Eigen::Vector2d pixel;
    if (given_) {
      pixel = *given_;
    } else {
      TemplateSelectionOptions selection;
      selection.template_px = follower.template_px;
      selection.search_px = follower.search_px;
      selection.max_count = 1;
      const auto features = SelectTemplates(picture, selection);
      if (features.empty()) {
        return InvalidError(
            pictures_.name + ": the first picture, " + SizeText(picture.width(), picture.height()) +
            ", has no place for a template of " + std::to_string(follower.template_px) +
            " px that changes in both directions and does not repeat within the search window; "
            "give one with --feature X,Y, or begin with another picture");
      }
      pixel = features[0].pixel;
      similarity_ = features[0].self_similarity;
    }
    Result<FeatureFollower> started = FeatureFollower::Start(picture, pixel, follower);
    if (!started) {
      return started.error();
    }
    follower_ = std::move(started).value();
    Tell(picture, pixel);
    return Ok();
  }

  void Tell(const ImageU8& picture, const Eigen::Vector2d& pixel) {
    const FollowerOptions& follower = track_.options;
    if (given_) {
      const int half = follower.template_px / 2;
      const Eigen::Vector2i nearest(
          std::clamp(static_cast<int>(std::lround(pixel.x())), half, picture.width() - 1 - half),
          std::clamp(static_cast<int>(std::lround(pixel.y())), half, picture.height() - 1 - half));
      similarity_ = SelfSimilarity(picture, nearest, follower.template_px, follower.search_px);
    }
    const double limit = TemplateSelectionOptions{}.max_self_similarity;
    track_.chosen =
        WithNumbers("%.1f,%.1f px, ", pixel.x(), pixel.y()) + (given_ ? "as given" : "selected") +
        WithNumbers("; the place most like it within the window correlates by %.2f", similarity_) +
        WithNumbers(", limit %.2f", limit);
    std::printf("feature %s\n", track_.chosen.c_str());
    if (similarity_ > limit) {
      std::fprintf(stderr,
                   "palacectl track: another place within the search window looks like the "
                   "feature (%.2f, limit %.2f): it may be taken for it\n",
                   similarity_, limit);
    }
    if (pictures_.live && options_.frames == 0) {
      std::printf("Ctrl+C ends it\n");
    }
    std::fflush(stdout);
  }

  Status WriteAnnotated(const ImageU8& picture, TrackedPicture& tracked) {
    char name[32];
    std::snprintf(name, sizeof name, "frame_%06d.png", tracked.frame);
    tracked.file = name;
    return WriteGreyPicture(options_.out / name,
                            AnnotatedPicture(picture, tracked, track_.options.min_coherence));
  }

  Status WriteFiles() {
    if (options_.out.empty()) {
      return Ok();
    }
    if (TrackedPicture& last = track_.pictures.back(); last.file.empty()) {
      if (const Status written = WriteAnnotated(newest_, last); !written) {
        return written;
      }
    }
    if (const Status written = WriteTextFile(options_.out / "track.csv", TrackCsv(track_));
        !written) {
      return written;
    }
    return WriteTextFile(options_.out / "report.html", TrackReport(track_, options_.out));
  }

  const TrackOptions& options_;
  std::optional<Eigen::Vector2d> given_;
  SinglePictures pictures_;
  std::optional<FeatureFollower> follower_;
  double similarity_ = 0;
  double first_s_ = NAN;
  double newest_s_ = NAN;
  ImageU8 newest_;
  int changes_ = 0;
  Track track_;
};

}  // namespace

void AddTrackCommand(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand(
      "track", "follow one feature through a film, a folder of pictures or a live camera");
  auto options = std::make_shared<TrackOptions>();
  verb->add_option("SOURCE", options->source,
                   "A video file, a folder of pictures (in order of name), a device (0, "
                   "/dev/video0) or a stream (rtsp://, http://)")
      ->required();
  verb->add_option("--out", options->out,
                   "Folder for track.csv, report.html and annotated pictures");
  verb->add_option("--feature", options->feature,
                   "X,Y in pixels of the first picture; else the best one is selected");
  verb->add_option("--template", options->follower.template_px, "Side of the template, px, odd")
      ->check(FiniteRange(11, 101))
      ->capture_default_str();
  verb->add_option("--search", options->follower.search_px,
                   "How far around the template is searched, px; more while it is lost")
      ->check(FiniteRange(4, 128))
      ->capture_default_str();
  verb->add_option("--min-coherence", options->follower.min_coherence,
                   "Below it the feature is LOST")
      ->check(FiniteRange(0.1, 0.99))
      ->capture_default_str();
  verb->add_option("--frames", options->frames, "Pictures to take; else all, or until Ctrl+C")
      ->check(FiniteRange(1, 1e9));
  verb->add_flag("--no-update", options->keep_template,
                 "Keep the first template; else a new one is cut as scale or view change");
  verb->add_option("--pictures", options->pictures,
                   "Write every n-th picture annotated, 1 each; else the first, the last and "
                   "changes of state")
      ->check(FiniteRange(1, 1e6));
  verb->add_option("--size", options->size, "Asked of a device, px")->capture_default_str();
  verb->callback([options, &exit_code] {
    if (const Status done = Tracking(*options).Run(); !done) {
      std::cout.flush();
      std::cerr << "palacectl track: " << done.error().message << '\n';
      exit_code = done.error().code == ErrorCode::kUsage ? 2 : 1;
    }
  });
}

}  // namespace palace
