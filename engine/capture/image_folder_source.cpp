#include "engine/capture/image_folder_source.h"

#include <algorithm>
#include <utility>

#include "engine/capture/pair_bundle.h"
#include "engine/capture/picture_size.h"

namespace palace {
namespace {

Status CheckSize(const ImageU8& image, const RigCamera& camera, const std::filesystem::path& path) {
  return CheckPictureSize(image, camera.pinhole, path.string(),
                          "correct width and height or the pattern");
}

}  // namespace

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
  auto sequence = SequenceOf(left, right, *file, file->poses_csv);
  if (!sequence) {
    return sequence.error();
  }
  file->rig.rate_hz = sequence->rate_hz;
  std::unique_ptr<ImageFolderSource> source(new ImageFolderSource(
      std::move(file).value(), std::move(sequence->pairs), rig_toml.string(), loop));
  if (const auto first = source->LoadPair(0); !first) {
    return first.error();
  }
  return source;
}

ImageFolderSource::ImageFolderSource(RigFile file, std::vector<ImagePair> pairs, std::string name,
                                     bool loop)
    : file_(std::move(file)),
      rig_(std::make_shared<const StereoRig>(file_.rig)),
      pairs_(std::move(pairs)),
      name_(std::move(name)),
      turns_(file_.rig.rate_hz, static_cast<std::int64_t>(pairs_.size()),
             loop ? PlaybackTurns::AtEnd::kRunOn : PlaybackTurns::AtEnd::kEnd) {
  turns_.EndsAt(static_cast<std::int64_t>(pairs_.size()));
}

Timestamp ImageFolderSource::TimeOf(std::int64_t index) const {
  const auto last = static_cast<std::int64_t>(pairs_.size()) - 1;
  return index <= last ? pairs_[static_cast<std::size_t>(index)].time
                       : AddSeconds(pairs_.back().time,
                                    static_cast<double>(index - last) / file_.rig.rate_hz);
}

Result<std::shared_ptr<const StereoFrame>> ImageFolderSource::LoadPair(std::int64_t index) {
  const auto last = static_cast<std::int64_t>(pairs_.size()) - 1;
  const std::int64_t picture = std::min(index, last);
  if (!cached_ || cached_index_ != picture) {
    const ImagePair& pair = pairs_[static_cast<std::size_t>(picture)];
    auto frame = ReadStereoPair(pair.left, pair.right);
    if (!frame) {
      return frame.error();
    }
    if (const auto status = CheckSize(frame->left, file_.rig.left, pair.left); !status) {
      return status.error();
    }
    if (const auto status = CheckSize(frame->right, file_.rig.right, pair.right); !status) {
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
  const auto last = static_cast<std::int64_t>(pairs_.size()) - 1;
  auto bundle =
      BundleOf(rig_, pairs_[static_cast<std::size_t>(std::min(*index, last))].pose, *frame);
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
