// The rows, columns and cell with which the map holds what the cameras see.
#pragma once

#include "engine/model/range_map.h"
#include "engine/model/settings/settings.h"

namespace palace {

/// Under bounds from the data, in modern mode. The cell doubles while the view (the median depth
/// times the wider angle of the picture) is more than twice as wide as the settings' map, 16 times
/// at most, and halves again once the view fits the smaller map with a fifth to spare. Of such
/// cells the map has as many rows and columns as the ground in view needs, in steps of 20, at least
/// the settings' and at most twice as many; it loses them again with a fifth to spare. Otherwise
/// all three are the settings'.
class ViewCell {
 public:
  /// The settings that fit this view, which has a pose. A range map without a point sets them back.
  SladSettings Fit(const RangeMap& range, const SladSettings& settings);

 private:
  int factor_ = 1;  ///< power of two on the settings' cell
  int rows_ = 0, cols_ = 0;
};

}  // namespace palace
