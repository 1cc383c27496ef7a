// Reading tables of a vehicle file: plain numbers, rates on the simulator's grid, marked numbers,
// and the two flight models. Included by .cpp files only: it brings toml++.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/core/toml_table.h"
#include "engine/simulation/vehicle_description.h"

namespace palace {

/// One number of a table: read, checked, and times `si` put where it belongs.
struct NumberRow {
  const char* key;
  double* into;
  NumberLimits limits;
  double si = 1;
};
void ReadNumbers(TomlTable& table, const std::vector<NumberRow>& rows);

/// A rate that divides the simulator's 200 steps a second.
double ReadRate(TomlTable& table, const char* key);

/// A table whose numbers carry marks, `key = { value = 1, mark = "chosen" }`, beside plain keys.
class MarkedTable {
 public:
  MarkedTable(const toml::table& root, const std::string& file, const std::string& name);

  /// Reads the number; `into` gets value times `si` and is left alone after an error.
  void Read(const char* key, double& into, const NumberLimits& limits, double si = 1);
  TomlTable& plain() { return plain_; }
  /// The first error, or appends what was read to `marked`.
  Status Finish(std::vector<MarkedValue>& marked);

 private:
  std::string file_;
  std::string name_;
  TomlTable plain_;
  const toml::table* table_;
  std::vector<MarkedValue> marked_;
  std::optional<Error> error_;
};

/// [derivatives], in the units of the identification.
Status ReadDerivatives(const toml::table& root, const std::string& file, VehicleDescription& v);
/// [multirotor]; it must be able to lift v.mass_kg.
Status ReadMultirotor(const toml::table& root, const std::string& file, VehicleDescription& v);

}  // namespace palace
