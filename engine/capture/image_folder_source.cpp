#include "engine/capture/image_folder_source.h"

#include <fnmatch.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "engine/capture/pair_bundle.h"
#include "engine/capture/picture_file.h"
#include "engine/capture/picture_size.h"

namespace palace {
namespace {

Status CheckSize(const ImageU8& image, const RigCamera& camera, const std::filesystem::path& path) {
  return CheckPictureSize(image, camera.pinhole, path.string(),
                          "correct width and height or the pattern");
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
      turns_(file_.rig.rate_hz, static_cast<std::int64_t>(left_.size()),
             loop ? PlaybackTurns::AtEnd::kRunOn : PlaybackTurns::AtEnd::kEnd) {
  turns_.EndsAt(static_cast<std::int64_t>(left_.size()));
}

Timestamp ImageFolderSource::TimeOf(std::int64_t index) const {
  return AddSeconds(kRecordedStart, static_cast<double>(index) / file_.rig.rate_hz);
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

Result<std::shared_ptr<const FrameBundle>> ImageFolderSource::Next(std::stop_token stop) {
  const auto index = turns_.Wait(stop);
  if (!index) {
    return Error{ErrorCode::kEnd,
                 stop.stop_requested() ? name_ + ": stopped" : name_ + ": end of the pictures"};
  }
  auto frame = LoadPair(*index);
  if (!frame) {
    return frame.error();
  }
  auto bundle = BundleOf(rig_, file_.pose, *frame);
  bundle->sequence = ++sequence_;
  return std::shared_ptr<const FrameBundle>(std::move(bundle));
}

SourceStatus ImageFolderSource::Status() const {
  SourceStatus status;
  status.kind = SourceKind::kImages;
  status.name = name_;
  turns_.FillStatus(status);
  return status;
}

void ImageFolderSource::Control(const PlaybackControl& control) { turns_.Control(control); }

}  // namespace palace
