#include "engine/world/world_file.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "engine/camera/files/text_file.h"
#include "engine/camera/files/toml_table.h"
#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/world/imported.h"
#include "engine/world/lattice_noise.h"
#include "engine/world/scene_library.h"
#include "engine/world/sun_position.h"

namespace palace {
namespace {

using Eigen::Vector2d;

constexpr std::size_t kMostThings = 2000;
constexpr std::size_t kLargestFile = 1 << 20;
constexpr NumberLimits kPlace{-200, 200, "metres from where the vehicle starts"};
constexpr NumberLimits kHeight{-5, 60, "metres above the ground"};
constexpr NumberLimits kSize{0.01, 100, "metres"};
constexpr NumberLimits kDepth{0.01, 5, "metres below the ground"};
constexpr NumberLimits kShare{0, 1, "a share: 0 black, 1 white"};
constexpr NumberLimits kContrast{0, 3, "0: none, 1: as the material comes"};
constexpr NumberLimits kScale{0.1, 10, "1: as the material comes"};
constexpr NumberLimits kTurn{-360, 360, "degrees, north towards east"};
constexpr NumberLimits kRise{-30, 30, "degrees of slope"};
constexpr NumberLimits kRough{0, 0.5, "metres, standard deviation"};
constexpr NumberLimits kWave{0.2, 64, "metres of wavelength"};
constexpr NumberLimits kHurst{0.2, 1.5, "0.5 rugged .. 1 smooth"};
constexpr NumberLimits kSquare{16, 128, "metres a side; it goes on mirrored"};
constexpr NumberLimits kSeed{0, 1e9, "a whole number", true};
constexpr NumberLimits kAzimuth{0, 360, "degrees from north, eastwards"};
constexpr NumberLimits kElevation{-10, 90, "degrees above the horizon"};
constexpr NumberLimits kLatitude{-90, 90, "degrees, north positive"};
constexpr NumberLimits kLongitude{-180, 180, "degrees, east positive"};
constexpr NumberLimits kMeshScale{0.0001, 1000, "metres for each unit of the mesh's file"};
constexpr NumberLimits kSpeed{-20, 20, "metres a second"};

/// A cut or rise of the ground: metres up at a place.
struct Form {
  std::function<double(double north_m, double east_m)> height;
};

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

Vector2d ReadPlace(TomlTable& table, const char* key) {
  const std::vector<double> place = table.Numbers(key, 2, 2, kPlace);
  return place.size() == 2 ? Vector2d(place[0], place[1]) : Vector2d::Zero();
}

class WorldReader {
 public:
  WorldReader(const toml::table& root, std::string name, std::filesystem::path folder)
      : root_(root), name_(std::move(name)), folder_(std::move(folder)) {}

  Result<World> Read() {
    const std::set<std::string> known = {"name",  "ground",   "relief", "sun",   "hole",
                                         "ditch", "mound",    "line",   "patch", "pool",
                                         "box",   "cylinder", "cone",   "rod",   "mesh"};
    for (const auto& [key, node] : root_) {
      if (!known.count(std::string(key.str()))) {
        return InvalidError(name_ + ":" + std::to_string(node.source().begin.line) +
                            ": unknown \"" + std::string(key.str()) + "\"; a world file knows " +
                            Joined({known.begin(), known.end()}));
      }
    }
    if (const toml::node* title = root_.get("name")) {
      const auto text = title->value_exact<std::string>();
      if (!text) {
        return InvalidError(name_ + ":" + std::to_string(title->source().begin.line) +
                            ": name must be a text in quotes");
      }
      world_.name = *text;
    }
    for (const auto& step :
         {&WorldReader::ReadGround, &WorldReader::ReadSun, &WorldReader::ReadForms,
          &WorldReader::ReadRelief, &WorldReader::ReadPatches, &WorldReader::ReadSolids}) {
      if (const Status read = (this->*step)(); !read) {
        return read.error();
      }
    }
    return std::move(world_);
  }

 private:
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

  Status ReadGround() {
    TomlTable table(root_, name_, "ground");
    world_.ground.material = ReadMaterial(table, {});
    world_.ground.texture_seed = world_.ground.material->seed;
    for (const char* key : {"rise_north_deg", "rise_east_deg"}) {
      table.Allow(key);
    }
    world_.ground.rise_north = std::tan(Rad(table.NumberOr("rise_north_deg", kRise, 0)));
    world_.ground.rise_east = std::tan(Rad(table.NumberOr("rise_east_deg", kRise, 0)));
    return table.Finish();
  }

  Status ReadSun() {
    TomlTable table(root_, name_, "sun");
    if (table.Has("utc")) {
      ReadSunByDate(table);
    } else if (table.present()) {
      for (const char* key : {"utc", "latitude_deg", "longitude_deg"}) {
        table.Allow(key);
      }
      world_.sun.azimuth_rad = Rad(table.Number("azimuth_deg", kAzimuth));
      world_.sun.elevation_rad = Rad(table.Number("elevation_deg", kElevation));
    }
    return table.Finish();
  }

