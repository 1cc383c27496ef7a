#include "engine/simulation/vehicle_tables.h"

#include <cmath>

#include "engine/core/text.h"
#include "engine/core/units.h"

namespace palace {
namespace {

constexpr ValueMark kMarks[] = {ValueMark::kSourced, ValueMark::kRecalled, ValueMark::kComputed,
                                ValueMark::kChosen};
constexpr double kSteps_hz = 1 / Rotorcraft::kStep_s;
constexpr double kLeastThrustToWeight = 1.2;  // less leaves nothing to steer with

std::optional<ValueMark> MarkOf(const std::string& word) {
  for (const ValueMark mark : kMarks) {
    if (word == ValueMarkName(mark)) {
      return mark;
    }
  }
  return std::nullopt;
}

}  // namespace

void ReadNumbers(TomlTable& table, const std::vector<NumberRow>& rows) {
  for (const NumberRow& row : rows) {
    *row.into = table.Number(row.key, row.limits) * row.si;
  }
}

double ReadRate(TomlTable& table, const char* key) {
  const double rate_hz = table.Number(key, {1, kSteps_hz, "give times a second"});
  const double steps = kSteps_hz / rate_hz;
  if (rate_hz > 0 && std::abs(steps - std::round(steps)) > 1e-9) {
    table.FailKey(key, " = " + NumberText(rate_hz) +
                           " does not divide the simulator's 200 steps a second; use 5, 10, 20, "
                           "25, 40, 50, 100 or 200");
  }
  return rate_hz;
}

MarkedTable::MarkedTable(const toml::table& root, const std::string& file, const std::string& name)
    : file_(file), name_(name), plain_(root, file, name) {
  const toml::node* node = root.get(name);
  table_ = node == nullptr ? nullptr : node->as_table();
}

void MarkedTable::Read(const char* key, double& into, const NumberLimits& limits, double si) {
  plain_.Allow(key);
  const toml::node* node = table_ == nullptr ? nullptr : table_->get(key);
  if (node == nullptr || !node->is_table()) {
    plain_.FailKey(key, std::string(node == nullptr ? " is missing; give" : " must be") +
                            " { value = ..., mark = \"...\" }");
    return;
  }
  TomlTable entry(*table_, file_, key);
  const double value = entry.Number("value", limits);
  const std::string word = entry.Text("mark");
  const std::optional<ValueMark> mark = MarkOf(word);
  if (!word.empty() && !mark) {
    entry.FailKey("mark", " = \"" + word + "\" must be sourced, recalled, computed or chosen");
  }
  const Status read = entry.Finish();
  if (!read) {
    error_ = error_ ? error_ : read.error();
    return;
  }
  into = value * si;
  marked_.push_back({name_ + "." + key, value, *mark});
}

Status MarkedTable::Finish(std::vector<MarkedValue>& marked) {
  // In the order of the file as far as a person reads errors: what is missing names itself first.
  if (Status plain = plain_.Finish(); !plain) {
    return plain;
  }
  if (error_) {
    return *error_;
  }
  marked.insert(marked.end(), marked_.begin(), marked_.end());
  return Ok();
}

Status ReadDerivatives(const toml::table& root, const std::string& file, VehicleDescription& v) {
  MarkedTable table(root, file, "derivatives");
  using P = RotorcraftParameters;
  P p{};
  const NumberLimits lag{0.005, 5, "give seconds; below a step of 0.005 s it is no lag"};
  table.Read("tau_f", p.tau_f, lag);
  table.Read("tau_s", p.tau_s, lag);
  table.Read("tau_p", p.tau_p,
             {0, Rotorcraft::kLongestPedalDelay_s - Rotorcraft::kStep_s, "give seconds"});
  const struct {
    const char* key;
    double P::*member;
  } rows[] = {{"Xu", &P::Xu},     {"Xa", &P::Xa},     {"Yv", &P::Yv},     {"Yb", &P::Yb},
              {"Lu", &P::Lu},     {"Lv", &P::Lv},     {"Lb", &P::Lb},     {"Mu", &P::Mu},
              {"Mv", &P::Mv},     {"Ma", &P::Ma},     {"Ab", &P::Ab},     {"Ac", &P::Ac},
              {"Alat", &P::Alat}, {"Alon", &P::Alon}, {"Ba", &P::Ba},     {"Bd", &P::Bd},
              {"Blat", &P::Blat}, {"Blon", &P::Blon}, {"Za", &P::Za},     {"Zb", &P::Zb},
              {"Zw", &P::Zw},     {"Zr", &P::Zr},     {"Zcol", &P::Zcol}, {"Np", &P::Np},
              {"Nv", &P::Nv},     {"Nw", &P::Nw},     {"Nr", &P::Nr},     {"Nrfb", &P::Nrfb},
              {"Nped", &P::Nped}, {"Ncol", &P::Ncol}, {"Kr", &P::Kr},     {"Krfb", &P::Krfb},
              {"Clon", &P::Clon}, {"Dlat", &P::Dlat}};
  for (const auto& row : rows) {
    table.Read(row.key, p.*row.member, {-1000, 1000, "feet, seconds and radians as in r50.toml"});
  }
  v.model = p;
  return table.Finish(v.marked);
}

Status ReadMultirotor(const toml::table& root, const std::string& file, VehicleDescription& v) {
  MarkedTable table(root, file, "multirotor");
  MultirotorParameters p;
  p.mass_kg = v.mass_kg;
  const NumberLimits inertia{1e-4, 1000, "give kg m2"};
  table.Read("roll_inertia_kgm2", p.inertia_kgm2.x(), inertia);
  table.Read("pitch_inertia_kgm2", p.inertia_kgm2.y(), inertia);
  table.Read("yaw_inertia_kgm2", p.inertia_kgm2.z(), inertia);
  table.Read("arm_m", p.arm_m, {0.05, 10, "give metres from the middle to a rotor"});
  table.Read("torque_per_thrust_m", p.torque_per_thrust_m, {1e-4, 1, "give N m over N"});
  table.Read("motor_lag_s", p.motor_lag_s, {0.005, 1, "give seconds; a step is 0.005 s"});
  const NumberLimits thrust{0, 10000, "give newtons of one rotor"};
  table.Read("min_thrust_n", p.min_thrust_n, thrust);
  table.Read("max_thrust_n", p.max_thrust_n, thrust);
  const NumberLimits drag{0, 1000, "give newtons for each m/s of air"};
  table.Read("forward_drag_ns_per_m", p.drag_ns_per_m.x(), drag);
  table.Read("right_drag_ns_per_m", p.drag_ns_per_m.y(), drag);
  table.Read("down_drag_ns_per_m", p.drag_ns_per_m.z(), drag);
  const NumberLimits gain{0.1, 100, "give 1/s"}, rate{1, 1000, "give degrees a second"};
  table.Read("roll_rate_gain_per_s", p.rate_gain_per_s.x(), gain);
  table.Read("pitch_rate_gain_per_s", p.rate_gain_per_s.y(), gain);
  table.Read("yaw_rate_gain_per_s", p.rate_gain_per_s.z(), gain);
  table.Read("max_roll_rate_deg_s", p.max_rate_rad_s.x(), rate, kRadPerDeg);
  table.Read("max_pitch_rate_deg_s", p.max_rate_rad_s.y(), rate, kRadPerDeg);
  table.Read("max_yaw_rate_deg_s", p.max_rate_rad_s.z(), rate, kRadPerDeg);
  const Status read = table.Finish(v.marked);
  if (!read) {
    return read;
  }
  v.model = p;
  const double weight_n = p.mass_kg * kStandardGravity_mps2;
  if (4 * p.max_thrust_n < kLeastThrustToWeight * weight_n) {
    table.plain().FailKey("max_thrust_n", " = " + NumberText(p.max_thrust_n) +
                                              " is too little: four must lift 1.2 times " +
                                              NumberText(weight_n) + " N");
  } else if (4 * p.min_thrust_n >= weight_n) {
    table.plain().FailKey("min_thrust_n", " = " + NumberText(p.min_thrust_n) +
                                              " is too much: four lift the vehicle, it could "
                                              "never descend");
  }
  return table.plain().Finish();
}

}  // namespace palace
