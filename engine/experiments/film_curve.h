// The error of a followed film as columns of an experiment's table, and as curves.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/experiments/experiment.h"
#include "engine/report/svg_plot.h"

namespace palace {

/// Every `step`-th picture of a film of kFilmPictures: columns error_at_0_px, error_at_8_px, ...
struct FilmCurve {
  int step = 1;  ///< pictures between two points

  std::vector<std::string> Columns() const;
  /// NaN beyond the film's end.
  void Append(std::span<const double> error_px, TrialRow& row) const;
  /// One curve a method: at each picture the median over the rows. Points after the first, where
  /// all began without error.
  LinePlot Plot(const TrialTable& rows, const std::string& title) const;
};

}  // namespace palace
