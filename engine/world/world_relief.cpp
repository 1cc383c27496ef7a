#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "engine/core/text.h"
#include "engine/world/imported.h"
#include "engine/world/lattice_noise.h"
#include "engine/world/world_tables.h"

namespace palace {
namespace {

using Eigen::Vector2d;

constexpr NumberLimits kDepth{0.01, 5, "metres below the ground"};
constexpr NumberLimits kRough{0, 0.5, "metres, standard deviation"};
constexpr NumberLimits kWave{0.2, 64, "metres of wavelength"};
constexpr NumberLimits kHurst{0.2, 1.5, "0.5 rugged .. 1 smooth"};
constexpr NumberLimits kSquare{16, 128, "metres a side; it goes on mirrored"};

/// A cut or rise of the ground: metres up at a place, 0 farther than `reach_m` from the stretch
/// between two places.
struct Form {
  Vector2d from, to;
  double reach_m;
  HeightFunction height;
};

double DistanceTo(const Vector2d& place, const Vector2d& from, const Vector2d& to) {
  const Vector2d along = to - from, off = place - from;
  const double s = std::clamp(off.dot(along) / std::max(along.squaredNorm(), 1e-9), 0.0, 1.0);
  return (off - s * along).norm();
}

/// Forms by the blocks of a square that they reach into: a world may hold two thousand, and each
/// would be asked at each of a million corners.
class FormsOfSquare {
 public:
  FormsOfSquare(const HeightField::Place& square, const std::vector<Form>& forms)
      : square_(square), block_m_(square.size_m / kBlocks) {
    for (std::size_t i = 0; i < kBlocks * kBlocks; ++i) {
      const Vector2d middle(square.north_m + (double(i / kBlocks) + 0.5) * block_m_,
                            square.east_m + (double(i % kBlocks) + 0.5) * block_m_);
      for (const Form& form : forms) {
        // The whole side for the half diagonal: rounding of places takes none of it.
        if (DistanceTo(middle, form.from, form.to) <= form.reach_m + block_m_) {
          blocks_[i].push_back(&form.height);
        }
      }
    }
  }

  /// Metres up at a place of the square, added to `height_m` in the order of the file.
  double Height(double north_m, double east_m, double height_m) const {
    for (const HeightFunction* form :
         blocks_[Index(north_m - square_.north_m) * kBlocks + Index(east_m - square_.east_m)]) {
      height_m += (*form)(north_m, east_m);
    }
    return height_m;
  }

 private:
  static constexpr std::size_t kBlocks = 64;  ///< a side
  std::size_t Index(double in_m) const {
    return static_cast<std::size_t>(std::clamp(in_m / block_m_, 0.0, double(kBlocks - 1)));
  }

  const HeightField::Place square_;
  const double block_m_;
  std::vector<std::vector<const HeightFunction*>> blocks_{kBlocks * kBlocks};
};

Status ReadForms(WorldTables& tables, std::vector<Form>& forms) {
  Status read = tables.Each("hole", [&](TomlTable& table) {
    const Vector2d at = ReadPlace(table, "at");
    const double radius_m = table.Number("diameter_m", kSize) / 2;
    const double depth_m = table.Number("depth_m", kDepth);
    forms.push_back({at, at, radius_m, [=](double n, double e) {
                       return std::hypot(n - at.x(), e - at.y()) <= radius_m ? -depth_m : 0.0;
                     }});
  });
  if (!read) {
    return read;
  }
  read = tables.Each("ditch", [&](TomlTable& table) {
    const Vector2d from = ReadPlace(table, "from"), to = ReadPlace(table, "to");
    const double half_m = table.Number("width_m", kSize) / 2;
    const double depth_m = table.Number("depth_m", kDepth);
    forms.push_back({from, to, half_m, [=](double n, double e) {
                       return DistanceTo({n, e}, from, to) <= half_m ? -depth_m : 0.0;
                     }});
  });
  if (!read) {
    return read;
  }
  return tables.Each("mound", [&](TomlTable& table) {
    const Vector2d at = ReadPlace(table, "at");
    const double radius_m = table.Number("diameter_m", kSize) / 2;
    const double height_m = table.Number("height_m", kDepth);
    forms.push_back({at, at, radius_m, [=](double n, double e) {
                       const double share = std::hypot(n - at.x(), e - at.y()) / radius_m;
                       return share < 1 ? height_m * 0.5 * (1 + std::cos(std::numbers::pi * share))
                                        : 0.0;
                     }});
  });
}

/// Most of it ahead of the vehicle, where its cameras look.
HeightField::Place SquareAhead(double size_m) { return {-size_m / 4, -size_m / 2, size_m, 10}; }

void ReadHeights(TomlTable& table, const std::filesystem::path& folder,
                 const HeightField::Place& square, std::vector<Form>& forms) {
  const std::string file = table.Text("file");
  const Vector2d middle(square.north_m + square.size_m / 2, square.east_m + square.size_m / 2);
  const Vector2d at = table.Has("at") ? ReadPlace(table, "at") : middle;
  Result<HeightFunction> heights = ImportHeights(folder / file, at, square);
  if (!heights) {
    table.FailKey("file", ": " + heights.error().message);
    return;
  }
  forms.push_back({middle, middle, std::numeric_limits<double>::infinity(), std::move(*heights)});
}

}  // namespace

Status ReadRelief(WorldTables& tables, World& world) {
  std::vector<Form> forms;
  if (const Status read = ReadForms(tables, forms); !read) {
    return read;
  }
  TomlTable table = tables.Table("relief");
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
      ReadHeights(table, tables.folder(), SquareAhead(size_m), forms);
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
  if (rms_m > 0 || !forms.empty()) {
    const FormsOfSquare of_square(SquareAhead(size_m), forms);
    world.ground.relief = std::make_shared<const HeightField>(SquareAhead(size_m), [&](double n,
                                                                                       double e) {
      return of_square.Height(n, e, rms_m * FractalNoise(n, e, seed, longest_m, shortest_m, hurst));
    });
  }
  return Ok();
}

}  // namespace palace
