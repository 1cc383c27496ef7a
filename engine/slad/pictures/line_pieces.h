// Straight pieces of lines over strips of 32 rows of a picture of marks, and chains of them.
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "engine/model/image.h"
#include "engine/slad/pictures/line_sums.h"

namespace palace {

/// A line over one strip, in strip coordinates: `along` runs over the strips.
struct LinePiece {
  int strip = 0;
  double from = 0;      ///< across, on the strip's first row
  double to = 0;        ///< on its last
  int sum = 0;          ///< of marks
  double above_px = 0;  ///< disparity beyond the ground's
};

/// A picture of marks as strips see it: upright, or transposed for lines that run across.
struct MarkStrips {
  ImageU8 marks;
  bool transposed = false;

  int count() const { return marks.height() / kStrip_px; }
  /// Pixel of the upright picture, `share` 0..1 along the piece.
  Eigen::Vector2d Pixel(const LinePiece& piece, double share) const;
};

/// The lines of a strip with a sum of at least `least_sum`, strongest first; at most 24, at least
/// six pixels apart on average.
std::vector<LinePiece> FindPieces(const MarkStrips& strips, int strip, int least_sum,
                                  LineSums& lines);
/// Chains of at least `least` pieces that continue each other, over at most one missing strip;
/// where a chain goes on it may bend a little and climb a few pixels of disparity. In the order of
/// their first pieces, which keep theirs.
std::vector<std::vector<LinePiece>> Chains(const std::vector<LinePiece>& pieces, std::size_t least);

}  // namespace palace
