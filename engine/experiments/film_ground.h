// The ground that films of the experiments on trackers are flown over: a material of our worlds by
// trial and seed, or a photograph of ground from straight above.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/experiments/ground_pyramid.h"
#include "engine/experiments/point_film.h"
#include "engine/world/ground_texture.h"

namespace CLI {
class App;
}

namespace palace {

/// Height in which a descent over a photograph ends.
inline constexpr double kPhotographEnd_m = 11;
/// "from 45.7 m to 4 m (over photographs to 11 m)": heights of the descents.
std::string DescentText();

struct FilmGroundOptions {
  std::vector<std::string> materials = {"grass", "gravel", "asphalt", "soil", "concrete"};
  std::vector<std::string> photographs{};  ///< files; then no material is flown over
  double photograph_cm = 2;                ///< a pixel of theirs on the ground
  FilmOptions film{};
  GroundPyramid::Extent extent{};
};

/// --materials, --photograph, --photograph-cm, --pictures, of which there must be so many.
void AddFilmGroundOptions(CLI::App& app, FilmGroundOptions& options, int fewest_pictures);
/// All that changes a result.
std::string SetupOf(const FilmGroundOptions& options);

struct FilmGround {
  std::string name;  ///< of the material, or the file's
  GroundPyramid ground;
  FilmOptions film;
};
/// Trial i takes the i-th material or photograph, round and round; its pattern, or the place of the
/// photograph in whose middle the flight ends, comes from the seed. Photographs are mirrored beyond
/// their edges, and a descent over them ends at kPhotographEnd_m: nearer their own pixels show.
/// kUsage: no such material; else what reading the photograph says.
Result<FilmGround> GroundOfTrial(const FilmGroundOptions& options, int trial, std::uint64_t seed);

}  // namespace palace
