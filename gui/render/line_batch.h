// LineBatch: lines of any width in pixels. OpenGL core promises one pixel only, so each segment
// becomes a rectangle on the screen.
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "gui/render/gl_handle.h"
#include "gui/render/picture.h"
#include "gui/render/shader.h"

namespace palace {

struct LineStyle {
  Rgba8 colour;
  double width_px = 1;
  double dash_px = 0;  ///< 0: solid
  double gap_px = 0;
};

/// Triangles in clip space with one colour each, collected on the CPU and drawn at once.
class LineBatch {
 public:
  LineBatch(const Eigen::Matrix4d& clip_from_world, double width_px, double height_px)
      : clip_from_world_(clip_from_world), width_px_(width_px), height_px_(height_px) {}

  void Line(const Eigen::Vector3d& a_W, const Eigen::Vector3d& b_W, const LineStyle& style);
  /// Dashes run on over the corners.
  void Polyline(const std::vector<Eigen::Vector3d>& points_W, const LineStyle& style);
  void Triangle(const Eigen::Vector3d& a_W, const Eigen::Vector3d& b_W, const Eigen::Vector3d& c_W,
                Rgba8 colour);
  /// A short line across the screen, centred on a point.
  void ScreenTick(const Eigen::Vector3d& at_W, double half_length_px, const LineStyle& style);
  /// Pixel from the picture's top-left corner; z is 0 when the point lies behind the eye.
  Eigen::Vector3d PixelFromPoint(const Eigen::Vector3d& p_W) const;

  struct Vertex {
    Eigen::Vector4f clip;
    Rgba8 colour;
  };
  const std::vector<Vertex>& vertices() const { return vertices_; }
  void Clear() { vertices_.clear(); }

 private:
  Eigen::Vector4d Clip(const Eigen::Vector3d& p_W) const;
  double Segment(Eigen::Vector4d a, Eigen::Vector4d b, const LineStyle& style, double phase_px);
  void Stroke(const Eigen::Vector4d& a, const Eigen::Vector4d& b, const LineStyle& style);

  Eigen::Matrix4d clip_from_world_;
  double width_px_;
  double height_px_;
  std::vector<Vertex> vertices_;
};

/// Draws batches; holds the GL objects between frames.
class LinePainter {
 public:
  Status Start();
  void Draw(const LineBatch& batch) const;

 private:
  ShaderProgram shader_;
  GlVertexArray array_;
  GlBuffer buffer_;
};

}  // namespace palace
