// Pieces shared by the two modes of hazard evaluation. Internal to the SLAD room.
#pragma once

#include "engine/model/elevation_map.h"
#include "engine/model/hazard_maps.h"
#include "engine/model/settings.h"

namespace palace {

/// All layers unknown, all reasons none.
HazardMaps UnknownHazards(const GridGeometry& geometry);

/// Angle between the up vector and the normal of a plane with these gradients, radians (E21).
double SlopeOfGradient(double north_gradient, double east_gradient, const Eigen::Vector3d& up_W);

/// Fill every layer of `hazards` but distance and counts.
void EvaluateThesis(const ElevationMap& map, const SladSettings& settings, HazardMaps& hazards);
void EvaluateModern(const ElevationMap& map, const SladSettings& settings, HazardMaps& hazards);

/// Whether the lander's footprint centred on the cell keeps every limit of its mode.
bool FootprintHolds(const HazardMaps& hazards, const SladSettings& settings, Cell cell);

}  // namespace palace
