// Families of worlds: ground as nature and people leave it, drawn widely from a seed.
//
// A family is a kind of ground (rocks, ditches, a street), not a test picture: sizes, numbers,
// places, materials and sun of each world are drawn from the seed. The vehicle starts over the
// origin of W, heading north, with its camera tilted down, so what matters lies 2 to 45 m north and
// up to 20 m to both sides (`rmax` farther: it is seen from 150 ft). Relief goes on mirrored beyond
// its square; solids end there. What is safe is in no description: ground_truth.h measures it.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/world/world.h"

namespace palace {

/// In the order of the gallery.
std::vector<std::string_view> FamilyNames();
bool IsFamily(std::string_view name);
/// One sentence for a list: what it is made of.
std::string_view FamilySummary(std::string_view name);

/// The same name and seed give the same world to the bit. An unknown name is a usage error that
/// lists the names.
Result<World> MakeFamily(std::string_view name, std::uint64_t seed);

}  // namespace palace
