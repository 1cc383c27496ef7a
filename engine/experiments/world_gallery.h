// The gallery of the families: what the left camera sees of a world, and its truth from above, to
// be looked at by a person.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/core/result.h"

namespace palace {

struct WorldGallery {
  std::filesystem::path folder;
  std::vector<std::string> families;  ///< of FamilyNames()
  std::uint64_t seed = 1;
  double clear_radius_m = 2.3;  ///< of the discs that the truth map calls safe
  std::vector<double> heights_m = {8, 15, 30};
};

/// Writes FAMILY_SEED_08m.png and its like, FAMILY_SEED_truth.png and gallery.html. Lens, tilt,
/// blur, noise and exposure are those of DrawViewPlan; `rmax` is seen from its own height too.
/// `progress` hears each family's name before its pictures are drawn. Errors name the file.
Status WriteWorldGallery(const WorldGallery& gallery,
                         const std::function<void(const std::string&)>& progress);

}  // namespace palace
