// The figures and tables of the thesis (Hintze 2004) that show a result, and what answers them
// here.
#pragma once

#include <span>
#include <string_view>

namespace palace {

struct ThesisFigure {
  std::string_view figure;      ///< "Figure 3.7", "Table 4.5", "Section 4.3"
  std::string_view title;       ///< what it shows
  std::string_view found;       ///< what the thesis reports, in our words
  std::string_view experiment;  ///< of `palacectl evaluate`; empty: drawn, or by hand
  std::string_view pictures;    ///< number of the thesis's figure that is drawn anew; empty: none
  std::string_view differs;     ///< how ours differs from it; empty: as there
};

/// In the order of the thesis.
std::span<const ThesisFigure> ThesisFigures();

}  // namespace palace