  void ReadSunByDate(TomlTable& table) {
    for (const char* key : {"azimuth_deg", "elevation_deg"}) {
      table.Allow(key);
      if (table.Has(key)) {
        table.FailKey(key, " contradicts sun.utc; give one of them");
      }
    }
    const std::string text = table.Text("utc");
    const std::optional<UtcMoment> utc = ParseUtc(text);
    if (!utc) {
      table.FailKey(
          "utc", " = \"" + text + "\"; write a moment of 1901 to 2099 as \"2004-06-21 19:09:00\"");
      return;
    }
    const double latitude_rad = Rad(table.Number("latitude_deg", kLatitude));
    const double longitude_rad = Rad(table.Number("longitude_deg", kLongitude));
    const SunPosition sun = SunPositionAt(*utc, latitude_rad, longitude_rad);
    if (const double down_deg = -Deg(sun.elevation_rad); down_deg > -kElevation.least) {
      table.FailKey("utc", " = \"" + text + "\": the sun stands " + WithNumbers("%.1f", down_deg) +
                               " degrees below the horizon there, the limit is " +
                               NumberText(-kElevation.least));
      return;
    }
    world_.sun.azimuth_rad = sun.azimuth_rad;
    world_.sun.elevation_rad = sun.elevation_rad;
  }

  Status ReadForms() {
    Status read = Each("hole", [&](TomlTable& table) {
      const Vector2d at = ReadPlace(table, "at");
      const double radius_m = table.Number("diameter_m", kSize) / 2;
      const double depth_m = table.Number("depth_m", kDepth);
      forms_.push_back({[=](double n, double e) {
        return std::hypot(n - at.x(), e - at.y()) <= radius_m ? -depth_m : 0.0;
      }});
    });
    if (!read) {
      return read;
    }
    read = Each("ditch", [&](TomlTable& table) {
      const Vector2d from = ReadPlace(table, "from"), to = ReadPlace(table, "to");
      const double half_m = table.Number("width_m", kSize) / 2;
      const double depth_m = table.Number("depth_m", kDepth);
      forms_.push_back({[=](double n, double e) {
        const Vector2d along = to - from, off = Vector2d(n, e) - from;
        const double s = std::clamp(off.dot(along) / std::max(along.squaredNorm(), 1e-9), 0.0, 1.0);
        return (off - s * along).norm() <= half_m ? -depth_m : 0.0;
      }});
    });
    if (!read) {
      return read;
    }
    return Each("mound", [&](TomlTable& table) {
      const Vector2d at = ReadPlace(table, "at");
      const double radius_m = table.Number("diameter_m", kSize) / 2;
      const double height_m = table.Number("height_m", kDepth);
      forms_.push_back({[=](double n, double e) {
        const double share = std::hypot(n - at.x(), e - at.y()) / radius_m;
        return share < 1 ? height_m * 0.5 * (1 + std::cos(std::numbers::pi * share)) : 0.0;
      }});
    });
  }

  /// Most of it ahead of the vehicle, where its cameras look.
  static HeightField::Place SquareAhead(double size_m) {
    return {-size_m / 4, -size_m / 2, size_m, 10};
  }

  void ReadHeights(TomlTable& table, const HeightField::Place& square) {
    const std::string file = table.Text("file");
    const Vector2d middle(square.north_m + square.size_m / 2, square.east_m + square.size_m / 2);
    const Vector2d at = table.Has("at") ? ReadPlace(table, "at") : middle;
    Result<HeightFunction> heights = ImportHeights(folder_ / file, at, square);
    if (!heights) {
      table.FailKey("file", ": " + heights.error().message);
      return;
    }
    forms_.push_back({std::move(*heights)});
  }

