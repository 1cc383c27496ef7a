#include "gui/render/line_batch.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "shader_text.h"

namespace palace {
namespace {

constexpr double kNearest_w = 0.05;
constexpr int kMostDashes = 400;

}  // namespace

Eigen::Vector4d LineBatch::Clip(const Eigen::Vector3d& p_W) const {
  return clip_from_world_ * p_W.homogeneous();
}

Eigen::Vector3d LineBatch::PixelFromPoint(const Eigen::Vector3d& p_W) const {
  const Eigen::Vector4d clip = Clip(p_W);
  if (clip.w() < kNearest_w) {
    return Eigen::Vector3d::Zero();
  }
  return {(clip.x() / clip.w() + 1) / 2 * width_px_, (clip.y() / clip.w() + 1) / 2 * height_px_, 1};
}

void LineBatch::Triangle(const Eigen::Vector3d& a_W, const Eigen::Vector3d& b_W,
                         const Eigen::Vector3d& c_W, Rgba8 colour) {
  for (const Eigen::Vector3d& p : {a_W, b_W, c_W}) {
    vertices_.push_back({Clip(p).cast<float>(), colour});
  }
}

void LineBatch::Stroke(const Eigen::Vector4d& a, const Eigen::Vector4d& b, const LineStyle& style) {
  const Eigen::Vector2d half(width_px_ / 2, height_px_ / 2);
  const Eigen::Vector2d a_px = (a.head<2>() / a.w()).cwiseProduct(half);
  const Eigen::Vector2d b_px = (b.head<2>() / b.w()).cwiseProduct(half);
  Eigen::Vector2d along = b_px - a_px;
  const double length = along.norm();
  if (length < 1e-6) {
    return;
  }
  along /= length;
  const Eigen::Vector2d side =
      Eigen::Vector2d(-along.y(), along.x()).cwiseQuotient(half) * (style.width_px / 2);
  const auto corner = [&](const Eigen::Vector4d& p, double sign) {
    Eigen::Vector4d moved = p;
    moved.head<2>() += sign * side * p.w();
    return Vertex{moved.cast<float>(), style.colour};
  };
  const Vertex corners[4] = {corner(a, -1), corner(b, -1), corner(b, 1), corner(a, 1)};
  for (const int k : {0, 1, 2, 0, 2, 3}) {
    vertices_.push_back(corners[k]);
  }
}

/// Cuts at the near plane, then into dashes measured on the screen. Returns the dash phase at b.
double LineBatch::Segment(Eigen::Vector4d a, Eigen::Vector4d b, const LineStyle& style,
                          double phase_px) {
  if (a.w() < kNearest_w && b.w() < kNearest_w) {
    return phase_px;
  }
  if (a.w() < kNearest_w) {
    a = b + (a - b) * ((b.w() - kNearest_w) / (b.w() - a.w()));
  } else if (b.w() < kNearest_w) {
    b = a + (b - a) * ((a.w() - kNearest_w) / (a.w() - b.w()));
  }
  if (style.dash_px <= 0) {
    Stroke(a, b, style);
    return 0;
  }
  const Eigen::Vector2d half(width_px_ / 2, height_px_ / 2);
  const double length = (b.head<2>() / b.w() - a.head<2>() / a.w()).cwiseProduct(half).norm();
  const double period = style.dash_px + style.gap_px;
  // A share s of the way on the screen lies at t = s a.w / (b.w + s (a.w - b.w)) in space.
  const auto at = [&](double pixels) -> Eigen::Vector4d {
    const double s = std::clamp(pixels / length, 0.0, 1.0);
    const double t = s * a.w() / (b.w() + s * (a.w() - b.w()));
    return a + (b - a) * t;
  };
  double from = -std::fmod(phase_px, period);
  for (int i = 0; i < kMostDashes && from < length; ++i, from += period) {
    const double low = std::max(from, 0.0), high = std::min(from + style.dash_px, length);
    if (high > low) {
      Stroke(at(low), at(high), style);
    }
  }
  return std::fmod(phase_px + length, period);
}

void LineBatch::Line(const Eigen::Vector3d& a_W, const Eigen::Vector3d& b_W,
                     const LineStyle& style) {
  Segment(Clip(a_W), Clip(b_W), style, 0);
}

void LineBatch::Polyline(const std::vector<Eigen::Vector3d>& points_W, const LineStyle& style) {
  double phase_px = 0;
  for (std::size_t i = 1; i < points_W.size(); ++i) {
    phase_px = Segment(Clip(points_W[i - 1]), Clip(points_W[i]), style, phase_px);
  }
}

void LineBatch::ScreenTick(const Eigen::Vector3d& at_W, double half_length_px,
                           const LineStyle& style) {
  const Eigen::Vector4d centre = Clip(at_W);
  if (centre.w() < kNearest_w) {
    return;
  }
  Eigen::Vector4d a = centre, b = centre;
  const double reach = half_length_px / (width_px_ / 2) * centre.w();
  a.x() -= reach;
  b.x() += reach;
  Stroke(a, b, style);
}

Status LinePainter::Start() {
  Result<ShaderProgram> built =
      ShaderProgram::Build("lines", {shader_text::line_vertex}, {shader_text::line_fragment});
  if (!built) {
    return built.error();
  }
  shader_ = std::move(built).value();
  array_ = GlVertexArray::Create();
  buffer_ = GlBuffer::Create();
  glBindVertexArray(array_.name());
  glBindBuffer(GL_ARRAY_BUFFER, buffer_.name());
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, sizeof(LineBatch::Vertex), nullptr);
  glEnableVertexAttribArray(1);
  glVertexAttribPointer(1, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(LineBatch::Vertex),
                        reinterpret_cast<const void*>(offsetof(LineBatch::Vertex, colour)));
  return Ok();
}

void LinePainter::Draw(const LineBatch& batch) const {
  if (batch.vertices().empty()) {
    return;
  }
  shader_.Use();
  glBindVertexArray(array_.name());
  glBindBuffer(GL_ARRAY_BUFFER, buffer_.name());
  glBufferData(GL_ARRAY_BUFFER,
               static_cast<GLsizeiptr>(batch.vertices().size() * sizeof(LineBatch::Vertex)),
               batch.vertices().data(), GL_STREAM_DRAW);
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(batch.vertices().size()));
}

}  // namespace palace
