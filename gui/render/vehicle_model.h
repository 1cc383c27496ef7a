// Vehicle model: a small helicopter of lit primitives for the 3-D view.
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "engine/core/frames.h"
#include "engine/core/result.h"
#include "gui/render/gl_handle.h"
#include "gui/render/line_batch.h"
#include "gui/render/shader.h"

namespace palace {

/// Body frame B; the autopilot's reference point lies in the middle of the fuselage. 3.6 m from the
/// rotor's front to the tail.
inline constexpr double kRotorRadius_m = 1.55;
inline const Eigen::Vector3d kRotorHub_B{0.12, 0, -0.62};
inline const Eigen::Vector3d kSkidCentre_B{0.1, 0, 0.62};

struct VehicleVertex {
  Eigen::Vector3f position_B;
  Eigen::Vector3f normal_B;
  float grey = 0;
};
std::vector<VehicleVertex> VehicleTriangles();

class VehiclePainter {
 public:
  Status Start();
  /// The body with depth test, then the translucent rotor disc on top. `size` enlarges the model
  /// about its reference point.
  void Draw(const Eigen::Matrix4d& clip_from_world, const RigidTransform& X_WB, double size,
            const Eigen::Vector3d& eye_W) const;

 private:
  ShaderProgram shader_;
  GlVertexArray array_;
  GlBuffer buffer_;
  GLsizei count_ = 0;
};

/// Rotor disc, its rim and two blades, as translucent triangles and lines.
void AddRotor(LineBatch& batch, const RigidTransform& X_WB, double size, double ui_scale);

}  // namespace palace
