#include "engine/experiments/film_curve.h"

#include <cmath>
#include <utility>

#include "engine/experiments/point_film.h"
#include "engine/report/statistics.h"

namespace palace {
namespace {

std::string ColumnOf(int picture) { return "error_at_" + std::to_string(picture) + "_px"; }

}  // namespace

std::vector<std::string> FilmCurve::Columns() const {
  std::vector<std::string> columns;
  for (int picture = 0; picture < kFilmPictures; picture += step) {
    columns.push_back(ColumnOf(picture));
  }
  return columns;
}

void FilmCurve::Append(std::span<const double> error_px, TrialRow& row) const {
  for (std::size_t i = 0; i < std::size_t{kFilmPictures}; i += static_cast<std::size_t>(step)) {
    row.push_back(CsvNumber(i < error_px.size() ? error_px[i] : NAN));
  }
}

LinePlot FilmCurve::Plot(const TrialTable& rows, const std::string& title) const {
  LinePlot plot{title, "picture, 30 a second", "error of the told place, px", {}};
  plot.log_y = true;
  for (const std::string& name : rows.Values("method")) {
    const TrialTable one = rows.Where("method", name);
    PlotSeries series{.name = name, .x = {}, .y = {}};
    series.points = false;
    for (int picture = step; picture < kFilmPictures; picture += step) {
      series.x.push_back(picture);
      series.y.push_back(Percentile(one.Numbers(ColumnOf(picture)), 0.5));
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

}  // namespace palace
