#include "engine/runtime/decision_hash.h"

#include "engine/core/hash.h"
#include "engine/model/camera_numbers.h"

namespace palace {
namespace {

void AddVector(ContentHash& hash, const Eigen::Vector3d& v) {
  hash.Add(v.x());
  hash.Add(v.y());
  hash.Add(v.z());
}

void AddEstimate(ContentHash& hash, const FilterStatus& filter) {
  hash.Add(filter.running);
  AddVector(hash, filter.estimate.p_WB);
  AddVector(hash, filter.estimate.v_WB);
}

void AddCamera(ContentHash& hash, const RigCamera& camera) {
  const PinholeCamera& p = camera.pinhole;
  hash.Add(p.width);
  hash.Add(p.height);
  for (const double value : {p.fx_px, p.fy_px, p.cx_px, p.cy_px}) {
    hash.Add(value);
  }
  for (const double value : camera.distortion) {
    hash.Add(value);
  }
  if (!camera.model) {
    return;
  }
  if (const auto* cahvor = std::get_if<CahvorModel>(&camera.model->lens)) {
    for (const auto* v : {&cahvor->C, &cahvor->A, &cahvor->H, &cahvor->V, &cahvor->O, &cahvor->R}) {
      AddVector(hash, *v);
    }
  } else {
    hash.Add(NumbersOf(*camera.model));
  }
}

}  // namespace

std::uint64_t DecisionHash(const EngineSnapshot& snapshot) {
  ContentHash hash;
  hash.Add(snapshot.time.us);
  hash.Add(snapshot.flight->mission.state);
  hash.Add(snapshot.session->settings_hash);
  if (snapshot.terrain->applied) {
    hash.Add(snapshot.terrain->applied->map_hash);
    for (const LandingSite& site : snapshot.terrain->applied->selection.sites) {
      hash.Add(site.letter);
      AddVector(hash, site.p_WS);
      hash.Add(site.cost);
      hash.Add(site.safe_distance_m);
    }
  }
  AddEstimate(hash, snapshot.flight->navigation.gps);
  AddEstimate(hash, snapshot.flight->navigation.vision);
  hash.Add(snapshot.flight->tracker.coherence);
  return hash.value();
}

std::uint64_t HashOf(const StereoRig& rig) {
  ContentHash hash;
  AddCamera(hash, rig.left);
  AddCamera(hash, rig.right);
  hash.Add(rig.baseline_m);
  hash.Add(rig.rectified);
  hash.Add(rig.tilt_rad);
  AddVector(hash, rig.position_body_m);
  return hash.value();
}

}  // namespace palace
