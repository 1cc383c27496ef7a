#include "engine/tools/analyze_files.h"

#include <string>
#include <system_error>

#include "engine/core/files.h"
#include "engine/geodata/geo_tiff.h"
#include "engine/survey/map_layers.h"
#include "engine/survey/map_pictures.h"
#include "engine/tools/analyze_json.h"
#include "engine/tools/analyze_report.h"

namespace palace {
namespace {

namespace fs = std::filesystem;

constexpr const char* kOverlay = "overlay.png";

Status WriteLayers(const AnalyzeOutcome& o, const fs::path& folder) {
  for (const DecidedLayer& layer : LayersOf(*o.decision)) {
    const MapLayer file{o.map().geometry, layer.cells, o.input.epsg};
    if (const Status done = WriteGeoTiff(folder / (layer.name + ".tif"), file); !done) {
      return done;
    }
    const Status drawn = WriteMapPicture(folder / (layer.name + ".png"), layer.cells,
                                         PictureOfLayer(layer.name, *o.decision));
    if (!drawn) {
      return drawn;
    }
  }
  return Ok();
}

Status WriteAll(const AnalyzeOutcome& o, const fs::path& folder) {
  if (const Status done = WriteLayers(o, folder); !done) {
    return done;
  }
  if (const Status done =
          WriteSafeLandingPicture(folder / "safe_landing.png", o.map(), o.hazards(), o.selection());
      !done) {
    return done;
  }
  if (o.input.pairs > 0) {
    const Status done = WriteOverlay(folder / kOverlay, *o.input.left, o.selection(),
                                     *o.input.range, *o.decision->verdict);
    if (!done) {
      return done;
    }
  }
  if (const Status report = WriteTextFile(folder / "report.html", AnalyzeReport(o, folder));
      !report) {
    return report;
  }
  return WriteTextFile(folder / "site.json", AnalyzeJson(o) + "\n");
}

}  // namespace

Status PublishAnalysis(const AnalyzeOutcome& o, const fs::path& out) {
  if (const Status made = MakeFolder(out); !made) {
    return UnavailableError("--out: " + made.error().message);
  }
  std::error_code error;
  const fs::path partial = out / ".analyze-partial";
  fs::remove_all(partial, error);
  if (!fs::create_directory(partial, error)) {
    return UnavailableError("cannot create " + partial.string() + ": " + error.message() +
                            "; choose a writable --out");
  }
  Status done = WriteAll(o, partial);
  if (done) {
    fs::remove(out / kOverlay, error);  // of an earlier pair; a map has none
    for (const auto& entry : fs::directory_iterator(partial, error)) {
      fs::rename(entry.path(), out / entry.path().filename(), error);
      if (error) {
        done = UnavailableError("cannot write " + (out / entry.path().filename()).string() + ": " +
                                error.message());
        break;
      }
    }
  }
  fs::remove_all(partial, error);
  return done;
}

}  // namespace palace
