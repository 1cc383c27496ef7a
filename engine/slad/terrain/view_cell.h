// The cell with which the map holds what the cameras see.
#pragma once

#include "engine/model/range_map.h"
#include "engine/model/settings/settings.h"

namespace palace {

/// Under bounds from the data, in modern mode, the cell doubles while the view (the median depth
/// times the wider angle of the picture) is more than twice as wide as the map, 16 times at most,
/// and halves again once the view fits the smaller map with a fifth to spare. Otherwise the cell is
/// the settings'.
class ViewCell {
 public:
  /// The settings with the cell that fits this view. A range map without a point sets the cell
  /// back.
  SladSettings Fit(const RangeMap& range, const SladSettings& settings);

 private:
  int factor_ = 1;  ///< power of two on the settings' cell
};

}  // namespace palace
