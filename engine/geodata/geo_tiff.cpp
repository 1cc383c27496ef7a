#include "engine/geodata/geo_tiff.h"

#include <geo_normalize.h>
#include <geotiffio.h>
#include <xtiffio.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/files.h"
#include "engine/core/plain_text.h"
#include "engine/core/text.h"

namespace palace {
namespace {

constexpr ttag_t kNoDataTag = 42113;  // GDAL's
constexpr int kMostCells = 8192;
constexpr double kLeastCell_m = 0.001, kMostCell_m = 1000;

struct CloseTiff {
  void operator()(TIFF* file) const { XTIFFClose(file); }
};
using TiffFile = std::unique_ptr<TIFF, CloseTiff>;

struct FreeGeoKeys {
  void operator()(GTIF* keys) const { GTIFFree(keys); }
};
using GeoKeys = std::unique_ptr<GTIF, FreeGeoKeys>;

void DeclareNoDataTag(TIFF* file) {
  static char name[] = "GDALNoDataValue";
  const TIFFFieldInfo info{kNoDataTag, -1, -1, TIFF_ASCII, FIELD_CUSTOM, 1, 0, name};
  TIFFMergeFieldInfo(file, &info, 1);
}

TiffFile OpenTiff(const std::filesystem::path& path, const char* mode) {
  TIFFSetWarningHandler(nullptr);
  TIFFSetErrorHandler(nullptr);
  return TiffFile(XTIFFOpen(path.c_str(), mode));
}

Error Broken(const std::filesystem::path& path, const std::string& what) {
  return InvalidError(path.string() + ": " + what);
}

/// How one sample is stored.
struct SampleType {
  std::uint16_t bits = 32;
  std::uint16_t format = SAMPLEFORMAT_UINT;
};

template <typename T>
double Load(const unsigned char* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return static_cast<double>(value);
}

/// The sample as a number; NaN for a type we do not read.
double LoadSample(const unsigned char* at, SampleType type) {
  switch (type.format * 100 + type.bits) {
    case SAMPLEFORMAT_IEEEFP * 100 + 32:
      return Load<float>(at);
    case SAMPLEFORMAT_IEEEFP * 100 + 64:
      return Load<double>(at);
    case SAMPLEFORMAT_INT * 100 + 8:
      return Load<std::int8_t>(at);
    case SAMPLEFORMAT_INT * 100 + 16:
      return Load<std::int16_t>(at);
    case SAMPLEFORMAT_INT * 100 + 32:
      return Load<std::int32_t>(at);
    case SAMPLEFORMAT_UINT * 100 + 8:
      return Load<std::uint8_t>(at);
    case SAMPLEFORMAT_UINT * 100 + 16:
      return Load<std::uint16_t>(at);
    case SAMPLEFORMAT_UINT * 100 + 32:
      return Load<std::uint32_t>(at);
    default:
      return std::nan("");
  }
}

/// Copies a decoded block into the grid, cropping what hangs over the rim.
void CopyBlock(const std::vector<unsigned char>& block, SampleType type, int row0, int col0,
               int block_cols, int block_rows, GridF& cells) {
  const std::size_t size = type.bits / 8;
  for (int r = 0; r < block_rows && row0 + r < cells.rows(); ++r) {
    for (int c = 0; c < block_cols && col0 + c < cells.cols(); ++c) {
      const auto index = static_cast<std::size_t>(r) * static_cast<std::size_t>(block_cols) +
                         static_cast<std::size_t>(c);
      cells.at(row0 + r, col0 + c) = static_cast<float>(LoadSample(&block[index * size], type));
    }
  }
}

bool ReadCells(TIFF* file, SampleType type, GridF& cells) {
  if (TIFFIsTiled(file) != 0) {
    std::uint32_t tile_cols = 0, tile_rows = 0;
    TIFFGetField(file, TIFFTAG_TILEWIDTH, &tile_cols);
    TIFFGetField(file, TIFFTAG_TILELENGTH, &tile_rows);
    if (tile_cols == 0 || tile_rows == 0 || tile_cols > kMostCells || tile_rows > kMostCells) {
      return false;
    }
    std::vector<unsigned char> tile(static_cast<std::size_t>(tile_cols) * tile_rows * type.bits /
                                    8);
    for (int r = 0; r < cells.rows(); r += static_cast<int>(tile_rows)) {
      for (int c = 0; c < cells.cols(); c += static_cast<int>(tile_cols)) {
        if (TIFFTileSize(file) != static_cast<tmsize_t>(tile.size()) ||
            TIFFReadTile(file, tile.data(), static_cast<std::uint32_t>(c),
                         static_cast<std::uint32_t>(r), 0, 0) < 0) {
          return false;
        }
        CopyBlock(tile, type, r, c, static_cast<int>(tile_cols), static_cast<int>(tile_rows),
                  cells);
      }
    }
    return true;
  }
  std::vector<unsigned char> line(static_cast<std::size_t>(cells.cols()) * type.bits / 8);
  if (TIFFScanlineSize(file) != static_cast<tmsize_t>(line.size())) {
    return false;
  }
  for (int r = 0; r < cells.rows(); ++r) {
    if (TIFFReadScanline(file, line.data(), static_cast<std::uint32_t>(r), 0) < 0) {
      return false;
    }
    CopyBlock(line, type, r, 0, cells.cols(), 1, cells);
  }
  return true;
}

/// GDAL's text as a number; nothing where it is none. Old Windows programs write NaN as "-1.#IND".
std::optional<float> NoDataOf(const std::string& text) {
  if (text.find("#IND") != std::string::npos || text.find("#QNAN") != std::string::npos) {
    return std::nanf("");
  }
  char* end = nullptr;
  const float value = std::strtof(text.c_str(), &end);
  return end == text.c_str() || *end != '\0' ? std::nullopt : std::optional<float>(value);
}

Status ReplaceNoData(const std::filesystem::path& path, TIFF* file, GridF& cells) {
  // libtiff does not know the tag and hands it out as an anonymous field, with its length.
  const TIFFField* field = TIFFFindField(file, kNoDataTag, TIFF_ANY);
  std::uint32_t length = 0;
  const char* text = nullptr;
  if (field == nullptr || TIFFFieldPassCount(field) == 0 ||
      TIFFFieldReadCount(field) != TIFF_VARIABLE2 ||
      TIFFGetField(file, kNoDataTag, &length, &text) == 0 || text == nullptr) {
    return Ok();
  }
  std::string told(text, length);
  told = told.substr(0, told.find('\0'));
  told.erase(told.find_last_not_of(" \t\r\n") + 1);
  if (told.empty()) {
    return Ok();
  }
  const std::optional<float> no_data = NoDataOf(told);
  if (!no_data) {
    constexpr std::size_t kShown = 40;
    return Broken(path, "its no-data value " + QuotedText(told, kShown) +
                            " is no number; correct it with gdal_edit.py -a_nodata");
  }
  for (float& cell : cells.cells()) {
    if (cell == *no_data) {
      cell = kUnknownValue;
    }
  }
  return Ok();
}

/// Corner and cell of a raster with its rows along the axes.
struct Placement {
  double cell_x = 0, cell_y = 0;
  double east = 0, north = 0;  ///< of the north-west corner
};

Result<Placement> ReadPlacement(const std::filesystem::path& path, TIFF* file) {
  std::uint16_t count = 0, tie_count = 0;
  double* values = nullptr;
  double* tie = nullptr;
  if (TIFFGetField(file, TIFFTAG_GEOTRANSMATRIX, &count, &values) != 0 && count >= 8) {
    if (values[1] != 0 || values[4] != 0) {
      return Broken(path,
                    "is rotated against north; turn it with gdalwarp -t_srs and its own system");
    }
    return Placement{values[0], -values[5], values[3], values[7]};
  }
  if (TIFFGetField(file, TIFFTAG_GEOPIXELSCALE, &count, &values) == 0 || count < 2 ||
      TIFFGetField(file, TIFFTAG_GEOTIEPOINTS, &tie_count, &tie) == 0 || tie_count < 6) {
    return Broken(path, "no GeoTIFF pixel scale and tie point; convert it with gdal_translate");
  }
  if (tie_count > 6) {
    return Broken(path, "is placed by several tie points; resample it with gdalwarp");
  }
  return Placement{values[0], values[1], tie[3] - tie[0] * values[0], tie[4] + tie[1] * values[1]};
}

bool IsFoot(unsigned short unit) { return unit >= Linear_Foot && unit <= Linear_Foot_Clarke; }

/// Metres both ways, or an error that says how to get there.
Status CheckUnits(const std::filesystem::path& path, GTIF* keys, const Placement& place) {
  unsigned short model = 0, unit = 0;
  const bool stated = GTIFKeyGet(keys, GTModelTypeGeoKey, &model, 0, 1) == 1;
  // A file that names no kind of system, lies on the globe and has cells of a few arc seconds.
  const bool like_degrees = !stated && place.cell_x < 0.01 && std::abs(place.east) <= 180 &&
                            std::abs(place.north) <= 90 && place.east != 0 && place.north != 0;
  if (model == ModelTypeGeographic || like_degrees) {
    return Broken(path, "is in degrees; project it to metres with gdalwarp -t_srs");
  }
  GTIFDefn definition;
  const bool defined = GTIFGetDefn(keys, &definition) != 0;
  if ((GTIFKeyGet(keys, ProjLinearUnitsGeoKey, &unit, 0, 1) == 1 && IsFoot(unit)) ||
      (defined && definition.UOMLengthInMeters > 0 &&
       std::abs(definition.UOMLengthInMeters - 1) > 1e-6)) {
    return Broken(path, "is in feet or another unit; project it to metres with gdalwarp -t_srs");
  }
  if (GTIFKeyGet(keys, VerticalUnitsGeoKey, &unit, 0, 1) == 1 && IsFoot(unit)) {
    return Broken(path,
                  "has heights in feet; multiply them by 0.3048 with gdal_calc.py and name metres");
  }
  return Ok();
}

/// Place and coordinate system from the GeoTIFF tags.
Status ReadPlace(const std::filesystem::path& path, TIFF* file, MapLayer& layer) {
  const auto place = ReadPlacement(path, file);
  if (!place) {
    return place.error();
  }
  if (!std::isfinite(place->east) || !std::isfinite(place->north)) {
    return Broken(path, "its corner is not a finite place; write its tags anew with gdal_edit.py");
  }
  if (!(std::abs(place->east) <= kFarthestPlace_m && std::abs(place->north) <= kFarthestPlace_m)) {
    return Broken(path, WithNumbers("its corner lies at east %g m, north %g m; places lie within "
                                    "130 000 km of their origin, write its tags anew with "
                                    "gdal_edit.py -a_ullr",
                                    place->east, place->north));
  }
  if (!(place->cell_x > 0) || !(std::abs(place->cell_x - place->cell_y) <= 1e-3 * place->cell_x)) {
    return Broken(path, "cells are not square, north up; resample it with gdalwarp -tr");
  }
  const GeoKeys keys(GTIFNew(file));
  if (keys) {
    if (const Status metres = CheckUnits(path, keys.get(), *place); !metres) {
      return metres;
    }
  }
  if (!(place->cell_x >= kLeastCell_m && place->cell_x <= kMostCell_m)) {
    return Broken(path,
                  "its cells are not between 0.001 and 1000 m; resample it with gdalwarp -tr");
  }
  layer.geometry.cell_m = place->cell_x;
  double east_m = place->east, north_m = place->north;
  unsigned short value = 0;
  if (keys && GTIFKeyGet(keys.get(), GTRasterTypeGeoKey, &value, 0, 1) == 1 &&
      value == RasterPixelIsPoint) {
    east_m -= place->cell_x / 2;
    north_m += place->cell_x / 2;
  }
  if (keys && GTIFKeyGet(keys.get(), ProjectedCSTypeGeoKey, &value, 0, 1) == 1 &&
      value != KvUserDefined) {
    layer.epsg = value;
  }
  layer.geometry.east_min_m = east_m;
  layer.geometry.north_min_m = north_m - layer.geometry.rows * place->cell_x;
  return Ok();
}

}  // namespace

Status WriteGeoTiff(const std::filesystem::path& path, const MapLayer& layer) {
  const TiffFile file = OpenTiff(path, "w");
  if (!file) {
    return UnavailableError("cannot write " + path.string() + ": is the folder writable?");
  }
  TIFF* tiff = file.get();
  DeclareNoDataTag(tiff);
  const GridGeometry& g = layer.geometry;
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, static_cast<std::uint32_t>(g.cols));
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, static_cast<std::uint32_t>(g.rows));
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 1);
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 32);
  TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_IEEEFP);
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
  TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
  TIFFSetField(tiff, TIFFTAG_ZIPQUALITY,
               1);  // floats barely shrink further, at three times the time
  TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 64U);
  TIFFSetField(tiff, kNoDataTag, "nan");
  const double scale[3] = {g.cell_m, g.cell_m, 0};
  const double tie[6] = {0, 0, 0, g.east_min_m, g.north_max_m(), 0};
  TIFFSetField(tiff, TIFFTAG_GEOPIXELSCALE, 3, scale);
  TIFFSetField(tiff, TIFFTAG_GEOTIEPOINTS, 6, tie);
  const GeoKeys keys(GTIFNew(tiff));
  GTIFKeySet(keys.get(), GTModelTypeGeoKey, TYPE_SHORT, 1, ModelTypeProjected);
  GTIFKeySet(keys.get(), GTRasterTypeGeoKey, TYPE_SHORT, 1, RasterPixelIsArea);
  GTIFKeySet(keys.get(), ProjectedCSTypeGeoKey, TYPE_SHORT, 1, layer.epsg.value_or(KvUserDefined));
  GTIFKeySet(keys.get(), ProjLinearUnitsGeoKey, TYPE_SHORT, 1, Linear_Meter);
  bool good = GTIFWriteKeys(keys.get()) != 0;
  std::vector<float> line(static_cast<std::size_t>(g.cols));
  for (int r = 0; r < g.rows && good; ++r) {
    std::copy(layer.cells.row(r), layer.cells.row(r) + g.cols, line.begin());
    good = TIFFWriteScanline(tiff, line.data(), static_cast<std::uint32_t>(r), 0) >= 0;
  }
  if (!good || TIFFFlush(tiff) == 0) {
    return UnavailableError("cannot write " + path.string() + ": is the disk full?");
  }
  return Ok();
}

