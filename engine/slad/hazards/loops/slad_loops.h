// Inner loops of the hazard maps: compiled once for every x86-64, once for AVX2 and once for
// AVX-512, chosen at run time. All are made from the same source (lmeds_loops.h and its like) with
// uncontracted floats, so they give the same bits.
#pragma once

namespace palace {

/// Inliers of a plane: rounding must not reject points of an exact plane.
inline constexpr float kLeastThreshold_m = 1e-3F;
/// With fewer samples every triple has a median residual of 0: least squares over all of them.
inline constexpr float kLeastForMedian = 6;
/// Rows must be readable, and where it is said writable, so many floats beyond their end.
inline constexpr int kLaneSlack = 16;

/// One row of fitted planes; arrays of the row's length, NaN where no plane is spanned.
struct PlaneRow {
  float* height_m;
  float* residual_m;  ///< height of the cell less that of the plane
  float* north_gradient;
  float* east_gradient;
};

/// The rows a disc around the cells of one row takes part of, at column 0; readable `half` further
/// on both sides, and kLaneSlack on the right.
struct DiscRows {
  int rows;
  int stride;             ///< columns between the samples of a row
  const int* row_offset;  ///< rows south of the middle
  const int* half;        ///< of the disc in that row, a multiple of the stride
  const float* const* height;
  const float* const* noise2;    ///< taken from the square of the deviation
  const float* const* denoised;  ///< heights less their noise already, NaN where none count
};

/// Noise that makes the squared deviation of an unknown cell negative whatever its height.
inline constexpr float kBeyondHeights = 1e20F;

/// The cells around those of one row, at column 0; readable one further to the left, 1 + kLaneSlack
/// to the right.
struct StepRows {
  const float* height[3];  ///< of the row to the north, the row itself and that to the south
  const float* noise2[3];  ///< taken from squared steps; kBeyondHeights where not measured
  const float* plane[3];
  const float* east;  ///< gradients a cell
  const float* south;
};

/// The heights around the cells of one row that DenoiseRow looks at, at column 0; known is 1 or 0.
/// Readable one further to the left, 1 + kLaneSlack to the right.
struct DenoiseRows {
  const float* height[3];  ///< of the row to the north, the row itself and that to the south
  const float* known[3];
  const float* plane;  ///< of each cell: height and gradients a cell
  const float* east;
  const float* south;
  const float* variance_m2;
};

/// No height is known better than this.
inline constexpr float kHeightSigmaFloor_m = 1e-3F;

/// Weighted sums over a window: w, wx, wy, wxx, wxy, wyy, wz, wxz, wyz, wzz, count, variance.
inline constexpr int kMoments = 12;
/// A perfect cell's weight stays finite: variances below (1 cm)^2 count alike.
inline constexpr double kVarianceFloor_m2 = 1e-4;
/// Stereo noise is shared by this many neighbouring cells.
inline constexpr double kCorrelatedCells = 4;

/// A row of cells whose moments are added (sign 1) or taken away (-1).
struct MomentRow {
  const float* weight;
  const float* height_m;
  const float* variance_m2;
  double y, sign;
};

/// Columns that solve_moments takes at a time.
inline constexpr int kSolveRun = 64;

/// Planes of one row over their windows, NaN where none was spanned; heights above the reference,
/// gradients per cell.
struct FittedRow {
  float* height_m;
  float* east;
  float* south;
  float* scatter_m;  ///< rms weighted residual
  float* gradient_sigma;
  float* cell_variance_m2;
};

/// The cells of one row and their planes.
struct CheckedRow {
  const float* full_weight;
  const float* height_m;
  const float* variance_m2;
  const float* plane_m;  ///< NaN where there is none
  const float* scatter_m;
};

/// Farthest hazard that nearest_in_row looks for, cells.
inline constexpr int kNearestReach = 64;

// Bits of HazardReason.
inline constexpr int kSteep = 1, kRough = 2, kStepped = 4, kNotKnown = 8, kUnlikely = 16;

struct ThesisLimits {
  float max_slope_rad;
  float max_roughness_m;
};
struct ModernLimits {
  float max_slope_rad;
  float max_deviation_m;
  float max_step_m;
  float min_safe_probability;
  float provisional_sigma_m;  ///< kProvisionalSigma_m
  float belly_clearance_m;
  float gear_width_m;
  float finer_relief;  ///< 1; 0 where what is finer than cells was measured and counted (H)
};
struct ModernRow {
  const float* slope;  ///< NaN where there is no plane
  const float* slope_sigma;
  const float* footprint_deviation_m;
  const float* footprint_step_m;
  const float* footprint_sigma_m;
  const float* denoised_deviation_m;
  const float* gear_tilt;  ///< NaN where the gear would reach unknown ground
  const float* belly_rise_m;
  const float* cell_deviation_m;
  const float* cell_step_m;
  const float* cell_sigma_m;
  const unsigned char* measured;  ///< 1 where the cell itself was
};
struct ModernVerdict {
  float* safe_probability;
  float* cost;
  unsigned char* reasons;
};

/// Most points of one skid; a longer one on small cells has them farther apart.
inline constexpr int kMostGearPoints = 13;

/// A point of the gear between four cells: the north-western one at `offset` floats from the cell
/// under the gear's middle, and the shares of it, its eastern, southern and south-eastern
/// neighbours.
struct GearPoint {
  int offset;
  float weight[4];
};
/// Cells of one row under the belly, `stride` floats apart; where the first one's centre is, seen
/// from the gear's middle.
struct BellyRow {
  int offset, cells, stride;
  float north_m, east_m;
};
struct GearHeading {
  float north, east;                    ///< unit vector forward
  GearPoint point[2][kMostGearPoints];  ///< left and right, aft to fore; pads: aft, fore
  int belly_rows;
  float belly_step_m;  ///< to the east from cell to cell
  const BellyRow* belly;
};
/// The gear over a layer of heights whose rows are `pitch` floats apart.
struct GearShape {
  bool skids;
  int points;  ///< of one skid, odd and at least 3; 2 for pads
  float spacing_m;
  float width_m;
  float up_W[3];
  int pitch;
  int headings;
  const GearHeading* heading;
};

struct SladLoops {
  /// Exact LMedS, then least squares, around each of `count` cells. rows: the heights `stride` rows
  /// to the north, of the row itself and to the south, at column 0; readable from -stride to
  /// count - 1 + stride + kLaneSlack, NaN where unknown.
  void (*fit_planes)(const float* const* rows, int stride, float spacing_m, int count,
                     const PlaneRow& out);
  /// square = the largest of itself and (height - plane)^2 - noise2 over the disc, denoised_off
  /// that of itself and |denoised - plane|. All rows are readable, both results writable,
  /// kLaneSlack beyond count.
  void (*disc_deviation)(const DiscRows& disc, const float* plane, const float* east,
                         const float* south, int count, float* square, float* denoised_off);
  /// Largest squared step to one of the eight neighbours beyond what the plane rises and both
  /// noises, and the same for the cell that stands farther off its plane and so makes the step;
  /// -kBeyondHeights where there is none. Writable kLaneSlack beyond count.
  void (*steps)(const StepRows& rows, int count, float* most2, float* at_cell2);
  /// Heights less their noise, by hyperbolic shrinkage: off its plane a cell keeps sqrt(off^2 - 9
  /// sigma^2), the mean of the cells around it and the rest apart. 0 where not known.
  void (*denoise)(const DenoiseRows& rows, int count, float* denoised_m);
  /// most = the largest of itself and values[c - half .. c + half]. work: count + 2 half floats.
  void (*window_maximum)(const float* values, int half, int count, float* work, float* most);
  /// columns[k pitch + c] += moment k of each of the rows' cells, times the row's sign and in that
  /// order; cells of weight 0 are left out. x = c + x0. Rows and columns are readable, columns
  /// writable too, kLaneSlack beyond count.
  void (*add_moments)(const MomentRow* rows, int row_count, int x0, int count, int pitch,
                      double* columns);
  /// Planes over the windows c - half .. c + half of the columns' sums, which are readable half to
  /// the left, half + kLaneSlack beyond the next multiple of kSolveRun to the right. work:
  /// kSolveRun
  /// + 2 half doubles. A window that spans no plane leaves the row as it is.
  void (*solve_moments)(const double* columns, int pitch, int half, int x0, double y, int count,
                        double* work, const FittedRow& out);
  /// weight = 0 where a cell stands off its plane, its full weight elsewhere; as it was where there
  /// is no plane. Whether any changed. Readable, and weight writable, kLaneSlack beyond count.
  bool (*reject_outliers)(const CheckedRow& row, int count, float* weight);
  /// gap = 0 on a hazard, else the least of itself and one more than that of the row beside it.
  void (*column_gaps)(const unsigned char* hazard, const float* near, int count, float* gap);
  /// Squares of the gaps less the inset.
  void (*square_gaps)(const float* gap, float inset, int count, float* square);
  /// Square root of the least of square[c] and all square[c + d] + (|d| - inset)^2, squared cells
  /// to metres, inset 0 or 1/2. False, and no distances, where a cell has nothing within
  /// kNearestReach. Readable kNearestReach + kLaneSlack further both ways, where
  /// there is a square of 0 at either end of the row.
  bool (*nearest_in_row)(const float* square, float inset, int count, double cell_m,
                         float* distance_m);
  /// Rests the gear around each cell of a row at every heading: the largest squared tangent of its
  /// tilt and the largest height of the ground under its belly above the plane it rests on. All
  /// cells it touches are readable, kLaneSlack more to the right; results writable as far.
  void (*put_gear_down)(const GearShape& gear, const float* height, int count, float* tan2,
                        float* rise_m);
  /// Angle between the plane's normal and the up vector. NaN where the gradient is.
  void (*slope)(const float* north_gradient, const float* east_gradient, const float* up_W,
                int count, float* slope_rad);
  void (*thesis_verdict)(const ThesisLimits& limits, const float* slope_rad,
                         const float* roughness_m, int count, float* cost, unsigned char* reasons);
  void (*modern_verdict)(const ModernLimits& limits, const ModernRow& row, int count,
                         const ModernVerdict& out);
};

/// Runs on every x86-64.
const SladLoops& PortableSladLoops();
/// Null where the processor has no AVX2, and no AVX-512.
const SladLoops* Avx2SladLoops();
const SladLoops* Avx512SladLoops();
const SladLoops& FastestSladLoops();

}  // namespace palace
