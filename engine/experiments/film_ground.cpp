#include "engine/experiments/film_ground.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include <CLI/CLI.hpp>

#include "engine/capture/picture_file.h"
#include "engine/core/command_line.h"
#include "engine/core/random.h"
#include "engine/core/text.h"
#include "engine/report/trial_table.h"

namespace palace {
namespace {

std::optional<GroundTexture> TextureOf(const std::string& name) {
  for (int i = 0; i < kGroundTextures; ++i) {
    if (name == NameOf(static_cast<GroundTexture>(i))) {
      return static_cast<GroundTexture>(i);
    }
  }
  return std::nullopt;
}

std::string AllTextures() {
  std::vector<std::string> names;
  for (int i = 0; i < kGroundTextures; ++i) {
    names.emplace_back(NameOf(static_cast<GroundTexture>(i)));
  }
  return Joined(names);
}

/// Index into `count` pixels that go on mirrored.
int Mirrored(int i, int count) {
  const int period = 2 * count;
  const int at = ((i % period) + period) % period;
  return at < count ? at : period - 1 - at;
}

double GreyOf(const ImageU8& picture, double x, double y) {
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  const double a = x - x0, b = y - y0;
  const auto at = [&](int i, int j) {
    return double(picture.at(Mirrored(i, picture.width()), Mirrored(j, picture.height())));
  };
  return (1 - b) * ((1 - a) * at(x0, y0) + a * at(x0 + 1, y0)) +
         b * ((1 - a) * at(x0, y0 + 1) + a * at(x0 + 1, y0 + 1));
}

template <typename T>
const T& RoundAndRound(const std::vector<T>& values, int trial) {
  return values[static_cast<std::size_t>(trial) % values.size()];
}

}  // namespace

std::string DescentText() {
  const FilmOptions film;
  return WithNumbers("from %.1f m to %.0f m (over photographs to %.0f m)", film.start_m, film.end_m,
                     kPhotographEnd_m);
}

void AddFilmGroundOptions(CLI::App& app, FilmGroundOptions& options, int fewest_pictures) {
  app.add_option("--materials", options.materials,
                 "Ground of trial 0, 1, ..., round and round: " + AllTextures())
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--photograph", options.photographs,
                 "Pictures of real ground from straight above, flown over instead of materials")
      ->delimiter(',')
      ->check(CLI::ExistingFile);
  app.add_option("--photograph-cm", options.photograph_cm, "A pixel of theirs on the ground, cm")
      ->check(FiniteRange(0.1, 20.0))
      ->capture_default_str();
  app.add_option("--pictures", options.film.pictures, "Pictures of a film, 30 a second")
      ->check(FiniteRange(fewest_pictures, 10'000))
      ->capture_default_str();
}

std::string SetupOf(const FilmGroundOptions& options) {
  std::vector<std::string> names;
  for (const std::string& file : options.photographs) {
    names.push_back(std::filesystem::path(file).filename().string());
  }
  const bool photographs = !names.empty();
  return CsvText((photographs ? "photographs " : "materials ") +
                 Joined(photographs ? names : options.materials) +
                 (photographs ? WithNumbers(" of %.10g cm a pixel", options.photograph_cm) : "")) +
         WithNumbers("; %.0f pictures", options.film.pictures);
}

Result<FilmGround> GroundOfTrial(const FilmGroundOptions& options, int trial, std::uint64_t seed) {
  FilmOptions film = options.film;
  if (!options.photographs.empty()) {
    const std::filesystem::path file = RoundAndRound(options.photographs, trial);
    const Result<ImageU8> picture = ReadGreyPicture(file);
    if (!picture) {
      return picture.error();
    }
    film.end_m = kPhotographEnd_m;
    RandomStream random(seed, "place");
    const double x0 = picture->width() * random.Uniform(0.25, 0.75);
    const double y0 = picture->height() * random.Uniform(0.25, 0.75);
    const double per_m = 100 / options.photograph_cm;
    return FilmGround{CsvText(file.filename().string()),
                      GroundPyramid(
                          [&](double north_m, double east_m) {
                            return GreyOf(*picture, x0 + per_m * east_m, y0 - per_m * north_m);
                          },
                          options.extent),
                      film};
  }
  if (options.materials.empty()) {
    return UsageError("--materials: at least one of " + AllTextures());
  }
  const std::string& name = RoundAndRound(options.materials, trial);
  const std::optional<GroundTexture> texture = TextureOf(name);
  if (!texture) {
    return UsageError("--materials: '" + name + "' is none of " + AllTextures());
  }
  GroundPainter painter(*texture, seed);
  return FilmGround{
      name,
      GroundPyramid([&](double north_m, double east_m) { return painter.Grey(north_m, east_m); },
                    options.extent),
      film};
}

}  // namespace palace
