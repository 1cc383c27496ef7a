// Fine relief: heights finer than stereo's window, from the pictures of many frames together.
// Internal to the SLAD room.
//
// A disparity is matched over a window, so that a thing narrower than it drowns in the ground
// around, and fractions of a pixel read from ten noisy frames do not average as plain means do.
// Here the height of a place is one unknown, shared by all pixels of all frames that saw it
// (least-squares matching in object space). About the smooth disparity d0 with which the right
// picture is laid over the left one (laid_over.h), each pixel tells, g the horizontal gradient of
// the left picture as it is smoothed there,
//
//   e = -g (d - d0) + noise of variance s^2
//
// and with h0 the height of its point at d0, k = dh/dd, over all pixels of a cell and all frames
//
//   A = sum (g^2 - 0.30 s^2) / (k s)^2,   J = sum (h0 (g^2 - 0.30 s^2) / k^2 - e g / k) / s^2
//   h = J / A,   sigma^2 = G / A^2,       G = sum g^2 / (k s)^2
//
// if noise is new in every frame; what frames repeat of it is measured, and G in what Sums() tells
// has it (repeated_noise.h). 0.30 s^2 is what noise adds to g^2 (as in stereo/subpixel.h). A is
// what the pictures know of the height (Fisher information, 1/m^2): where it is small a thing would
// not show, and that is known as well.
//
// Frames: W, metres, heights up-positive. Deterministic: stripes of rows are summed in a fixed
// order, whatever the threads.
//
// Sources: Wrobel 1987 and Ebner & Heipke 1988 (matching in object space); Lucas & Kanade 1981.
// Deviations: one unknown a cell, linear once about a smooth ground, noise out of the information.
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "engine/model/elevation_map.h"
#include "engine/model/image.h"
#include "engine/model/range_map.h"
#include "engine/slad/terrain/fine_sums.h"
#include "engine/slad/terrain/frame_registration.h"
#include "engine/slad/terrain/repeated_noise.h"

namespace palace {

struct LaidOver;

class FineRelief {
 public:
  void Reset() { *this = {}; }
  /// Keeps what lies in the new map. Another cell size forgets all.
  void MoveTo(const GridGeometry& map);
  /// Adds a frame: its ranges with a pose, its rectified pictures, both of the range map's size;
  /// smaller ones than 64 pixels tell nothing. `off` is taken from its heights. `memory`: so many
  /// frames are remembered.
  void Add(const RangeMap& range, const ImageU8& left, const ImageU8& right,
           const PlaneCorrection& off, int memory);
  /// What was known under that cell of the map is known no more: something new stands there.
  void Forget(Cell cell);
  /// Raises all that is known by so much times the correction.
  void Raise(const PlaneCorrection& correction, double gain);

  bool empty() const { return frames_ == 0; }
  FineSums Sums() const { return {WithRepeatedNoise(seen_), places_, reference_m_}; }
  /// What pixels tell of each place, over the frames remembered.
  const Grid<FinePlace>& seen() const { return seen_; }

  /// The places of a map.
  static GridGeometry PlacesOf(const GridGeometry& map);

 private:
  /// What the pixels of a stripe of one picture tell; zeros between frames.
  struct Stripe {
    Grid<FinePlace> places;
    int first_row = 0, end_row = 0;  ///< of places that it tells of
  };

  void AddRows(const RangeMap& range, const ImageU8& left, const LaidOver& laid,
               const PlaneCorrection& off, int first, int end, Stripe& stripe) const;
  /// Adds a row of the stripes to what is known; `remember`: the share of that which is kept.
  void TakeRow(int row, float remember);

  GridGeometry places_;
  Grid<FinePlace> seen_;
  std::vector<Stripe> stripes_;
  double reference_m_ = 0;
  int frames_ = 0;
};

}  // namespace palace