Result<MapLayer> ReadGeoTiff(const std::filesystem::path& path,
                             const std::function<Status(const GridGeometry&)>& room) {
  if (const Status regular = CheckRegularFile(path); !regular) {
    return regular.error();
  }
  const TiffFile file = OpenTiff(path, "r");
  if (!file) {
    return Broken(path,
                  "is not a TIFF file, or cut off at its start; convert it with "
                  "gdal_translate -of GTiff");
  }
  std::uint32_t cols = 0, rows = 0;
  std::uint16_t samples = 1;
  SampleType type;
  TIFFGetField(file.get(), TIFFTAG_IMAGEWIDTH, &cols);
  TIFFGetField(file.get(), TIFFTAG_IMAGELENGTH, &rows);
  TIFFGetFieldDefaulted(file.get(), TIFFTAG_SAMPLESPERPIXEL, &samples);
  TIFFGetFieldDefaulted(file.get(), TIFFTAG_BITSPERSAMPLE, &type.bits);
  TIFFGetFieldDefaulted(file.get(), TIFFTAG_SAMPLEFORMAT, &type.format);
  if (cols == 0 || rows == 0 || cols > kMostCells || rows > kMostCells) {
    return Broken(path, std::to_string(cols) + " x " + std::to_string(rows) +
                            " cells; the limit is 8192 a side, cut it with gdal_translate -srcwin");
  }
  const unsigned char zeros[8] = {};
  if (samples != 1 || std::isnan(LoadSample(zeros, type))) {
    return Broken(path,
                  "not a one-band elevation model of a plain number type; convert it with "
                  "gdal_translate -b 1 -ot Float32");
  }
  MapLayer layer;
  layer.geometry.rows = static_cast<int>(rows);
  layer.geometry.cols = static_cast<int>(cols);
  if (const Status place = ReadPlace(path, file.get(), layer); !place) {
    return place.error();
  }
  if (const Status fits = room ? room(layer.geometry) : Ok(); !fits) {
    return Error{fits.error().code, path.string() + ": " + fits.error().message};
  }
  layer.cells = GridF(layer.geometry.rows, layer.geometry.cols, kUnknownValue);
  if (!ReadCells(file.get(), type, layer.cells)) {
    return Broken(path, "is damaged or compressed in a way libtiff cannot read");
  }
  if (const Status replaced = ReplaceNoData(path, file.get(), layer.cells); !replaced) {
    return replaced.error();
  }
  return layer;
}

}  // namespace palace
