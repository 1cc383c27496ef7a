#include "gui/render/terrain_renderer.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/core/median.h"
#include "gui/render/map_colours.h"
#include "shader_text.h"

namespace palace {
namespace {

constexpr float kTallest_m = 0.75F;  ///< above it: points, no surface
constexpr float kFlat_m = 0.07F;     ///< under the noise of the map
constexpr int kBlock = 4;            ///< cells merged where the ground is flat

std::optional<double> MedianHeight(const ElevationMap& map) {
  std::vector<float> known;
  for (const float height : map.Measured().cells()) {
    if (!std::isnan(height)) {
      known.push_back(height);
    }
  }
  if (known.empty()) {
    return std::nullopt;
  }
  return UpperMedian(known);
}

void PositionAttribute(const GlVertexArray& array, const GlBuffer& buffer) {
  glBindVertexArray(array.name());
  glBindBuffer(GL_ARRAY_BUFFER, buffer.name());
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 3 * sizeof(float), nullptr);
}

/// Two triangles over the vertices (row, col) to (row + span, col + span).
void AddQuad(std::vector<GLuint>& indices, int cols, int row, int col, int span) {
  const GLuint a = static_cast<GLuint>(row * cols + col);
  const GLuint b = a + static_cast<GLuint>(span);
  const GLuint c = a + static_cast<GLuint>(span * cols);
  for (const GLuint k : {a, c, b, b, c, c + static_cast<GLuint>(span)}) {
    indices.push_back(k);
  }
}

/// True when the block's inner vertices lie within kFlat_m of the patch through its corners.
bool IsFlat(const GridF& height_m, int row, int col, int span) {
  const float a = height_m.at(row, col), b = height_m.at(row, col + span);
  const float c = height_m.at(row + span, col), d = height_m.at(row + span, col + span);
  for (int i = 0; i <= span; ++i) {
    for (int j = 0; j <= span; ++j) {
      const float s = static_cast<float>(i) / static_cast<float>(span);
      const float t = static_cast<float>(j) / static_cast<float>(span);
      const float patch = (a * (1 - t) + b * t) * (1 - s) + (c * (1 - t) + d * t) * s;
      // Also false when one of them is unknown.
      if (!(std::abs(height_m.at(row + i, col + j) - patch) < kFlat_m)) {
        return false;
      }
    }
  }
  return true;
}

/// One cell's quad, left out when a corner is unknown or tall or the step is too high.
void AddCell(std::vector<GLuint>& indices, const GridF& height_m, int row, int col, float tall_m) {
  float low = height_m.at(row, col), high = low;
  bool known = true;
  for (const float corner : {height_m.at(row, col), height_m.at(row, col + 1),
                             height_m.at(row + 1, col), height_m.at(row + 1, col + 1)}) {
    known = known && !std::isnan(corner);
    low = std::min(low, corner);
    high = std::max(high, corner);
  }
  if (known && high - low <= kTallest_m && high <= tall_m) {
    AddQuad(indices, height_m.cols(), row, col, 1);
  }
}

/// Flat blocks become two triangles: software rendering pays by the triangle.
std::vector<GLuint> SurfaceIndices(const ElevationMap& elevation, float tall_m) {
  const GridF& height_m = elevation.Measured();
  std::vector<GLuint> indices;
  for (int row = 0; row + 1 < height_m.rows(); row += kBlock) {
    for (int col = 0; col + 1 < height_m.cols(); col += kBlock) {
      const bool whole = row + kBlock < height_m.rows() && col + kBlock < height_m.cols();
      if (whole && height_m.at(row, col) <= tall_m && IsFlat(height_m, row, col, kBlock)) {
        AddQuad(indices, height_m.cols(), row, col, kBlock);
        continue;
      }
      for (int i = row; i < std::min(row + kBlock, height_m.rows() - 1); ++i) {
        for (int j = col; j < std::min(col + kBlock, height_m.cols() - 1); ++j) {
          AddCell(indices, height_m, i, j, tall_m);
        }
      }
    }
  }
  return indices;
}

template <typename T>
GLsizeiptr BytesOf(const std::vector<T>& values) {
  return static_cast<GLsizeiptr>(values.size() * sizeof(T));
}

}  // namespace

