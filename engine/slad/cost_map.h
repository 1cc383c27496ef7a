// Cost of a landing at a cell, 0 best to 1 forbidden.
#pragma once

namespace palace {

/// Thesis 4.6-4.10: 1 when slope or roughness is over its limit, else the normalised product. A
/// product is 0 when either term is (erratum E23): modern mode uses MaximumCost. NaN stays NaN.
float ProductCost(float slope_rad, float max_slope_rad, float roughness_m, float max_roughness_m);

/// The largest of the terms, each divided by its limit, at most 1. NaN when a term is NaN.
float MaximumCost(float slope_share, float roughness_share, float step_share);

}  // namespace palace
