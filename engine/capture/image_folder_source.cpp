#include "engine/capture/image_folder_source.h"

#include <fnmatch.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <system_error>
#include <utility>

#include "engine/capture/picture_file.h"

namespace palace {
namespace {

constexpr std::int64_t kStart_us = 1'000'000'000'000;

std::string SizeText(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height) + " px";
}

Status CheckSize(const ImageU8& image, const RigCamera& camera, const std::filesystem::path& path) {
  if (image.width() == camera.pinhole.width && image.height() == camera.pinhole.height) {
    return Ok();
  }
  return InvalidError(path.string() + ": the picture is " +
                      SizeText(image.width(), image.height()) + ", RIG.toml says " +
                      SizeText(camera.pinhole.width, camera.pinhole.height) +
                      "; correct width and height or the pattern");
}

}  // namespace

Result<StereoFrame> ReadStereoPair(const std::filesystem::path& left,
                                   const std::filesystem::path& right) {
  auto left_image = ReadGreyPicture(left);
  if (!left_image) {
    return left_image.error();
  }
  auto right_image = ReadGreyPicture(right);
  if (!right_image) {
    return right_image.error();
  }
  if (left_image->width() != right_image->width() ||
      left_image->height() != right_image->height()) {
    return InvalidError(right.string() + ": the picture is " +
                        SizeText(right_image->width(), right_image->height()) + ", the left one (" +
                        left.string() + ") is " +
                        SizeText(left_image->width(), left_image->height()) +
                        "; both cameras of a pair give the same size");
  }
  return StereoFrame{{}, std::move(left_image).value(), std::move(right_image).value()};
}

