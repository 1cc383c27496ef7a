// Maps and sites as PNG pictures a person reads: colours, a bar with figures, the landing cross.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "engine/core/result.h"
#include "engine/model/hazard_maps.h"
#include "engine/model/landing_site.h"
#include "engine/model/range_map.h"
#include "engine/model/settings/settings.h"

namespace palace {

enum class ColourTable { kViridis, kCividis, kMagma, kInferno, kBlues };

struct MapPicture {
  std::string title;  ///< with the unit of the bar: "slope, deg"
  ColourTable table = ColourTable::kViridis;
  double shown_per_unit = 1;
  std::optional<double> low;  ///< of the bar, shown units; from the data when absent
  std::optional<double> high;
};

/// Unknown cells are grey. The bar at the right runs from low to high; an end beyond
/// which cells lie says so ("<= -0.5", ">= 1.5").
Status WriteMapPicture(const std::filesystem::path& path, const GridF& cells,
                       const MapPicture& picture);

/// The ground in relief, lit from the north-west, under the verdict: blue where a site may lie
/// (CanBearLander), grey where not, hazard orange, unknown dark; the sites with their clear radius,
/// the best with a cross.
Status WriteSafeLandingPicture(const std::filesystem::path& path, const ElevationMap& map,
                               const HazardMaps& hazards, const SiteSelection& selection);

/// The left picture of a range map that has a pose, with the cross at the best site, the rings of
/// the clear radii on the ground, and the verdict (VerdictImage, any size): blue rim round what is
/// safe, orange hatch elsewhere.
Status WriteOverlay(const std::filesystem::path& path, const ImageU8& left,
                    const SiteSelection& selection, const RangeMap& range, const ImageU8& verdict);

/// A picture file as text for a page that holds its pictures: JPEG, at most 1400 pixels a side.
/// Empty where the file cannot be read.
std::string PictureAsDataUri(const std::filesystem::path& path);

}  // namespace palace
