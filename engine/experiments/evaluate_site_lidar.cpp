#include "engine/experiments/evaluate_site_lidar.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <utility>

#include <CLI/CLI.hpp>

#include "engine/core/units.h"
#include "engine/experiments/raster_peers.h"
#include "engine/report/statistics.h"
#include "engine/report/svg_plot.h"
#include "engine/slad/hazards/plane_fit.h"
#include "engine/slad/slad.h"
#include "engine/survey/cloud_elevation.h"
#include "engine/survey/hazard_layer.h"
#include "engine/geodata/point_files.h"

namespace palace {
namespace {

namespace fs = std::filesystem;

constexpr double kSlope_deg = 15, kRough_m = 0.5;  // the limits of the comparison
constexpr double kWantedObjects = 0.90, kWantedGround = 0.25;
constexpr const char* kOurs = "PALACE";  // at those limits
constexpr const char* kRoughnessMoved = "PALACE: roughness limit";
constexpr const char* kAllMoved = "PALACE: all limits";
constexpr const char* kAllowed = "PALACE: raised allowed";
constexpr const char* kPlainRoughness = "gdaldem roughness";
constexpr const char* kPlainSlope = "gdaldem slope";

struct LidarOptions {
  std::string data = "../shared/data/isprs_lidar";
};

/// One sample on its grid.
struct Sample {
  ElevationMap map;
  Grid<std::int8_t> label;         ///< 1 ground, 0 object, -1 no point
  Grid<std::uint8_t> truly_steep;  ///< the ground's own points lie steeper than kSlope_deg
};

Result<std::vector<fs::path>> FilesOf(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".xyz") {
      files.push_back(entry.path());
    }
  }
  if (files.empty()) {
    return UnavailableError("skipped: no samp*.xyz in " + folder.string() +
                            "; give the folder of labelled lidar with --data");
  }
  std::sort(files.begin(), files.end());
  return files;
}

SladSettings Limits(double slope_deg, double rough_m) {
  SladSettings slad;
  slad.limits.max_slope_deg = slope_deg;
  slad.limits.max_deviation_m = slad.limits.max_step_m = rough_m;
  return slad;
}

double CellFor(const std::vector<LabelledPoint>& points) {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(HUGE_VAL), high = -low;
  for (const LabelledPoint& p : points) {
    low = low.cwiseMin(p.point.head<2>());
    high = high.cwiseMax(p.point.head<2>());
  }
  return double(points.size()) < 0.5 * (high - low).prod() ? 2.5 : 1.0;
}

Result<Sample> ReadSample(const fs::path& path) {
  const auto points = ReadLabelledPoints(path);
  if (!points) {
    return points.error();
  }
  std::vector<Eigen::Vector3d> cloud;
  for (const LabelledPoint& p : *points) {
    cloud.push_back(p.point);
  }
  std::vector<std::string> warnings;
  auto map = MapOfCloud(cloud, CellFor(*points), Limits(kSlope_deg, kRough_m), warnings);
  if (!map) {
    return Error{map.error().code, path.string() + ": " + map.error().message};
  }
  Sample sample{std::move(map).value(), {}, {}};
  const GridGeometry& g = sample.map.geometry;
  sample.label = Grid<std::int8_t>(g.rows, g.cols, -1);
  GridF highest(g.rows, g.cols, -HUGE_VALF);
  for (const LabelledPoint& p : *points) {
    const auto cell = g.CellFromPoint(p.point.y(), p.point.x());
    if (cell && static_cast<float>(p.point.z()) > highest.at(*cell)) {
      highest.at(*cell) = static_cast<float>(p.point.z());
      sample.label.at(*cell) = p.ground ? 1 : 0;
    }
  }
  ElevationMap bare = sample.map;
  for (std::size_t i = 0; i < bare.state.cells().size(); ++i) {
    if (sample.label.cells()[i] != 1) {
      bare.state.cells()[i] = CellState::kUnknown;
    }
  }
  const FootprintPlanes ground = FitFootprintPlanes(bare, Lander{}.base_size_m);
  sample.truly_steep = Grid<std::uint8_t>(g.rows, g.cols, 0);
  for (std::size_t i = 0; i < bare.state.cells().size(); ++i) {
    const float north = ground.plane.north_gradient.cells()[i];
    const float east = ground.plane.east_gradient.cells()[i];
    sample.truly_steep.cells()[i] = std::hypot(north, east) > std::tan(Rad(kSlope_deg)) ? 1 : 0;
  }
  return sample;
}

