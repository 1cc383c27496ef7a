#include "engine/world/families/families.h"

#include <algorithm>
#include <array>
#include <string>

#include "engine/core/random.h"
#include "engine/world/families/family.h"

namespace palace {
namespace {

struct Family {
  std::string_view name;
  void (*draw)(World&, RandomStream&);
  std::string_view summary;
};

constexpr std::array kFamilies = {
    Family{"rocks", DrawRocks, "rocks of 8 cm to 1.2 m on bare soil, few of them large"},
    Family{"rough", DrawRough, "rough gravel, 2 to 10 cm rms, with smooth pads"},
    Family{"slopes", DrawSlopes, "pasture of up to 20 degrees, ridges and terraces"},
    Family{"ditches", DrawDitches, "a meadow with holes, ditches, drains and furrows"},
    Family{"kerbs", DrawKerbs, "asphalt with kerbs, low walls, steps and painted lines"},
    Family{"posts", DrawPosts, "thin posts, pegs, stumps, fences and guyed masts"},
    Family{"bushes", DrawBushes, "bushes and shrubs that are seen through"},
    Family{"dunes", DrawDunes, "sand of hardly any texture, dunes with slip faces"},
    Family{"shadows", DrawShadows, "a lawn under hard shadows, some of which move"},
    Family{"water", DrawWater, "pools, mud and wet asphalt"},
    Family{"roof", DrawRoof, "a flat roof with parapet, vents, antennas and slanted parts"},
    Family{"runway-2004", DrawRunway, "a runway with tables and road cones"},
    Family{"obstacles", DrawObstacles, "rectangles, squares, cylinders and wedges of 4 to 24 in"},
    Family{"city", DrawCity, "a street with cars, poles, wires and people"},
    Family{"snow", DrawSnow, "drifted snow with tracks and what sticks out of it"},
    Family{"rmax", DrawRmax, "a dry field seen from 150 ft, with boxes, rocks and a tree line"},
    Family{"nowhere", DrawNowhere, "no safe place at all"},
    Family{"one", DrawOne, "exactly one safe place"},
};

const Family* Find(std::string_view name) {
  const auto found = std::find_if(kFamilies.begin(), kFamilies.end(),
                                  [&](const Family& family) { return family.name == name; });
  return found != kFamilies.end() ? &*found : nullptr;
}

}  // namespace

std::vector<std::string_view> FamilyNames() {
  std::vector<std::string_view> names;
  for (const Family& family : kFamilies) {
    names.push_back(family.name);
  }
  return names;
}

bool IsFamily(std::string_view name) { return Find(name) != nullptr; }

std::string_view FamilySummary(std::string_view name) {
  const Family* family = Find(name);
  return family ? family->summary : std::string_view{};
}

Result<World> MakeFamily(std::string_view name, std::uint64_t seed) {
  const Family* family = Find(name);
  if (!family) {
    std::string known;
    for (const std::string_view each : FamilyNames()) {
      known += (known.empty() ? "" : ", ") + std::string(each);
    }
    return UsageError("there is no family of worlds \"" + std::string(name) + "\"; choose one of " +
                      known);
  }
  RandomStream random(seed, name);
  World world;
  world.name = std::string(name);
  family->draw(world, random);
  return world;
}

}  // namespace palace
