#include "engine/flight/slope_reference.h"

#include <cmath>

namespace palace {
namespace {

constexpr double kOffsetFade_s = 3.0;
constexpr double kStopsHarder = 4;

}  // namespace

SlopeReference SlopeReference::From(const FlightPath& path, const Eigen::Vector3d& p_W) {
  SlopeReference slope;
  slope.height_m = path.SkidHeight(p_W);
  slope.offset_W = p_W - path.BodyAt(slope.height_m);
  return slope;
}

void SlopeReference::Step(const FlightPath& path, bool moves, double dt_s,
                          MovingReference& reference) {
  const double wanted_mps = moves ? path.speeds.SinkRateAt(height_m) : 0;
  rate_mps =
      Slew(rate_mps, wanted_mps, (moves ? 1 : kStopsHarder) * path.speeds.acceleration_mps2 * dt_s);
  height_m -= rate_mps * dt_s;
  offset_W *= std::exp(-dt_s / kOffsetFade_s);
  reference.p_W = path.BodyAt(height_m) + offset_W;
  const Eigen::Vector3d v_W = -rate_mps * path.BodyPerMetre();
  reference.a_W = (v_W - reference.v_W) / dt_s;
  reference.v_W = v_W;
}

}  // namespace palace