/// What one way of judging says of a sample. flagged(i): 1, 0 or NaN for the i-th cell.
TrialRow Count(const std::string& name, const Sample& sample, const std::string& method,
               double limit, const std::function<float(std::size_t)>& flagged) {
  int object = 0, object_flagged = 0, ground = 0, ground_flagged = 0, steep = 0, unknown = 0;
  for (std::size_t i = 0; i < sample.label.cells().size(); ++i) {
    const int label = sample.label.cells()[i];
    if (label < 0) {
      continue;
    }
    const float verdict = flagged(i);
    unknown += std::isnan(verdict) ? 1 : 0;
    object += label == 0 ? 1 : 0;
    object_flagged += label == 0 && verdict > 0.5F ? 1 : 0;
    ground += label == 1 ? 1 : 0;
    ground_flagged += label == 1 && verdict > 0.5F ? 1 : 0;
    steep += label == 1 && sample.truly_steep.cells()[i] != 0 ? 1 : 0;
  }
  return {name,
          CsvNumber(sample.map.geometry.cell_m),
          method,
          CsvNumber(limit),
          std::to_string(object),
          std::to_string(object_flagged),
          std::to_string(ground),
          std::to_string(ground_flagged),
          std::to_string(steep),
          std::to_string(unknown)};
}

Result<std::vector<TrialRow>> RunSample(const LidarOptions& options, int trial) {
  const auto files = FilesOf(options.data);
  if (!files) {
    return files.error();
  }
  if (trial >= static_cast<int>(files->size())) {
    return UsageError(options.data + " holds " + std::to_string(files->size()) +
                      " samples; give --trials " + std::to_string(files->size()));
  }
  const fs::path& path = (*files)[static_cast<std::size_t>(trial)];
  const auto sample = ReadSample(path);
  if (!sample) {
    return sample.error();
  }
  const std::string name = path.stem().string();
  std::vector<TrialRow> rows;
  Slad slad;
  slad.Take(sample->map);
  const auto ours = [&](const char* method, double limit, const SladSettings& limits) {
    Settings settings;
    settings.slad = limits;
    const auto decision = slad.Decide(settings, Letters::kOfCopy);
    const GridF layer = HazardLayer(sample->map, *decision->hazards, limits.mode);
    rows.push_back(
        Count(name, *sample, method, limit, [&](std::size_t i) { return layer.cells()[i]; }));
  };
  ours(kOurs, kRough_m, Limits(kSlope_deg, kRough_m));
  for (const double rough_m : {0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 5.0}) {
    ours(kRoughnessMoved, rough_m, Limits(kSlope_deg, rough_m));
  }
  for (const double slope_deg : {5.0, 8.0, 11.0, 15.0, 20.0, 25.0, 30.0, 35.0, 45.0, 60.0, 75.0}) {
    const double share = std::tan(Rad(slope_deg)) / std::tan(Rad(kSlope_deg));
    SladSettings limits = Limits(slope_deg, kRough_m * share);
    ours(kAllMoved, slope_deg, limits);
    limits.limits.elevated = ElevatedSurface::kAllow;
    ours(kAllowed, slope_deg, limits);
  }
  // The plain passes see the raster as it was measured, without filled holes.
  GridF measured = sample->map.height_m;
  for (std::size_t i = 0; i < measured.cells().size(); ++i) {
    const bool known = sample->map.state.cells()[i] == CellState::kMeasured;
    measured.cells()[i] = known ? measured.cells()[i] : kUnknownValue;
  }
  const GridF roughness = PlainRoughnessM(measured);
  for (const double limit :
       {0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0}) {
    rows.push_back(Count(name, *sample, kPlainRoughness, limit, [&](std::size_t i) {
      return roughness.cells()[i] > static_cast<float>(limit) ? 1.0F : 0.0F;
    }));
  }
  const GridF slope = PlainSlopeRad(measured, sample->map.geometry.cell_m);
  for (const double limit : {3.0, 5.0, 8.0, 11.0, 15.0, 20.0, 25.0, 30.0, 40.0, 50.0, 60.0, 75.0}) {
    rows.push_back(Count(name, *sample, kPlainSlope, limit, [&](std::size_t i) {
      return slope.cells()[i] > static_cast<float>(Rad(limit)) ? 1.0F : 0.0F;
    }));
  }
  return rows;
}