Status TerrainRenderer::Start() {
  Result<ShaderProgram> built = ShaderProgram::Build("terrain", {shader_text::terrain_vertex},
                                                     {shader_text::terrain_fragment});
  if (!built) {
    return built.error();
  }
  shader_ = std::move(built).value();
  array_ = GlVertexArray::Create();
  vertices_ = GlBuffer::Create();
  indices_ = GlBuffer::Create();
  PositionAttribute(array_, vertices_);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.name());
  box_array_ = GlVertexArray::Create();
  box_vertices_ = GlBuffer::Create();
  PositionAttribute(box_array_, box_vertices_);
  return Ok();
}

void TerrainRenderer::Update(std::shared_ptr<const ElevationMap> elevation,
                             std::shared_ptr<const HazardMaps> hazards,
                             double safe_distance_max_m) {
  const bool same_mesh = elevation == elevation_;
  if (same_mesh && hazards == hazards_ && safe_distance_max_m == safe_distance_max_m_) {
    return;
  }
  elevation_ = std::move(elevation);
  hazards_ = std::move(hazards);
  safe_distance_max_m_ = safe_distance_max_m;
  if (elevation_ == nullptr) {
    index_count_ = 0;
    point_count_ = 0;
    ground_height_m_.reset();
    return;
  }
  if (!same_mesh) {
    ground_height_m_ = MedianHeight(*elevation_);
    BuildMesh(*elevation_);
  }
  const bool fits = hazards_ != nullptr && hazards_->geometry == elevation_->geometry;
  BuildCells(*elevation_, fits ? hazards_.get() : nullptr, safe_distance_max_m);
}

void TerrainRenderer::BuildMesh(const ElevationMap& elevation) {
  const GridGeometry& geometry = elevation.geometry;
  const float tall_m = static_cast<float>(ground_height_m_.value_or(0)) + kTallest_m;
  std::vector<Eigen::Vector3f> vertices;
  vertices.reserve(elevation.Measured().cells().size());
  std::vector<Eigen::Vector3f> points;
  for (int row = 0; row < geometry.rows; ++row) {
    for (int col = 0; col < geometry.cols; ++col) {
      const float height = elevation.Measured().at(row, col);
      vertices.emplace_back(static_cast<float>(geometry.NorthOfRow(row)),
                            static_cast<float>(geometry.EastOfCol(col)),
                            std::isnan(height) ? 0.0F : -height);
      if (height > tall_m) {
        points.push_back(vertices.back());
      }
    }
  }
  const std::vector<GLuint> indices = SurfaceIndices(elevation, tall_m);
  point_first_ = static_cast<GLsizei>(vertices.size());
  point_count_ = static_cast<GLsizei>(points.size());
  index_count_ = static_cast<GLsizei>(indices.size());
  vertices.insert(vertices.end(), points.begin(), points.end());
  glBindVertexArray(array_.name());
  glBindBuffer(GL_ARRAY_BUFFER, vertices_.name());
  glBufferData(GL_ARRAY_BUFFER, BytesOf(vertices), vertices.data(), GL_STATIC_DRAW);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, BytesOf(indices), indices.data(), GL_STATIC_DRAW);

  const float n0 = static_cast<float>(geometry.north_min_m);
  const float n1 = static_cast<float>(geometry.north_max_m());
  const float e0 = static_cast<float>(geometry.east_min_m);
  const float e1 = static_cast<float>(geometry.east_max_m());
  const float down = -static_cast<float>(ground_height_m_.value_or(0));
  const std::vector<Eigen::Vector3f> box = {
      {n0, e0, down}, {n1, e0, down}, {n0, e1, down}, {n1, e1, down}};
  glBindBuffer(GL_ARRAY_BUFFER, box_vertices_.name());
  glBufferData(GL_ARRAY_BUFFER, BytesOf(box), box.data(), GL_STATIC_DRAW);
}

