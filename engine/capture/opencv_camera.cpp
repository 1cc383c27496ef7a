#include "engine/capture/opencv_camera.h"

#include <cstdlib>
#include <exception>
#include <memory>
#include <mutex>
#include <utility>

#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "engine/capture/camera_address.h"
#include "engine/core/time.h"

namespace palace {
namespace {

constexpr int kLargestSide_px = 16384;
constexpr int kOpenTimeout_ms = 5000;
constexpr int kReadTimeout_ms = 3000;
constexpr const char* kReadTimeout_s = "3";
constexpr double kHighestRate_hz = 1000;  // beyond: a container that does not know

/// Both libraries take these before they are first used, and V4L2's wait is no property.
void PrepareLibraries() {
  static std::once_flag once;
  std::call_once(once, [] {
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    constexpr int kKeepWhatIsSet = 0;
    setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", kKeepWhatIsSet);  // AV_LOG_QUIET
    setenv("OPENCV_VIDEOIO_V4L_SELECT_TIMEOUT", kReadTimeout_s, kKeepWhatIsSet);
  });
}

/// Runs `action`; what the library throws becomes an error.
template <typename Action>
auto Guarded(const std::string& name, Action&& action) -> decltype(action()) {
  try {
    return action();
  } catch (const std::exception& error) {
    return UnavailableError(name + ": " + error.what());
  } catch (...) {
    return UnavailableError(name + ": the video library failed; try another camera or file");
  }
}

Result<ImageU8> Grey(const cv::Mat& picture, const std::string& name) {
  if (picture.empty() || picture.depth() != CV_8U || picture.cols > kLargestSide_px ||
      picture.rows > kLargestSide_px) {
    return InvalidError(name + ": a picture could not be decoded to 8 bits a channel");
  }
  ImageU8 grey(picture.cols, picture.rows);
  cv::Mat target(grey.height(), grey.width(), CV_8UC1, grey.pixels().data());
  switch (picture.channels()) {
    case 1:
      picture.copyTo(target);
      return grey;
    case 3:
      cv::cvtColor(picture, target, cv::COLOR_BGR2GRAY);
      return grey;
    case 4:
      cv::cvtColor(picture, target, cv::COLOR_BGRA2GRAY);
      return grey;
    default:
      return InvalidError(name + ": a picture has " + std::to_string(picture.channels()) +
                          " channels; 1, 3 or 4 can be used");
  }
}

/// An open cv::VideoCapture; where a file stands.
class Capture {
 public:
  explicit Capture(const CameraRequest& request) : request_(request), name_(NameOf(request)) {}

  bool Open() {
    if (request_.kind == CameraKind::kDevice) {
      if (!video_.open(request_.address, cv::CAP_V4L2)) {
        return false;
      }
      // The pixel format first: it decides which sizes and rates there are. A driver may refuse any
      // of them; the size of the pictures is checked as they come.
      if (request_.fourcc.size() == 4) {
        const char* f = request_.fourcc.c_str();
        video_.set(cv::CAP_PROP_FOURCC, cv::VideoWriter::fourcc(f[0], f[1], f[2], f[3]));
      }
      video_.set(cv::CAP_PROP_FRAME_WIDTH, request_.width);
      video_.set(cv::CAP_PROP_FRAME_HEIGHT, request_.height);
      if (request_.rate_hz > 0) {
        video_.set(cv::CAP_PROP_FPS, request_.rate_hz);
      }
      return true;
    }
    return video_.open(request_.address, cv::CAP_FFMPEG,
                       {cv::CAP_PROP_OPEN_TIMEOUT_MSEC, kOpenTimeout_ms,
                        cv::CAP_PROP_READ_TIMEOUT_MSEC, kReadTimeout_ms});
  }

  Result<CameraPicture> Read() {
    if (!video_.grab()) {
      return request_.kind == CameraKind::kFile
                 ? Error{ErrorCode::kEnd, name_ + ": end of the video"}
                 : UnavailableError(name_ + ": the camera gives no pictures any more");
    }
    const double arrived_s = MonotonicSeconds();
    CameraPicture picture;
    picture.time_s =
        request_.kind == CameraKind::kFile ? video_.get(cv::CAP_PROP_POS_MSEC) * 1e-3 : arrived_s;
    cv::Mat pixels;
    if (!video_.retrieve(pixels)) {
      return InvalidError(name_ + ": a picture could not be decoded");
    }
    Result<ImageU8> grey = Grey(pixels, name_);
    if (!grey) {
      return grey.error();
    }
    picture.grey = std::move(grey).value();
    return picture;
  }

  Status Seek(double time_s) {
    if (!video_.set(cv::CAP_PROP_POS_MSEC, time_s * 1e3)) {
      return UnavailableError(name_ + ": this video cannot be searched; play it from its start");
    }
    return Ok();
  }

  double Property(int property) const {
    const double value = video_.get(property);
    return value > 0 ? value : 0;
  }
  const std::string& name() const { return name_; }

 private:
  const CameraRequest request_;
  const std::string name_;
  cv::VideoCapture video_;
};

Error WhyNotOpen(const CameraRequest& request, const std::string& name) {
  switch (request.kind) {
    case CameraKind::kDevice:
      return UnavailableError(name +
                              ": the camera cannot be opened; another program may use it, or it "
                              "gives no pictures (v4l2-ctl --list-devices shows which do)");
    case CameraKind::kStream:
      return UnavailableError(name +
                              ": no stream there; check address and network, and that the camera "
                              "is on");
    case CameraKind::kFile:
      return InvalidError(name +
                          ": this is no video that can be decoded; record it again, or convert it "
                          "(e.g. MJPEG in AVI, H.264 in MP4)");
  }
  PALACE_CHECK(false);
}

}  // namespace

Result<CameraDevice> OpenWithOpenCv(const CameraRequest& request) {
  PrepareLibraries();
  if (const Status fine = CheckCameraAddress(request); !fine) {
    return fine.error();
  }
  const auto capture = std::make_shared<Capture>(request);
  return Guarded(capture->name(), [&]() -> Result<CameraDevice> {
    if (!capture->Open()) {
      return WhyNotOpen(request, capture->name());
    }
    const double width = capture->Property(cv::CAP_PROP_FRAME_WIDTH);
    const double height = capture->Property(cv::CAP_PROP_FRAME_HEIGHT);
    if (width > kLargestSide_px || height > kLargestSide_px) {
      return InvalidError(capture->name() + ": pictures of " + std::to_string(width) + " x " +
                          std::to_string(height) + " px are too large, at most " +
                          std::to_string(kLargestSide_px) + " px a side; record smaller ones");
    }
    CameraDevice device;
    const double rate_hz = capture->Property(cv::CAP_PROP_FPS);
    device.rate_hz = rate_hz <= kHighestRate_hz ? rate_hz : 0;
    device.read = [capture] { return Guarded(capture->name(), [&] { return capture->Read(); }); };
    if (request.kind == CameraKind::kFile) {
      const double count = capture->Property(cv::CAP_PROP_FRAME_COUNT);
      device.frame_count = count < 1e15 ? static_cast<std::uint64_t>(count) : 0;
      device.seek = [capture](double time_s) {
        return Guarded(capture->name(), [&] { return capture->Seek(time_s); });
      };
    }
    return device;
  });
}

}  // namespace palace
