#include "engine/world/world_file.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "engine/core/files.h"
#include "engine/core/plain_text.h"
#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/world/scene_library.h"
#include "engine/world/sun_position.h"
#include "engine/world/world_tables.h"

namespace palace {
namespace {

using Eigen::Vector2d;

constexpr std::size_t kLargestFile = 1 << 20;
constexpr NumberLimits kContrast{0, 3, "0: none, 1: as the material comes"};
constexpr NumberLimits kScale{0.1, 10, "1: as the material comes"};
constexpr NumberLimits kRise{-30, 30, "degrees of slope"};
constexpr NumberLimits kAzimuth{0, 360, "degrees from north, eastwards"};
constexpr NumberLimits kElevation{-10, 90, "degrees above the horizon"};
constexpr NumberLimits kLatitude{-90, 90, "degrees, north positive"};
constexpr NumberLimits kLongitude{-180, 180, "degrees, east positive"};

std::string MaterialNames() {
  std::string names;
  for (int i = 0; i < kGroundTextures; ++i) {
    names += (i > 0 ? ", " : "") + std::string(NameOf(static_cast<GroundTexture>(i)));
  }
  return names;
}

Material ReadMaterial(TomlTable& table, const Material& otherwise) {
  for (const char* key : {"material", "seed", "albedo", "contrast", "scale", "turn_deg"}) {
    table.Allow(key);
  }
  Material material = otherwise;
  if (table.Has("material")) {
    const std::string name = table.Text("material");
    int found = -1;
    for (int i = 0; i < kGroundTextures; ++i) {
      found = NameOf(static_cast<GroundTexture>(i)) == name ? i : found;
    }
    if (found < 0) {
      table.FailKey("material", " = \"" + name + "\"; choose one of " + MaterialNames());
    } else {
      material.texture = static_cast<GroundTexture>(found);
    }
  }
  material.seed = static_cast<std::uint64_t>(
      table.NumberOr("seed", kSeed, static_cast<double>(otherwise.seed)));
  material.albedo = table.NumberOr("albedo", kShare, NAN);
  material.contrast = table.NumberOr("contrast", kContrast, 1);
  material.scale = table.NumberOr("scale", kScale, 1);
  material.turn_rad = Rad(table.NumberOr("turn_deg", kTurn, 0));
  return material;
}

Status ReadGround(WorldTables& tables, World& world) {
  TomlTable table = tables.Table("ground");
  world.ground.material = ReadMaterial(table, {});
  world.ground.texture_seed = world.ground.material->seed;
  for (const char* key : {"rise_north_deg", "rise_east_deg"}) {
    table.Allow(key);
  }
  world.ground.rise_north = std::tan(Rad(table.NumberOr("rise_north_deg", kRise, 0)));
  world.ground.rise_east = std::tan(Rad(table.NumberOr("rise_east_deg", kRise, 0)));
  return table.Finish();
}

void ReadSunByDate(TomlTable& table, World& world) {
  for (const char* key : {"azimuth_deg", "elevation_deg"}) {
    table.Allow(key);
    if (table.Has(key)) {
      table.FailKey(key, " contradicts sun.utc; give one of them");
    }
  }
  const std::string text = table.Text("utc");
  const std::optional<UtcMoment> utc = ParseUtc(text);
  if (!utc) {
    table.FailKey("utc",
                  " = \"" + text + "\"; write a moment of 1901 to 2099 as \"2004-06-21 19:09:00\"");
    return;
  }
  const double latitude_rad = Rad(table.Number("latitude_deg", kLatitude));
  const double longitude_rad = Rad(table.Number("longitude_deg", kLongitude));
  const SunDirection sun = SunAt(*utc, latitude_rad, longitude_rad);
  if (const double down_deg = -Deg(sun.elevation_rad); down_deg > -kElevation.least) {
    table.FailKey("utc", " = \"" + text + "\": the sun stands " + WithNumbers("%.1f", down_deg) +
                             " degrees below the horizon there, the limit is " +
                             NumberText(-kElevation.least));
    return;
  }
  world.sun.azimuth_rad = sun.azimuth_rad;
  world.sun.elevation_rad = sun.elevation_rad;
}

Status ReadSun(WorldTables& tables, World& world) {
  TomlTable table = tables.Table("sun");
  if (table.Has("utc")) {
    ReadSunByDate(table, world);
  } else if (table.present()) {
    for (const char* key : {"utc", "latitude_deg", "longitude_deg"}) {
      table.Allow(key);
    }
    world.sun.azimuth_rad = Rad(table.Number("azimuth_deg", kAzimuth));
    world.sun.elevation_rad = Rad(table.Number("elevation_deg", kElevation));
  }
  return table.Finish();
}

Status ReadPatches(WorldTables& tables, World& world) {
  std::vector<GroundPatch>& patches = world.ground.patches;
  Status read = tables.Each("patch", [&](TomlTable& table) {
    const std::vector<double> outline = table.Numbers("outline", 6, 128, kPlace);
    if (outline.size() % 2 != 0) {
      table.FailKey("outline", " has an odd count of numbers; write north, east of each corner");
    }
    GroundPatch patch{{}, ReadMaterial(table, {})};
    for (std::size_t i = 0; i + 1 < outline.size(); i += 2) {
      patch.outline_m.emplace_back(outline[i], outline[i + 1]);
    }
    patches.push_back(std::move(patch));
  });
  if (!read) {
    return read;
  }
  read = tables.Each("pool", [&](TomlTable& table) {
    const Vector2d at = ReadPlace(table, "at");
    const double radius_m = table.Number("diameter_m", kSize) / 2;
    patches.push_back(DiscPatch(at.x(), at.y(), radius_m, {GroundTexture::kWater}));
  });
  if (!read) {
    return read;
  }
  return tables.Each("line", [&](TomlTable& table) {
    const Vector2d from = ReadPlace(table, "from"), to = ReadPlace(table, "to");
    if ((to - from).norm() < 0.01) {
      table.FailKey("to", " is the place of `from`; a line has a length");
    }
    const double width_m = table.Number("width_m", kSize);
    patches.push_back(StripPatch(from, to, width_m, ReadMaterial(table, {GroundTexture::kPaint})));
  });
}

Result<World> ReadWorld(WorldTables& tables) {
  const std::string& name = tables.name();
  const std::set<std::string> known = {"name",  "ground",   "relief", "sun",   "hole",
                                       "ditch", "mound",    "line",   "patch", "pool",
                                       "box",   "cylinder", "cone",   "rod",   "mesh"};
  for (const auto& [key, node] : tables.root()) {
    if (!known.count(std::string(key.str()))) {
      return InvalidError(name + ":" + std::to_string(node.source().begin.line) + ": unknown \"" +
                          Printable(key.str()) + "\"; a world file knows " +
                          Joined({known.begin(), known.end()}));
    }
  }
  World world;
  if (const toml::node* title = tables.root().get("name")) {
    const auto text = title->value_exact<std::string>();
    if (!text) {
      return InvalidError(name + ":" + std::to_string(title->source().begin.line) +
                          ": name must be a text in quotes");
    }
    world.name = *text;
  }
  for (const auto read : {ReadGround, ReadSun, ReadRelief, ReadPatches, ReadSolids}) {
    if (const Status good = read(tables, world); !good) {
      return good.error();
    }
  }
  return world;
}

}  // namespace

Result<World> ParseWorld(const std::string& text, const std::string& name,
                         const std::filesystem::path& folder) {
  const Result<toml::table> root = ParseToml(text, name);
  if (!root) {
    return root.error();
  }
  WorldTables tables(*root, name, folder);
  return ReadWorld(tables);
}

Result<World> LoadWorld(const std::filesystem::path& path) {
  Result<std::string> text = ReadTextFile(path, kLargestFile);
  if (!text) {
    return text.error();
  }
  Result<World> world = ParseWorld(*text, path.string(), path.parent_path());
  if (world && world->name.empty()) {
    world->name = path.stem().string();
  }
  return world;
}

Result<World> OpenWorld(const std::string& name_or_path, std::uint64_t seed) {
  const bool file = name_or_path.ends_with(".toml");
  return file ? LoadWorld(name_or_path) : MakeScene(name_or_path, seed);
}

}  // namespace palace