std::vector<std::filesystem::path> ExpandPattern(const std::filesystem::path& folder,
                                                 const std::string& pattern) {
  const std::filesystem::path full = folder / pattern;
  const std::string name = full.filename().string();
  const std::filesystem::path parent = full.has_parent_path() ? full.parent_path() : ".";
  std::vector<std::filesystem::path> files;
  std::error_code code;
  for (std::filesystem::directory_iterator entry(parent, code), end; !code && entry != end;
       entry.increment(code)) {
    std::error_code type_code;
    if (entry->is_regular_file(type_code) &&
        fnmatch(name.c_str(), entry->path().filename().c_str(), FNM_PERIOD) == 0) {
      files.push_back(entry->path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

Result<std::unique_ptr<ImageFolderSource>> ImageFolderSource::Open(
    const std::filesystem::path& rig_toml, bool loop) {
  auto file = LoadRigFile(rig_toml);
  if (!file) {
    return file.error();
  }
  if (file->left_pattern.empty()) {
    return InvalidError(rig_toml.string() +
                        ": table [images] is missing; add it with left, right and rate_hz");
  }
  auto left = ExpandPattern(file->folder, file->left_pattern);
  auto right = ExpandPattern(file->folder, file->right_pattern);
  for (const auto& [files, pattern] :
       {std::pair(&left, &file->left_pattern), std::pair(&right, &file->right_pattern)}) {
    if (files->empty()) {
      return UnavailableError(rig_toml.string() + ": no file matches " +
                              (file->folder / *pattern).string() +
                              "; patterns are relative to the folder of RIG.toml");
    }
  }
  if (left.size() != right.size()) {
    return InvalidError(rig_toml.string() + ": " + std::to_string(left.size()) + " left and " +
                        std::to_string(right.size()) + " right pictures; every pair needs both");
  }
  std::unique_ptr<ImageFolderSource> source(new ImageFolderSource(
      std::move(file).value(), std::move(left), std::move(right), rig_toml.string(), loop));
  if (const auto first = source->LoadPair(0); !first) {
    return first.error();
  }
  return source;
}

ImageFolderSource::ImageFolderSource(RigFile file, std::vector<std::filesystem::path> left,
                                     std::vector<std::filesystem::path> right, std::string name,
                                     bool loop)
    : file_(std::move(file)),
      rig_(std::make_shared<const StereoRig>(file_.rig)),
      left_(std::move(left)),
      right_(std::move(right)),
      name_(std::move(name)),
      loop_(loop) {}

Timestamp ImageFolderSource::TimeOf(std::int64_t index) const {
  return AddSeconds({kStart_us}, static_cast<double>(index) / file_.rig.rate_hz);
}

Result<std::shared_ptr<const StereoFrame>> ImageFolderSource::LoadPair(std::int64_t index) {
  const auto last = static_cast<std::int64_t>(left_.size()) - 1;
  const std::int64_t picture = std::min(index, last);
  if (!cached_ || cached_index_ != picture) {
    const auto place = static_cast<std::size_t>(picture);
    auto frame = ReadStereoPair(left_[place], right_[place]);
    if (!frame) {
      return frame.error();
    }
    if (const auto status = CheckSize(frame->left, file_.rig.left, left_[place]); !status) {
      return status.error();
    }
    if (const auto status = CheckSize(frame->right, file_.rig.right, right_[place]); !status) {
      return status.error();
    }
    frame->time = TimeOf(index);
    cached_ = std::make_shared<const StereoFrame>(std::move(frame).value());
    cached_index_ = picture;
  }
  if (cached_->time != TimeOf(index)) {
    auto again = std::make_shared<StereoFrame>(*cached_);
    again->time = TimeOf(index);
    cached_ = std::move(again);
  }
  return cached_;
}

std::optional<std::int64_t> ImageFolderSource::WaitForTurn(std::stop_token stop) {
  const auto count = static_cast<std::int64_t>(left_.size());
  std::unique_lock lock(mutex_);
  for (;;) {
    const auto may_run = [&] { return !paused_ || steps_ > 0; };
    if (!changed_.wait(lock, stop, may_run)) {
      return std::nullopt;
    }
    if (next_index_ >= count && !loop_) {
      ended_ = true;
      return std::nullopt;
    }
    const double now = MonotonicSeconds();
    if (steps_ > 0 || speed_ <= 0 || now >= due_s_) {
      steps_ = std::max(0, steps_ - 1);
      const double period = speed_ > 0 ? 1 / (file_.rig.rate_hz * speed_) : 0;
      // Keep the beat when in time; start a new one after a pause or when the engine is slower.
      const double late = now - due_s_;
      due_s_ = (late < period ? due_s_ : now) + period;
      speed_reached_ = late < period || period == 0 ? speed_ : period / late * speed_;
      shown_index_ = next_index_++;
      return shown_index_;
    }
    // Woken early by Control: look again at what it changed.
    const auto wait = std::chrono::duration<double>(std::min(due_s_ - now, 1.0));
    const double due = due_s_;
    changed_.wait_for(lock, stop, wait,
                      [&] { return paused_ || steps_ > 0 || due_s_ != due || speed_ <= 0; });
    if (stop.stop_requested()) {
      return std::nullopt;
    }
  }
}

Result<std::shared_ptr<const FrameBundle>> ImageFolderSource::Next(std::stop_token stop) {
  const auto index = WaitForTurn(stop);
  if (!index) {
    return Error{ErrorCode::kEnd,
                 stop.stop_requested() ? name_ + ": stopped" : name_ + ": end of the pictures"};
  }
  auto frame = LoadPair(*index);
  if (!frame) {
    return frame.error();
  }
  auto bundle = std::make_shared<FrameBundle>();
  bundle->sequence = ++sequence_;
  bundle->time = TimeOf(*index);
  bundle->rig = rig_;
  bundle->stereo = *frame;
  if (file_.pose) {
    VehiclePose pose = *file_.pose;
    pose.time = bundle->time;
    bundle->pose_at_exposure = pose;
    bundle->poses.push_back(pose);
  }
  return std::shared_ptr<const FrameBundle>(std::move(bundle));
}

SourceStatus ImageFolderSource::Status() const {
  const std::lock_guard lock(mutex_);
  SourceStatus status;
  status.kind = SourceKind::kImages;
  status.name = name_;
  status.paused = paused_;
  status.ended = ended_;
  status.speed = speed_;
  status.speed_reached = speed_reached_;
  status.start = {kStart_us};
  status.frame_index = static_cast<std::uint64_t>(std::max<std::int64_t>(0, shown_index_));
  status.position_s = static_cast<double>(status.frame_index) / file_.rig.rate_hz;
  status.duration_s = static_cast<double>(left_.size()) / file_.rig.rate_hz;
  status.can_seek = true;
  status.frame_count = left_.size();
  return status;
}

void ImageFolderSource::Control(const PlaybackControl& control) {
  const std::lock_guard lock(mutex_);
  const auto last = static_cast<std::int64_t>(left_.size()) - 1;
  switch (control.kind) {
    case PlaybackControl::Kind::kPlay:
      paused_ = false;
      break;
    case PlaybackControl::Kind::kPause:
      paused_ = true;
      steps_ = 0;
      break;
    case PlaybackControl::Kind::kStepForward:
      paused_ = true;
      ++steps_;
      break;
    case PlaybackControl::Kind::kStepBack:
      paused_ = true;
      next_index_ = std::max<std::int64_t>(0, shown_index_ - 1);
      steps_ = 1;
      break;
    case PlaybackControl::Kind::kSeek:
      if (std::isfinite(control.value)) {
        const double index = std::round(
            std::clamp(control.value * file_.rig.rate_hz, 0.0, static_cast<double>(last)));
        next_index_ = static_cast<std::int64_t>(index);
        ended_ = false;
        due_s_ = 0;
        steps_ = paused_ ? 1 : 0;  // a seek while paused shows the picture it went to
      }
      break;
    case PlaybackControl::Kind::kSpeed:
      if (std::isfinite(control.value) && control.value >= 0) {
        speed_ = control.value;
        due_s_ = 0;
      }
      break;
  }
  changed_.notify_all();
}

}  // namespace palace
