#include "engine/capture/video_source.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "engine/capture/camera_address.h"
#include "engine/capture/pair_bundle.h"
#include "engine/capture/side_by_side.h"

namespace palace {
namespace {

constexpr double kUsualRate_hz = 10;  // where the container does not say
constexpr double kLongestGap_s = 60;  // between two pictures; longer is a damaged stamp
constexpr double kLatest_s = 1e7;     // a film is shorter than this
constexpr double kSeekLead_s = 1;     // sought this much before the place, then read on to it
constexpr double kMissingAfterPeriods = 1.5;
constexpr int kMostUndecodable = 30;  // in a row, before the film counts as ended
constexpr double kWholeShare = 0.98;  // of the pictures announced; less was cut short

Timestamp FilmTime(double time_s) { return AddSeconds({0}, time_s); }

}  // namespace

Result<std::unique_ptr<VideoSource>> VideoSource::Open(RigCameras cameras,
                                                       VideoSourceOptions options) {
  std::unique_ptr<VideoSource> source(new VideoSource(std::move(cameras), std::move(options)));
  if (const ::palace::Status opened = source->OpenFilms(); !opened) {
    return opened.error();
  }
  auto rig = std::make_shared<StereoRig>(source->cameras_.file.rig);
  const RigCapture& capture = *source->cameras_.file.capture;
  const double container_hz = source->films_.front().device.rate_hz;
  source->rate_hz_ = container_hz > 0 ? container_hz : capture.rate_hz.value_or(kUsualRate_hz);
  rig->rate_hz = source->rate_hz_;
  source->rig_ = std::move(rig);
  source->pairing_.emplace(source->cameras_.ToleranceAt(source->rate_hz_));
  std::uint64_t count = 0;
  for (const Film& film : source->films_) {
    count = count == 0 ? film.device.frame_count : std::min(count, film.device.frame_count);
  }
  using AtEnd = PlaybackTurns::AtEnd;
  source->turns_.emplace(PictureTimes(source->rate_hz_), static_cast<std::int64_t>(count),
                         capture.loop                   ? AtEnd::kRestart
                         : source->options_.wait_at_end ? AtEnd::kWait
                                                        : AtEnd::kEnd);
  Result<PicturePair> first = source->ReadPair();
  if (!first) {
    return first.error().code == ErrorCode::kEnd ? source->NoPairs() : first.error();
  }
  source->pending_ = std::move(first).value();
  return source;
}

VideoSource::VideoSource(RigCameras cameras, VideoSourceOptions options)
    : cameras_(std::move(cameras)), options_(std::move(options)) {
  for (std::size_t i = 0; i < cameras_.requests.size(); ++i) {
    films_.push_back({cameras_.requests[i], {}});
    counters_.emplace_back().name = cameras_.NameOfCamera(i);
  }
}

Status VideoSource::OpenFilms() {
  for (Film& film : films_) {
    Result<CameraDevice> device = options_.open(film.request);
    if (!device) {
      return device.error();
    }
    film.device = std::move(device).value();
  }
  return Ok();
}

void VideoSource::ForgetWaiting() {
  pairing_->Restart();
  pending_.reset();
  for (Film& film : films_) {
    film.newest_s = NAN;
  }
}

Error VideoSource::NoPairs() const {
  for (std::size_t i = 0; i < films_.size(); ++i) {
    if (counters_[i].frames == 0) {
      return InvalidError(films_[i].request.address +
                          ": the video holds no picture; record it again");
    }
  }
  char tolerance[48];
  std::snprintf(tolerance, sizeof tolerance, "%.3g ms", pairing_->tolerance_s() * 1e3);
  return InvalidError(cameras_.rig_toml + ": no picture of " + films_.front().request.address +
                      " lies within " + tolerance + " of one of " + films_.back().request.address +
                      "; film both at the same rate, or raise capture.pair_tolerance_ms");
}

Result<TimedPicture> VideoSource::ReadFrom(std::size_t index) {
  Film& film = films_[index];
  Result<CameraPicture> picture = film.device.read();
  std::uint64_t undecodable = 0;
  while (!picture && picture.error().code == ErrorCode::kInvalid &&
         undecodable < kMostUndecodable) {
    ++undecodable;
    picture = film.device.read();
  }
  if (!picture) {
    return picture.error().code == ErrorCode::kInvalid
               ? Error{ErrorCode::kEnd, picture.error().message}
               : picture.error();
  }
  if (const ::palace::Status fits = cameras_.Check(index, picture->grey); !fits) {
    return fits.error();
  }
  double time_s = picture->time_s;
  std::uint64_t missing = undecodable;
  if (std::isnan(film.newest_s)) {
    time_s = std::abs(time_s) <= kLatest_s ? time_s : 0;
  } else {
    const double step_s = time_s - film.newest_s;
    if (!(step_s > 0 && step_s <= kLongestGap_s)) {
      time_s = film.newest_s + 1 / rate_hz_;
    } else if (step_s * rate_hz_ > kMissingAfterPeriods) {
      missing = std::max(missing, static_cast<std::uint64_t>(std::llround(step_s * rate_hz_)) - 1);
    }
  }
  film.newest_s = time_s;
  const std::lock_guard lock(mutex_);
  ++counters_[index].frames;
  counters_[index].device_dropped += missing;
  counters_[index].rate_hz = film.device.rate_hz > 0 ? film.device.rate_hz : NAN;
  return TimedPicture{FilmTime(time_s), std::move(picture->grey)};
}

Result<PicturePair> VideoSource::ReadPair() {
  if (films_.size() == 1) {
    Result<TimedPicture> both = ReadFrom(0);
    if (!both) {
      return both.error();
    }
    auto [left, right] = SplitSideBySide(both->grey);
    return PicturePair{{both->time, std::move(left)}, {both->time, std::move(right)}};
  }
  for (;;) {
    // The film that lies behind is read on; neither was read: the left one first.
    const double left_s = films_[0].newest_s, right_s = films_[1].newest_s;
    const std::size_t behind =
        std::isnan(left_s) || (!std::isnan(right_s) && left_s <= right_s) ? 0 : 1;
    Result<TimedPicture> picture = ReadFrom(behind);
    if (!picture) {
      return picture.error();
    }
    const auto side = behind == 0 ? FramePairing::kLeft : FramePairing::kRight;
    std::optional<PicturePair> pair = pairing_->Add(side, std::move(picture).value());
    {
      const std::lock_guard lock(mutex_);
      counters_[0].unpaired = pairing_->unpaired(FramePairing::kLeft);
      counters_[1].unpaired = pairing_->unpaired(FramePairing::kRight);
    }
    if (pair) {
      return std::move(*pair);
    }
  }
}

Status VideoSource::GoTo(double time_s) {
  const double half_period_s = 0.5 / rate_hz_;
  for (const bool from_start : {time_s < kSeekLead_s, true}) {
    ForgetWaiting();
    bool sought = !from_start;
    for (Film& film : films_) {
      sought = sought && film.device.seek && film.device.seek(time_s - kSeekLead_s).ok();
    }
    if (!sought) {
      if (const ::palace::Status opened = OpenFilms(); !opened) {
        return opened;
      }
    }
    for (bool first = true;; first = false) {
      Result<PicturePair> pair = ReadPair();
      if (!pair) {
        return pair.error();
      }
      if (SecondsBetween(FilmTime(time_s - half_period_s), pair->left.time) < 0) {
        continue;
      }
      if (sought && first) {
        break;  // the container went too far: read up to the place from the start
      }
      pending_ = std::move(pair).value();
      return Ok();
    }
  }
  PALACE_CHECK(false, time_s);
}

Result<PicturePair> VideoSource::PairAt(std::int64_t index) {
  if (index != position_) {
    jump_pending_ = true;
    if (const ::palace::Status there = GoTo(static_cast<double>(index) / rate_hz_); !there) {
      return there.error();
    }
  }
  position_ = index + 1;
  if (pending_) {
    return std::exchange(pending_, std::nullopt).value();
  }
  return ReadPair();
}

void VideoSource::NoteEnd() {
  const std::lock_guard lock(mutex_);
  for (std::size_t i = 0; i < films_.size(); ++i) {
    const double announced = static_cast<double>(films_[i].device.frame_count);
    const double seen = std::round(films_[i].newest_s * rate_hz_) + 1;
    if (seen < kWholeShare * announced - 1) {
      char text[96];
      std::snprintf(text, sizeof text, ": ends after %.0f of %.0f pictures; it may be cut short",
                    seen, announced);
      counters_[i].problem = films_[i].request.address + text;
    }
  }
}

Result<std::shared_ptr<const FrameBundle>> VideoSource::Next(std::stop_token stop) {
  for (;;) {
    const auto index = turns_->Wait(stop);
    if (!index) {
      return Error{
          ErrorCode::kEnd,
          cameras_.rig_toml + (stop.stop_requested() ? ": stopped" : ": end of the video")};
    }
    if (end_ && *index == 0 && position_ >= *end_) {
      lap_start_s_ += lap_s_;
    }
    Result<PicturePair> pair = PairAt(*index);
    if (!pair && pair.error().code == ErrorCode::kEnd) {
      NoteEnd();
      turns_->EndsAt(*index);
      end_ = *index;
      continue;
    }
    if (!pair) {
      return pair.error();
    }
    const double time_s = SecondsBetween({0}, pair->left.time);
    lap_s_ = time_s + 1 / rate_hz_;
    auto bundle = BundleOf(rig_, cameras_.file.pose,
                           std::make_shared<const StereoFrame>(StereoFrame{
                               AddSeconds(kRecordedStart, lap_start_s_ + time_s),
                               std::move(pair->left.grey), std::move(pair->right.grey)}));
    bundle->sequence = ++sequence_;
    bundle->discontinuity = std::exchange(jump_pending_, false);
    return std::shared_ptr<const FrameBundle>(std::move(bundle));
  }
}

SourceStatus VideoSource::Status() const {
  SourceStatus status;
  status.kind = SourceKind::kVideo;
  status.name = cameras_.rig_toml;
  turns_->FillStatus(status);
  const std::lock_guard lock(mutex_);
  status.cameras = counters_;
  return status;
}

}  // namespace palace
