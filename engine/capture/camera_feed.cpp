#include "engine/capture/camera_feed.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

namespace palace {
namespace {

constexpr double kPeriodSmoothing = 0.1;
constexpr double kMissingAfterPeriods = 1.5;
/// Pictures in a row that cannot be decoded before the camera counts as lost.
constexpr std::uint64_t kMostUndecodable = 30;

}  // namespace

CameraFeed::CameraFeed(std::string name, CameraRequest request, OpenCamera open, Check check,
                       ReopenPauses pauses)
    : request_(std::move(request)),
      open_(std::move(open)),
      check_(std::move(check)),
      pauses_(pauses),
      pause_s_(pauses.first_s) {
  counters_.name = std::move(name);
}

Result<CameraPicture> CameraFeed::ReadFitting(CameraDevice& device) {
  Result<CameraPicture> picture = device.read();
  while (!picture && picture.error().code == ErrorCode::kInvalid &&
         undecodable_ < kMostUndecodable) {
    ++undecodable_;
    picture = device.read();
  }
  if (picture) {
    if (const Status fits = check_(picture->grey); !fits) {
      return fits.error();
    }
  }
  return picture;
}

Result<CameraPicture> CameraFeed::Open() {
  Result<CameraDevice> device = open_(request_);
  if (!device) {
    return device.error();
  }
  undecodable_ = 0;
  Result<CameraPicture> picture = ReadFitting(*device);
  if (picture) {
    expected_hz_ = request_.rate_hz > 0 ? request_.rate_hz : device->rate_hz;
    device_ = std::move(device).value();
  }
  return picture;
}

Status CameraFeed::Start() {
  Result<CameraPicture> picture = Open();
  if (!picture) {
    return picture.error();
  }
  first_ = std::move(picture).value();
  return Ok();
}

void CameraFeed::Count(const CameraPicture& picture) {
  const double period_s = picture.time_s - newest_s_;
  if (period_s > 0) {
    const double mean_s =
        std::isnan(counters_.rate_hz)
            ? period_s
            : (1 - kPeriodSmoothing) / counters_.rate_hz + kPeriodSmoothing * period_s;
    counters_.rate_hz = 1 / mean_s;
    const double periods = period_s * expected_hz_;
    const auto missing = periods > kMissingAfterPeriods
                             ? static_cast<std::uint64_t>(std::llround(periods)) - 1
                             : std::uint64_t{0};
    // One that could not be decoded leaves a gap too: count it once.
    counters_.device_dropped += std::max(missing, undecodable_);
  }
  undecodable_ = 0;
  newest_s_ = picture.time_s;
  ++counters_.frames;
}

CameraFeed::Outcome CameraFeed::Lose(const Error& why, double now_s) {
  device_.reset();
  const double pause_s = pause_s_;
  retry_at_s_ = now_s + pause_s;
  pause_s_ = std::min(2 * pause_s_, pauses_.longest_s);
  counters_.problem = why.message + "; trying again";
  counters_.rate_hz = NAN;
  return {std::nullopt, pause_s};
}

CameraFeed::Outcome CameraFeed::Step(double now_s) {
  try {
    return TryStep(now_s);
  } catch (const std::exception& error) {
    // Of its library, or for want of memory: one camera is lost for now, not the program.
    return Lose(UnavailableError(counters_.name + ": " + error.what()), now_s);
  }
}

CameraFeed::Outcome CameraFeed::TryStep(double now_s) {
  if (first_) {
    Count(*first_);
    return {std::exchange(first_, std::nullopt), 0};
  }
  if (!device_) {
    if (now_s < retry_at_s_) {
      return {std::nullopt, retry_at_s_ - now_s};
    }
    Result<CameraPicture> picture = Open();
    if (!picture) {
      return Lose(picture.error(), now_s);
    }
    ++counters_.reopens;
    counters_.problem.clear();
    pause_s_ = pauses_.first_s;
    newest_s_ = NAN;  // the time without a camera is no gap in its beat
    Count(*picture);
    return {std::move(picture).value(), 0};
  }
  Result<CameraPicture> picture = ReadFitting(*device_);
  if (!picture) {
    return Lose(picture.error(), now_s);
  }
  Count(*picture);
  return {std::move(picture).value(), 0};
}

}  // namespace palace
