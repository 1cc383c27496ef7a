// Cameras through OpenCV's videoio: V4L2 devices, RTSP and HTTP streams, video files.
#pragma once

#include "engine/capture/camera_device.h"

namespace palace {

/// Opens with one named backend each (V4L2 for devices, FFmpeg for streams and files), never by
/// guessing: OpenCV's other backends would take a name for a pattern of pictures or a pipeline.
/// Colour becomes grey by ITU-R BT.601 luma (OpenCV's BGR2GRAY). A read waits some seconds at most.
/// OpenCV and FFmpeg print nothing from then on in this process: their warnings become our errors.
/// Sides above 16384 px are refused before anything is decoded. No exception leaves.
Result<CameraDevice> OpenWithOpenCv(const CameraRequest& request);

}  // namespace palace
