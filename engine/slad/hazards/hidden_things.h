// Hidden things: how many rocks or holes over the limit may lie unseen under a touchdown.
//
// What the pictures show of a place may be a thing over the limit all the same: it is smeared, and
// noise hides it. Of each place the map says by how much it stands above its surroundings (p), with
// which sigma (s), and which share of its height a thing 18 cm across would show there
// (narrow_things.h). One of 1.2 times the limit shows r, one of t times that t r, and against bare
// ground it is
//
//   l(t) = exp((2 t r p - t^2 r^2) / (2 s^2))
//
// times as likely (a hole: -p for p). Of things over the limit (t = 1, 1.5, 2.5), and of those
// below it (t = 1/4, 1/2, 3/4), each size is half as frequent as the one before, as rocks lie; L
// and l are their means. With n things a square metre over the limit, half of them holes, and no
// fewer smaller ones, a place that stands for an area A hides one with
//
//   q = (n A / 2) L / (1 + (n A / 2) (L + l))
//
// Over bare ground the mean of L is 1, whatever the noise: ground that tells nothing hides n A, and
// ground that tells much hides nearly nothing but where noise looks like a thing.
//
// Their sum H over the disc is the expected number, exp(-H) the chance that there is none. Ground
// that is smooth, near and textured hides none (1e-10); a place that stands out by half of r counts
// as much as one in which nothing could be seen, one that stands out by r is a thing, and a lower
// one seen well a low one.
//
// Where the pictures differ by what no height explains (terrain/unexplained.h) a thing may stand of
// which no height is told, with chance m, h2 high at least. Of things that high the share
// (h2 / 1.2 limits)^2 reaches over the limit, all where h2 does: rocks of a size are as many as its
// square is small. A cell hides by the most of its places' m times that, once: a thing covers
// several, in both pictures. Where that is more than a half the cell is a hazard. Beside one a mark
// is the hazard's own. Of the others nobody knows what they are: their sum over the disc counts up
// to what may hide in a place that is offered (kOffered).
//
// n is one number for all ground (CALIBRATION.md): among drawn worlds neither the things that a map
// shows elsewhere nor the ground searched for them told it better.
#pragma once

#include <cmath>

#include "engine/model/elevation_map.h"
#include "engine/model/grid.h"

namespace palace {

/// What is known of a map's narrow things, and how large the thing is that must not be missed.
struct NarrowView {
  const NarrowFigures& narrow;  ///< not empty
  double cell_m = 0;
  double max_deviation_m = 0;  ///< the limit of roughness
  /// To the nearest hazard: beside one its own foot lies on the ring, and what shows there is no
  /// second thing (L is 1 at most). Null: nothing is explained so.
  const GridF* safe_distance_m = nullptr;
};

/// Rocks and holes over the limit where none was found, per square metre.
inline constexpr double kThingsPer_m2 = 0.01;

/// H of the disc around each cell. Cells of which nothing is known, and those outside the map, hide
/// what n says. Rows are shared among OpenCV's threads; their number changes no bit.
GridF HiddenThings(const NarrowView& view, double radius_m, double things_per_m2 = kThingsPer_m2);

/// Of the disc around each cell: things that marks stand for. The view's narrow figures must have
/// them.
GridF MarkedThings(const NarrowView& view, double radius_m);

/// What a cell's marks hide when they rather are a thing over the limit than none.
inline constexpr double kRatherAThing = 0.5;

/// Adds kFlagUnexplained to the flags of cells whose marks alone hide more than `beyond`. Flags
/// that are empty become the map's if there is such a cell.
void FlagMarks(const NarrowView& view, double beyond, Grid<std::uint8_t>& flags);

/// H of the disc around `centre` as bare ground would say it, were it seen along the same lines
/// from `nearer` (above 0, at most 1) times as far: of each place the noise goes down as nearer^2,
/// bumps stay. Cells of which nothing is known hide as the others do; infinity when all are.
/// Beyond `enough` nothing is counted any more.
double HiddenFromNearer(const NarrowView& view, Cell centre, double radius_m, double nearer,
                        double enough = HUGE_VAL);

}  // namespace palace
