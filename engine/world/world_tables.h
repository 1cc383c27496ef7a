// The tables of a world file while it is read, and the parts that read them (world_file.h).
// Included by .cpp files only: it brings toml++.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>

#include "engine/core/toml_table.h"
#include "engine/world/world.h"

namespace palace {

inline constexpr NumberLimits kPlace{-200, 200, "metres from where the vehicle starts"};
inline constexpr NumberLimits kSize{0.01, 100, "metres"};
inline constexpr NumberLimits kShare{0, 1, "a share: 0 black, 1 white"};
inline constexpr NumberLimits kTurn{-360, 360, "degrees, north towards east"};
inline constexpr NumberLimits kSeed{0, 1e9, "a whole number", true};

/// "at = [north, east]" and its like; zero after an error.
Eigen::Vector2d ReadPlace(TomlTable& table, const char* key);

class WorldTables {
 public:
  /// `name` stands for the file in messages; files that it names lie in `folder`. The root must
  /// outlive this.
  WorldTables(const toml::table& root, std::string name, std::filesystem::path folder)
      : root_(root), name_(std::move(name)), folder_(std::move(folder)) {}

  const toml::table& root() const { return root_; }
  const std::string& name() const { return name_; }
  const std::filesystem::path& folder() const { return folder_; }
  /// [name]; TomlTable::present tells whether there is one.
  TomlTable Table(const char* name) const { return {root_, name_, name}; }

  /// Every [[name]] in turn.
  template <typename One>
  Status Each(const char* name, One&& one) {
    const toml::node* node = root_.get(name);
    if (node == nullptr) {
      return Ok();
    }
    const toml::array* list = node->as_array();
    if (list == nullptr || !list->is_array_of_tables()) {
      return InvalidError(name_ + ":" + std::to_string(node->source().begin.line) + ": write [[" +
                          name + "]] before each");
    }
    for (const toml::node& element : *list) {
      TomlTable table = TomlTable::OfList(*element.as_table(), name_, name);
      if (++things_ > kMostThings) {
        table.Fail(static_cast<int>(element.source().begin.line),
                   "more than " + std::to_string(kMostThings) + " things in a world");
      }
      one(table);
      if (const Status finished = table.Finish(); !finished) {
        return finished;
      }
    }
    return Ok();
  }

 private:
  static constexpr std::size_t kMostThings = 2000;

  const toml::table& root_;
  std::string name_;
  std::filesystem::path folder_;
  std::size_t things_ = 0;
};

/// [relief], and [[hole]] [[ditch]] [[mound]] on it.
Status ReadRelief(WorldTables& tables, World& world);
/// [[box]] [[cylinder]] [[cone]] [[mesh]] [[rod]], stood on the world's ground.
Status ReadSolids(WorldTables& tables, World& world);

}  // namespace palace
