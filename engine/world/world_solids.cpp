#include <utility>
#include <vector>

#include "engine/core/units.h"
#include "engine/world/imported.h"
#include "engine/world/world_tables.h"

namespace palace {
namespace {

constexpr NumberLimits kMeshScale{0.0001, 1000, "metres for each unit of the mesh's file"};
constexpr NumberLimits kSpeed{-20, 20, "metres a second"};

Solid Standing(const Ground& ground, TomlTable& table, Shape shape) {
  for (const char* key : {"turn_deg", "albedo", "moves_mps"}) {
    table.Allow(key);
  }
  const Eigen::Vector2d at = ReadPlace(table, "at");
  const double turn_rad = Rad(table.NumberOr("turn_deg", kTurn, 0));
  Solid solid = StandingOn(ground, std::move(shape), at.x(), at.y(), turn_rad);
  solid.albedo = table.NumberOr("albedo", kShare, 0.5);
  if (table.Has("moves_mps")) {
    const std::vector<double> v = table.Numbers("moves_mps", 2, 2, kSpeed);
    if (v.size() == 2) {
      solid.v_WO = {v[0], v[1], 0};
    }
  }
  return solid;
}

}  // namespace

Status ReadSolids(WorldTables& tables, World& world) {
  std::vector<Solid>& solids = world.solids;
  Status read = tables.Each("box", [&](TomlTable& table) {
    const std::vector<double> size = table.Numbers("size_m", 3, 3, kSize);
    const Box box = size.size() == 3 ? Box{size[0], size[1], size[2]} : Box{};
    solids.push_back(Standing(world.ground, table, box));
  });
  if (!read) {
    return read;
  }
  read = tables.Each("cylinder", [&](TomlTable& table) {
    const Cylinder cylinder{table.Number("diameter_m", kSize), table.Number("height_m", kSize)};
    solids.push_back(Standing(world.ground, table, cylinder));
  });
  if (!read) {
    return read;
  }
  read = tables.Each("cone", [&](TomlTable& table) {
    const Cone cone{table.Number("diameter_m", kSize), table.Number("height_m", kSize)};
    solids.push_back(Standing(world.ground, table, cone));
  });
  if (!read) {
    return read;
  }
  read = tables.Each("mesh", [&](TomlTable& table) {
    for (const char* key : {"scale", "y_up", "open", "turn_deg", "albedo", "moves_mps"}) {
      table.Allow(key);
    }
    const std::string file = table.Text("file");
    const MeshImport import{.scale = table.NumberOr("scale", kMeshScale, 1),
                            .y_up = table.BoolOr("y_up", false),
                            .may_be_open = table.BoolOr("open", false)};
    if (file.empty()) {
      return;
    }
    Result<Shape> mesh = ImportMesh(tables.folder() / file, import);
    if (!mesh) {
      table.FailKey("file", ": " + mesh.error().message);
      return;
    }
    solids.push_back(Standing(world.ground, table, std::move(*mesh)));
  });
  if (!read) {
    return read;
  }
  return tables.Each("rod", [&](TomlTable& table) {
    table.Allow("albedo");
    Eigen::Vector3d ends[2];
    for (int i = 0; i < 2; ++i) {
      const std::vector<double> p = table.Numbers(i == 0 ? "from" : "to", 3, 3, kPlace);
      if (p.size() == 3) {
        ends[i] = {p[0], p[1], -(world.ground.Height(p[0], p[1]) + p[2])};
      }
    }
    const double diameter_m = table.Number("diameter_m", kSize);
    const double albedo = table.NumberOr("albedo", kShare, 0.3);
    if ((ends[1] - ends[0]).norm() < 0.01) {
      table.FailKey("to", " is the place of `from`; a rod has a length");
      return;
    }
    solids.push_back(MakeRod(ends[0], ends[1], diameter_m));
    solids.back().albedo = albedo;
  });
}

}  // namespace palace
