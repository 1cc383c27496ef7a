#include "engine/wire/sensor_messages.h"

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <optional>

#include "engine/core/text.h"
#include "engine/wire/wire_fields.h"
#include "engine/wire/wire_pack.h"

namespace palace {
namespace {

Error NotFinite(const char* what) {
  return InvalidError(std::string(what) + " holds a number that is not finite");
}

/// What no vehicle here can be: a flipped bit of an exponent, or another unit.
struct Quantity {
  const char* name;
  double most;
  const char* unit;
};
constexpr Quantity kPosition{"position", 1e6, "m"};
constexpr Quantity kVelocity{"velocity", 1e3, "m/s"};
constexpr Quantity kRate{"angular rate", 1e3, "rad/s"};
constexpr Quantity kForce{"specific force", 1e4, "m/s^2"};
constexpr Quantity kSigma{"sigma", 1e6, "m"};
constexpr Quantity kRange{"range", 1e5, "m"};

struct Value {
  Quantity quantity;
  Eigen::Vector3d v;
};
/// The first value that is not finite or larger than can be.
std::optional<Error> Refused(const char* what, std::initializer_list<Value> values) {
  for (const Value& value : values) {
    if (!value.v.allFinite()) {
      return NotFinite(what);
    }
    if (value.v.cwiseAbs().maxCoeff() > value.quantity.most) {
      const Quantity& q = value.quantity;
      return InvalidError(what + WithNumbers(": %.3g ", value.v.cwiseAbs().maxCoeff()) + q.unit +
                          " of " + q.name + WithNumbers(", at most %.3g ", q.most) + q.unit);
    }
  }
  return std::nullopt;
}

}  // namespace

Result<VehiclePose> PoseFromWire(const WireMessage& message) {
  return DecodeAnd<pose_t>(message, [](const pose_t& m) -> Result<VehiclePose> {
    const Eigen::Vector4d q = Unpack(m.orientation);
    VehiclePose pose{
        {m.utime}, {Eigen::Matrix3d(), Unpack(m.pos)}, Unpack(m.vel), Unpack(m.rotation_rate)};
    if (const auto refused = Refused(
            "pose",
            {{kPosition, pose.X_WB.p}, {kVelocity, pose.v_WB}, {kRate, pose.angular_rate_B}})) {
      return *refused;
    }
    if (!q.allFinite()) {
      return NotFinite("pose");
    }
    if (std::abs(q.norm() - 1) > 0.01) {
      return InvalidError("the quaternion of a pose has length " + std::to_string(q.norm()) +
                          ", not 1");
    }
    pose.X_WB.R = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
    return pose;
  });
}

Result<ImuSample> ImuFromWire(const WireMessage& message) {
  return DecodeAnd<imu_t>(message, [](const imu_t& m) -> Result<ImuSample> {
    const ImuSample sample{{m.utime}, Unpack(m.specific_force), Unpack(m.angular_rate)};
    if (const auto refused = Refused("inertial sample", {{kForce, sample.specific_force_B},
                                                         {kRate, sample.angular_rate_B}})) {
      return *refused;
    }
    return sample;
  });
}

Result<GpsFix> GpsFromWire(const WireMessage& message) {
  return DecodeAnd<gps_t>(message, [](const gps_t& m) -> Result<GpsFix> {
    const GpsFix fix{
        {m.utime}, Unpack(m.pos), Unpack(m.vel), m.sigma_horizontal_m, m.sigma_vertical_m};
    if (const auto refused =
            Refused("GPS fix", {{kPosition, fix.p_WB},
                                {kVelocity, fix.v_WB},
                                {kSigma, {fix.sigma_horizontal_m, fix.sigma_vertical_m, 0}}})) {
      return *refused;
    }
    return fix;
  });
}

Result<LaserRange> LaserFromWire(const WireMessage& message) {
  return DecodeAnd<laser_range_t>(message, [](const laser_range_t& m) -> Result<LaserRange> {
    if (!std::isnan(m.range_m)) {  // NaN: no return
      if (const auto refused = Refused("laser", {{kRange, {m.range_m, 0, 0}}})) {
        return *refused;
      }
    }
    return LaserRange{{m.utime}, m.range_m};
  });
}

Result<VehicleStatus> StatusFromWire(const WireMessage& message) {
  return DecodeAnd<vehicle_status_t>(
      message, [](const vehicle_status_t& m) -> Result<VehicleStatus> {
        if (m.mode < vehicle_status_t::UNKNOWN || m.mode > vehicle_status_t::GO) {
          return InvalidError("vehicle mode " + std::to_string(m.mode) + " is not one of 0..9");
        }
        // NaN: the vehicle measures no wind, or does not know its fuel.
        if (std::isinf(m.wind_speed_mps) || std::isinf(m.wind_from_rad) ||
            std::isinf(m.battery_or_fuel)) {
          return NotFinite("vehicle status");
        }
        VehicleStatus status;
        status.time = {m.utime};
        status.boot_id = IdFromWire(m.boot_id);
        status.mode = static_cast<VehicleMode>(m.mode);
        status.on_ground = m.on_ground != 0;
        status.flies_on_vision = m.flies_on_vision != 0;
        status.approval_id = IdFromWire(m.approval_id);
        status.wind_speed_mps = m.wind_speed_mps;
        status.wind_from_rad = m.wind_from_rad;
        status.battery_or_fuel = m.battery_or_fuel;
        status.simulated = m.simulated != 0;
        return status;
      });
}

Result<CommandAck> AckFromWire(const WireMessage& message) {
  return DecodeAnd<command_ack_t>(message, [](const command_ack_t& m) -> Result<CommandAck> {
    if (m.result != 0 && m.result != 1) {
      return InvalidError("answer " + std::to_string(m.result) + " is neither 0 nor 1");
    }
    return CommandAck{
        {m.utime}, IdFromWire(m.command_id), static_cast<AckResult>(m.result), m.reason};
  });
}

bool IsPoseMessage(const WireMessage& message) {
  return DecodePayload<pose_t>(message.payload).ok();
}

Result<ArrivalNotes> ArrivalFromWire(const WireMessage& message) {
  return DecodeAnd<arrival_t>(message, [](const arrival_t& m) -> Result<ArrivalNotes> {
    ArrivalNotes notes;
    if (m.has_clock != 0) {
      notes.clock = ClockReading{m.station_s, m.estimating != 0, m.drift_ppm,
                                 m.jitter_s,  m.stepped_s,       m.stalled_s};
    }
    if (m.left_alone != 0) {
      notes.left_alone = Timestamp{m.left_utime};
    }
    if (m.right_alone != 0) {
      notes.right_alone = Timestamp{m.right_utime};
    }
    notes.poses_invalid = m.poses_invalid;
    static_assert(sizeof(m.overtaken) / sizeof(m.overtaken[0]) == kChannelCount);
    std::copy(std::begin(m.overtaken), std::end(m.overtaken), notes.overtaken.begin());
    if (*std::min_element(notes.overtaken.begin(), notes.overtaken.end()) < 0) {
      return InvalidError("a count of overtaken messages is negative");
    }
    return notes;
  });
}

Result<Truth> DecodeTruth(const WireMessage& message) {
  return DecodeAnd<truth_t>(message, [](const truth_t& m) -> Result<Truth> {
    return Truth{{m.utime}, {UnpackRotation(m.rotation), Unpack(m.pos)}, Unpack(m.vel)};
  });
}

}  // namespace palace