/// Mean over the samples of the share of one kind of cells.
double MeanShare(const TrialTable& rows, const char* hits, const char* of) {
  const std::vector<double> n = rows.Numbers(hits), all = rows.Numbers(of);
  std::vector<double> shares;
  for (std::size_t i = 0; i < n.size(); ++i) {
    shares.push_back(n[i] / all[i]);
  }
  return SpreadOf(shares).mean;
}

struct CurvePoint {
  double limit, object, ground;
};
std::vector<CurvePoint> CurveOf(const TrialTable& table, const std::string& method) {
  const TrialTable rows = table.Where("method", method);
  std::vector<CurvePoint> curve;
  for (const std::string& limit : rows.Values("limit")) {
    const TrialTable at = rows.Where("limit", limit);
    curve.push_back({std::stod(limit), MeanShare(at, "objects_flagged", "objects"),
                     MeanShare(at, "ground_flagged", "ground")});
  }
  return curve;
}

/// Whether some point of `ours` flags at least as many objects and no more ground.
bool Ahead(const std::vector<CurvePoint>& ours, const CurvePoint& peer) {
  return std::any_of(ours.begin(), ours.end(), [&](const CurvePoint& p) {
    return p.object >= peer.object && p.ground <= peer.ground;
  });
}

PlotSeries SeriesOf(const std::string& name, const std::vector<CurvePoint>& curve) {
  PlotSeries series{.name = name, .x = {}, .y = {}};
  for (const CurvePoint& p : curve) {
    series.x.push_back(100 * p.ground);
    series.y.push_back(100 * p.object);
  }
  return series;
}

std::string Percent(double share) {
  char text[24];
  std::snprintf(text, sizeof text, "%.1f %%", 100 * share);
  return text;
}
/// "93.1 % (92.6 - 93.5)"
std::string WithInterval(double hits, double all) {
  const Interval i = WilsonInterval(static_cast<int>(hits), static_cast<int>(all));
  char text[64];
  std::snprintf(text, sizeof text, "%.1f %% (%.1f - %.1f)", 100 * hits / all, 100 * i.low,
                100 * i.high);
  return text;
}

std::vector<std::vector<std::string>> SampleRows(const TrialTable& table) {
  std::vector<std::vector<std::string>> out;
  const auto text = [](const TrialTable& rows, const char* hits, const char* of) {
    return rows.rows.empty() ? std::string("-")
                             : WithInterval(rows.Numbers(hits)[0], rows.Numbers(of)[0]);
  };
  for (const std::string& sample : table.Values("sample")) {
    const TrialTable rows = table.Where("sample", sample), ours = rows.Where("method", kOurs);
    const TrialTable rough = rows.Where("method", kPlainRoughness).Where("limit", "0.5");
    const TrialTable slope = rows.Where("method", kPlainSlope).Where("limit", "15");
    out.push_back({sample, ours.rows.empty() ? "" : ours.rows[0][ours.Index("cell_m")],
                   text(ours, "objects_flagged", "objects"), text(ours, "ground_flagged", "ground"),
                   text(ours, "ground_steep", "ground"), text(rough, "objects_flagged", "objects"),
                   text(rough, "ground_flagged", "ground"),
                   text(slope, "objects_flagged", "objects"),
                   text(slope, "ground_flagged", "ground")});
  }
  return out;
}

