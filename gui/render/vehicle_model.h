// Vehicle models: small bodies of lit primitives for the 3-D view and the views of the truth.
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "engine/core/frames.h"
#include "engine/core/result.h"
#include "gui/render/gl_handle.h"
#include "gui/render/line_batch.h"
#include "gui/render/shader.h"
#include "gui/render/vehicle_body.h"

namespace palace {

/// Body frame B; the autopilot's reference point lies in the middle of the fuselage. The helicopter
/// is 3.6 m from the rotor's front to the tail. The multirotor's propellers reach as far out as the
/// large rotor: either body is as wide as the vehicle's rotor diameter when scaled by it.
inline constexpr double kRotorRadius_m = 1.55;
inline const Eigen::Vector3d kRotorHub_B{0.12, 0, -0.62};
inline const Eigen::Vector3d kSkidCentre_B{0.1, 0, 0.62};

struct VehicleVertex {
  Eigen::Vector3f position_B;
  Eigen::Vector3f normal_B;
  float grey = 0;
};
std::vector<VehicleVertex> VehicleTriangles(VehicleBody body);

class VehiclePainter {
 public:
  Status Start();
  /// With depth test. `size` enlarges the model about its reference point.
  void Draw(VehicleBody body, const Eigen::Matrix4d& clip_from_world, const RigidTransform& X_WB,
            double size, const Eigen::Vector3d& eye_W) const;

 private:
  ShaderProgram shader_;
  GlVertexArray array_;
  GlBuffer buffer_;
  GLint first_[2] = {};  ///< vertex of each body
  GLsizei count_[2] = {};
};

/// Rotor discs, their rims and two blades each, as translucent triangles and lines.
void AddRotors(LineBatch& batch, VehicleBody body, const RigidTransform& X_WB, double size,
               double ui_scale);

}  // namespace palace