void TerrainRenderer::BuildCells(const ElevationMap& elevation, const HazardMaps* hazards,
                                 double safe_distance_max_m) {
  ImageRgba cells(elevation.geometry.cols, elevation.geometry.rows, RgbaFromHex(0x9AA3AD, 0));
  if (hazards != nullptr) {
    const ValueRange range{0, static_cast<float>(safe_distance_max_m)};
    for (int row = 0; row < cells.height(); ++row) {
      for (int col = 0; col < cells.width(); ++col) {
        Rgba8& cell = cells.at(col, row);
        if (hazards->reasons.at(row, col) == kHazardNone) {
          cell = ColourOf(hazards->safe_distance_m.at(row, col), range, ColourMap::kSafeDistance);
        } else {
          cell.a = 128;
        }
      }
    }
  }
  cells_.Upload(cells, TextureFilter::kNearest);
}

void TerrainRenderer::Drape(std::shared_ptr<const ImageU8> picture, const PinholeCamera& camera,
                            const RigidTransform& X_WC) {
  if (picture == nullptr || picture->empty()) {
    draped_.reset();
    return;
  }
  if (picture != draped_) {
    picture_.Upload(*picture, TextureFilter::kMipmap);
    draped_ = std::move(picture);
  }
  // (u w, v w, -, w) of a point in W; u, v run from 0 to 1 over the picture.
  Eigen::Matrix4d K = Eigen::Matrix4d::Zero();
  K.row(0) << camera.fx_px / camera.width, 0, (camera.cx_px + 0.5) / camera.width, 0;
  K.row(1) << 0, camera.fy_px / camera.height, (camera.cy_px + 0.5) / camera.height, 0;
  K.row(3) << 0, 0, 1, 0;
  const RigidTransform X_CW = X_WC.Inverse();
  Eigen::Matrix4d camera_from_world = Eigen::Matrix4d::Identity();
  camera_from_world.topLeftCorner<3, 3>() = X_CW.R;
  camera_from_world.topRightCorner<3, 1>() = X_CW.p;
  picture_from_world_ = K * camera_from_world;
}

void TerrainRenderer::Draw(const Eigen::Matrix4d& clip_from_world, double ui_scale) const {
  if (elevation_ == nullptr) {
    return;
  }
  const GridGeometry& geometry = elevation_->geometry;
  shader_.Use();
  shader_.Set("clip_from_world", Eigen::Matrix4f(clip_from_world.cast<float>()));
  shader_.Set("picture_from_world", Eigen::Matrix4f(picture_from_world_.cast<float>()));
  shader_.Set("has_picture", draped_ != nullptr ? 1.0F : 0.0F);
  shader_.Set("map_corner", Eigen::Vector2f(static_cast<float>(geometry.north_max_m()),
                                            static_cast<float>(geometry.east_min_m)));
  shader_.Set("map_size_m", Eigen::Vector2f(static_cast<float>(geometry.rows * geometry.cell_m),
                                            static_cast<float>(geometry.cols * geometry.cell_m)));
  shader_.Set("ui_scale", static_cast<float>(ui_scale));
  shader_.Set("cells", 0);
  shader_.Set("picture", 1);
  glActiveTexture(GL_TEXTURE1);
  glBindTexture(GL_TEXTURE_2D, picture_.name());
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, cells_.name());

  shader_.Set("kind", 0);
  glDisable(GL_DEPTH_TEST);
  glBindVertexArray(box_array_.name());
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  glEnable(GL_DEPTH_TEST);
  glBindVertexArray(array_.name());
  shader_.Set("kind", 1);
  if (index_count_ > 0) {
    glDrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
  }
  shader_.Set("kind", 2);
  if (point_count_ > 0) {
    glEnable(GL_PROGRAM_POINT_SIZE);
    glDrawArrays(GL_POINTS, point_first_, point_count_);
  }
}

}  // namespace palace
