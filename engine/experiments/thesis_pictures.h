// The pictures of the thesis's chapter 4 (Hintze 2004, Figures 4.2 to 4.9), drawn of worlds like
// its own: an obstacle field with primitives, and tables and cones on a runway, from 50 ft with its
// rig (640 x 480, 45 degrees of view, 45 degrees down, 1 m between the cameras).
//
//   World -> ten drawn pairs -> stereo -> Slad, thesis mode -> maps, site, overlay
//
// Maps are north up; nothing is measured here, the experiments do that.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/result.h"

namespace palace {

struct ThesisPicture {
  std::string figure;  ///< of the thesis: "4.6"
  std::string file;    ///< beside the page
  std::string caption;
};

/// Writes all into `folder`, which is there. Same seed, same pictures. Errors name the file.
Result<std::vector<ThesisPicture>> WriteThesisPictures(const std::filesystem::path& folder,
                                                       std::uint64_t seed);

}  // namespace palace
