#include "engine/capture/image_folder_source.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "engine/capture/euroc/euroc_folder.h"
#include "engine/capture/pair_bundle.h"
#include "engine/capture/picture_size.h"
#include "engine/core/log.h"

namespace palace {
namespace {

Status CheckSize(const ImageU8& image, const RigCamera& camera, const std::filesystem::path& path) {
  return CheckPictureSize(image, camera.pinhole, path.string(),
                          "correct width and height or the pattern");
}

/// Seconds since the first.
std::vector<double> TimesOf(const std::vector<ImagePair>& pairs) {
  std::vector<double> times_s;
  for (const ImagePair& pair : pairs) {
    times_s.push_back(SecondsBetween(pairs.front().time, pair.time));
  }
  return times_s;
}

struct PictureFolder {
  RigFile file;
  ImageSequence sequence;
};

Result<PictureFolder> OpenRigToml(const std::filesystem::path& rig_toml) {
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
  auto sequence = SequenceOf(left, right, *file, file->poses_csv);
  if (!sequence) {
    return sequence.error();
  }
  file->rig.rate_hz = sequence->rate_hz;
  return PictureFolder{std::move(file).value(), std::move(sequence).value()};
}

Result<PictureFolder> OpenEuroc(const std::filesystem::path& folder) {
  auto euroc = LoadEurocFolder(folder);
  if (!euroc) {
    return euroc.error();
  }
  if (!euroc->left_out.empty()) {
    LogWarning(folder.string() + ": " + euroc->left_out);
  }
  return PictureFolder{std::move(euroc->rig), std::move(euroc->sequence)};
}

}  // namespace

Result<std::unique_ptr<ImageFolderSource>> ImageFolderSource::Open(
    const std::filesystem::path& pictures, bool loop) {
  std::error_code code;
  auto found =
      std::filesystem::is_directory(pictures, code) ? OpenEuroc(pictures) : OpenRigToml(pictures);
  if (!found) {
    return found.error();
  }
  std::unique_ptr<ImageFolderSource> source(new ImageFolderSource(
      std::move(found->file), std::move(found->sequence.pairs), pictures.string(), loop));
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
      times_(TimesOf(pairs_), file_.rig.rate_hz),
      turns_(times_, static_cast<std::int64_t>(pairs_.size()),
             loop ? PlaybackTurns::AtEnd::kRunOn : PlaybackTurns::AtEnd::kEnd) {
  turns_.EndsAt(static_cast<std::int64_t>(pairs_.size()));
}

const ImagePair& ImageFolderSource::PairAt(std::int64_t index) const {
  return pairs_[std::min(static_cast<std::size_t>(index), pairs_.size() - 1)];
}

Result<std::shared_ptr<const StereoFrame>> ImageFolderSource::LoadPair(std::int64_t index) {
  const ImagePair& pair = PairAt(index);
  const Timestamp time = AddSeconds(kRecordedStart, times_.At(index));
  if (!cached_ || cached_pair_ != &pair) {
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
    frame->time = time;
    cached_ = std::make_shared<const StereoFrame>(std::move(frame).value());
    cached_pair_ = &pair;
  }
  if (cached_->time != time) {
    auto again = std::make_shared<StereoFrame>(*cached_);
    again->time = time;
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
  auto bundle = BundleOf(rig_, PairAt(*index).pose, *frame);
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