  Status ReadRelief() {
    TomlTable table(root_, name_, "relief");
    double rms_m = 0, longest_m = 8, shortest_m = 0.5, hurst = 0.8, size_m = 64;
    std::uint64_t seed = 1;
    if (table.present()) {
      for (const char* key : {"longest_m", "shortest_m", "hurst", "seed", "size_m", "file", "at"}) {
        table.Allow(key);
      }
      const bool from_file = table.Has("file");
      rms_m = from_file ? table.NumberOr("rms_m", kRough, 0) : table.Number("rms_m", kRough);
      longest_m = table.NumberOr("longest_m", kWave, longest_m);
      shortest_m = table.NumberOr("shortest_m", kWave, shortest_m);
      hurst = table.NumberOr("hurst", kHurst, hurst);
      size_m = table.NumberOr("size_m", kSquare, size_m);
      seed = static_cast<std::uint64_t>(table.NumberOr("seed", kSeed, 1));
      if (from_file) {
        ReadHeights(table, SquareAhead(size_m));
      } else if (table.Has("at")) {
        table.FailKey("at", " is where the middle of relief.file lies; there is no file");
      }
      if (shortest_m > longest_m) {
        table.FailKey("shortest_m", " = " + NumberText(shortest_m) +
                                        " is longer than longest_m = " + NumberText(longest_m));
      }
    }
    if (const Status finished = table.Finish(); !finished) {
      return finished;
    }
    if (rms_m > 0 || !forms_.empty()) {
      world_.ground.relief =
          std::make_shared<const HeightField>(SquareAhead(size_m), [&](double n, double e) {
            double height_m = rms_m * FractalNoise(n, e, seed, longest_m, shortest_m, hurst);
            for (const Form& form : forms_) {
              height_m += form.height(n, e);
            }
            return height_m;
          });
    }
    return Ok();
  }

  Status ReadPatches() {
    std::vector<GroundPatch>& patches = world_.ground.patches;
    Status read = Each("patch", [&](TomlTable& table) {
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
    read = Each("pool", [&](TomlTable& table) {
      const Vector2d at = ReadPlace(table, "at");
      const double radius_m = table.Number("diameter_m", kSize) / 2;
      patches.push_back(DiscPatch(at.x(), at.y(), radius_m, {GroundTexture::kWater}));
    });
    if (!read) {
      return read;
    }
    return Each("line", [&](TomlTable& table) {
      const Vector2d from = ReadPlace(table, "from"), to = ReadPlace(table, "to");
      if ((to - from).norm() < 0.01) {
        table.FailKey("to", " is the place of `from`; a line has a length");
      }
      const double width_m = table.Number("width_m", kSize);
      patches.push_back(
          StripPatch(from, to, width_m, ReadMaterial(table, {GroundTexture::kPaint})));
    });
  }

  Solid Standing(TomlTable& table, Shape shape) {
    for (const char* key : {"turn_deg", "albedo", "moves_mps"}) {
      table.Allow(key);
    }
    const Vector2d at = ReadPlace(table, "at");
    const double turn_rad = Rad(table.NumberOr("turn_deg", kTurn, 0));
    Solid solid = StandingOn(world_.ground, std::move(shape), at.x(), at.y(), turn_rad);
    solid.albedo = table.NumberOr("albedo", kShare, 0.5);
    if (table.Has("moves_mps")) {
      const std::vector<double> v = table.Numbers("moves_mps", 2, 2, kSpeed);
      if (v.size() == 2) {
        solid.v_WO = {v[0], v[1], 0};
      }
    }
    return solid;
  }

  Status ReadSolids() {
    std::vector<Solid>& solids = world_.solids;
    Status read = Each("box", [&](TomlTable& table) {
      const std::vector<double> size = table.Numbers("size_m", 3, 3, kSize);
      const Box box = size.size() == 3 ? Box{size[0], size[1], size[2]} : Box{};
      solids.push_back(Standing(table, box));
    });
    if (!read) {
      return read;
    }
    read = Each("cylinder", [&](TomlTable& table) {
      const Cylinder cylinder{table.Number("diameter_m", kSize), table.Number("height_m", kSize)};
      solids.push_back(Standing(table, cylinder));
    });
    if (!read) {
      return read;
    }
    read = Each("cone", [&](TomlTable& table) {
      const Cone cone{table.Number("diameter_m", kSize), table.Number("height_m", kSize)};
      solids.push_back(Standing(table, cone));
    });
    if (!read) {
      return read;
    }
    read = Each("mesh", [&](TomlTable& table) {
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
      Result<Shape> mesh = ImportMesh(folder_ / file, import);
      if (!mesh) {
        table.FailKey("file", ": " + mesh.error().message);
        return;
      }
      solids.push_back(Standing(table, std::move(*mesh)));
    });
    if (!read) {
      return read;
    }
    return Each("rod", [&](TomlTable& table) {
      table.Allow("albedo");
      Eigen::Vector3d ends[2];
      for (int i = 0; i < 2; ++i) {
        const std::vector<double> p = table.Numbers(i == 0 ? "from" : "to", 3, 3, kPlace);
        if (p.size() == 3) {
          ends[i] = {p[0], p[1], -(world_.ground.Height(p[0], p[1]) + p[2])};
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

  const toml::table& root_;
  std::string name_;
  std::filesystem::path folder_;
  World world_;
  std::vector<Form> forms_;
  std::size_t things_ = 0;
};

}  // namespace

Result<World> ParseWorld(const std::string& text, const std::string& name,
                         const std::filesystem::path& folder) {
  const Result<toml::table> root = ParseToml(text, name);
  if (!root) {
    return root.error();
  }
  return WorldReader(*root, name, folder).Read();
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