ExperimentReport ReportLidar(const TrialTable& table) {
  ExperimentReport report{HtmlPage("PALACE: labelled lidar")};
  const TrialTable ours = table.Where("method", kOurs);
  const double object = MeanShare(ours, "objects_flagged", "objects");
  const double ground = MeanShare(ours, "ground_flagged", "ground");
  const double steep = MeanShare(ours, "ground_steep", "ground");
  std::vector<CurvePoint> own = CurveOf(table, kRoughnessMoved);
  for (const char* method : {kAllMoved, kAllowed}) {
    const std::vector<CurvePoint> more = CurveOf(table, method);
    own.insert(own.end(), more.begin(), more.end());
  }
  int ahead = 0, peers = 0;
  for (const char* method : {kPlainRoughness, kPlainSlope}) {
    for (const CurvePoint& peer : CurveOf(table, method)) {
      ahead += Ahead(own, peer) ? 1 : 0;
      ++peers;
    }
  }
  const bool both = object >= kWantedObjects && ground <= kWantedGround;
  report.lines = {
      "At 15 deg and 0.5 m, mean of " + std::to_string(ours.rows.size()) + " samples: objects " +
          Percent(object) + " flagged (missed, false-safe: " + Percent(1 - object) + "), ground " +
          Percent(ground) + " flagged (false-unsafe, with truly steep ground)",
      "Ground that is truly steeper than 15 deg by its own labelled points: " + Percent(steep) +
          "; flagged beyond that: " + Percent(ground - steep),
      "Wanted: objects >= 90 %, ground <= 25 %: " + std::string(both ? "both hold" : "not both"),
      "Points of the plain passes' curves that PALACE is ahead of or level with: " +
          std::to_string(ahead) + " of " + std::to_string(peers)};
  report.passed = object >= kWantedObjects && (ground <= kWantedGround || ahead == peers);
  LinePlot plot{"Objects flagged against ground flagged, mean of the samples",
                "ground cells flagged, %",
                "object cells flagged, %",
                {}};
  plot.series = {SeriesOf(kRoughnessMoved, CurveOf(table, kRoughnessMoved)),
                 SeriesOf(kAllMoved, CurveOf(table, kAllMoved)),
                 SeriesOf(kAllowed, CurveOf(table, kAllowed)),
                 SeriesOf(kPlainRoughness, CurveOf(table, kPlainRoughness)),
                 SeriesOf(kPlainSlope, CurveOf(table, kPlainSlope))};
  plot.limits = {{100 * kWantedObjects, "90 % wanted"}};
  plot.x_min = plot.y_min = 0;
  plot.x_max = plot.y_max = 100;
  report.page.List(report.lines)
      .Figure(
          LinePlotSvg(plot),
          "Left and up is better. Each point is one limit: roughness and step alone, all limits "
          "together, and all with raised surfaces allowed.")
      .Heading("Samples, at 15 deg and 0.5 m")
      .Paragraph(
          "Shares of cells with 95 % Wilson intervals. A cell is what its highest point is; cells "
          "without a point do not count. Labels: ISPRS filter test, Sithole and Vosselman 2004.")
      .Table({"Sample", "Cell, m", "Objects flagged", "Ground flagged", "Ground truly steep",
              "Roughness 0.5 m: objects", "ground", "Slope 15 deg: objects", "ground"},
             SampleRows(table));
  return report;
}

}  // namespace

Experiment SiteLidarExperiment() {
  auto options = std::make_shared<LidarOptions>();
  Experiment experiment;
  experiment.name = "site-lidar";
  experiment.purpose = "Object and ground cells of labelled lidar that become hazards";
  experiment.default_trials = 5;
  experiment.columns = {"sample",          "cell_m", "method",         "limit",        "objects",
                        "objects_flagged", "ground", "ground_flagged", "ground_steep", "unknown"};
  experiment.add_options = [options](CLI::App& verb) {
    verb.add_option("--data", options->data, "Folder of samples, text of x y z label")
        ->capture_default_str();
  };
  experiment.setup = [options] { return "samples of " + options->data; };
  experiment.run = [options](int trial, std::uint64_t) { return RunSample(*options, trial); };
  experiment.report = ReportLidar;
  return experiment;
}

}  // namespace palace
