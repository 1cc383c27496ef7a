#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/wire/convert.h"
#include "engine/wire/wire_fields.h"
#include "engine/wire/wire_pack.h"

namespace palace {
namespace {

void PackFigure(const Figure& figure, double (&out)[2]) {
  out[0] = figure.value;
  out[1] = figure.three_sigma;
}
Figure UnpackFigure(const double (&in)[2]) { return {in[0], in[1]}; }

site_t SiteToWire(const LandingSite& s) {
  site_t m{};
  m.id = WireId(s.id);
  m.letter = s.letter;
  m.map_utime = s.map_time.us;
  m.row = s.cell.row;
  m.col = s.cell.col;
  Pack(s.p_WS, m.pos);
  Pack(s.normal_W, m.normal);
  Pack(s.pixel, m.pixel);
  PackFigure(s.slope_rad, m.slope_rad);
  PackFigure(s.roughness_m, m.roughness_m);
  PackFigure(s.step_m, m.step_m);
  PackFigure(s.height_m, m.height_m);
  m.safe_distance_m = s.safe_distance_m;
  m.clear_radius_m = s.clear_radius_m;
  m.clearance_m = s.clearance_m;
  m.cost = s.cost;
  m.safe_probability = s.safe_probability;
  m.touchdown_worst[0] = s.touchdown.worst_probability;
  m.touchdown_worst[1] = s.touchdown.worst_heading_rad;
  m.touchdown_best[0] = s.touchdown.best_probability;
  m.touchdown_best[1] = s.touchdown.best_heading_rad;
  m.flags = s.flags;
  m.unknown_cells = s.unknown_cells;
  m.frames_fused = s.frames_fused;
  m.confirmed = s.confirmed;
  m.newest_confirms = s.newest_confirms;
  m.corridor_clear = s.corridor_clear;
  m.clear_approaches = s.clear_approaches;
  m.age_s = s.age_s;
  m.distance_m = s.distance_m;
  m.reason = s.reason;
  return m;
}

LandingSite SiteFromWire(const site_t& m) {
  LandingSite s;
  s.id = IdFromWire(m.id);
  s.letter = m.letter;
  s.map_time = {m.map_utime};
  s.cell = {m.row, m.col};
  s.p_WS = Unpack(m.pos);
  s.normal_W = Unpack(m.normal);
  s.pixel = Unpack(m.pixel);
  s.slope_rad = UnpackFigure(m.slope_rad);
  s.roughness_m = UnpackFigure(m.roughness_m);
  s.step_m = UnpackFigure(m.step_m);
  s.height_m = UnpackFigure(m.height_m);
  s.safe_distance_m = m.safe_distance_m;
  s.clear_radius_m = m.clear_radius_m;
  s.clearance_m = m.clearance_m;
  s.cost = m.cost;
  s.safe_probability = m.safe_probability;
  s.touchdown = {m.touchdown_worst[0], m.touchdown_worst[1], m.touchdown_best[0],
                 m.touchdown_best[1]};
  s.flags = static_cast<std::uint8_t>(m.flags);
  s.unknown_cells = m.unknown_cells;
  s.frames_fused = m.frames_fused;
  s.confirmed = m.confirmed != 0;
  s.newest_confirms = m.newest_confirms != 0;
  s.corridor_clear = m.corridor_clear != 0;
  s.clear_approaches = static_cast<std::uint8_t>(m.clear_approaches);
  s.age_s = m.age_s;
  s.distance_m = m.distance_m;
  s.reason = m.reason;
  return s;
}

}  // namespace

WireMessage EncodeProposal(const TerrainDecision& decision, Timestamp now,
                           const ChannelNames& channels) {
  site_proposal_t m{};
  m.utime = now.us;
  m.map_utime = decision.map_time.us;
  m.map_hash = WireId(decision.map_hash);
  m.settings_hash = WireId(decision.settings_hash);
  if (decision.hazards) {
    const GridGeometry& grid = decision.hazards->geometry;
    m.grid_rows = grid.rows;
    m.grid_cols = grid.cols;
    m.grid_cell_m = grid.cell_m;
    m.grid_north_min_m = grid.north_min_m;
    m.grid_east_min_m = grid.east_min_m;
  }
  for (const LandingSite& site : decision.selection.sites) {
    m.sites.push_back(SiteToWire(site));
  }
  m.count = static_cast<std::int32_t>(m.sites.size());
  m.none_reason = decision.selection.none_reason;
  return MakeMessage(channels.site_proposal, now, m);
}

Result<SiteProposal> DecodeProposal(const WireMessage& message) {
  return DecodeAnd<site_proposal_t>(message, [](const site_proposal_t& m) -> Result<SiteProposal> {
    SiteProposal proposal{
        {m.utime}, {m.map_utime}, IdFromWire(m.map_hash), IdFromWire(m.settings_hash), {}, {}};
    proposal.grid = {m.grid_rows, m.grid_cols, m.grid_cell_m, m.grid_north_min_m,
                     m.grid_east_min_m};
    if (m.grid_rows < 0 || m.grid_cols < 0) {
      return InvalidError(
          WithNumbers("grid_rows = %.0f, grid_cols = %.0f of a proposal: neither may be negative",
                      m.grid_rows, m.grid_cols));
    }
    if (!std::isfinite(m.grid_cell_m) || !std::isfinite(m.grid_north_min_m) ||
        !std::isfinite(m.grid_east_min_m)) {
      return InvalidError(
          WithNumbers("grid_cell_m = %g, grid_north_min_m = %g, grid_east_min_m = %g of a "
                      "proposal: each must be finite",
                      m.grid_cell_m, m.grid_north_min_m, m.grid_east_min_m));
    }
    for (const site_t& site : m.sites) {
      proposal.selection.sites.push_back(SiteFromWire(site));
      if (!proposal.selection.sites.back().p_WS.allFinite()) {
        return InvalidError("pos of site " + std::to_string(proposal.selection.sites.size()) +
                            " of a proposal is not finite");
      }
    }
    proposal.selection.none_reason = m.none_reason;
    return proposal;
  });
}

WireMessage EncodeTracker(const TrackerStatus& status, const ChannelNames& channels) {
  tracker_status_t m{};
  m.utime = status.time.us;
  m.locked = status.locked;
  m.mode = status.mode;
  m.coherence = status.coherence;
  Pack(status.site_pixel, m.site_pixel);
  m.site_in_picture = status.site_in_picture;
  m.inliers = status.inliers;
  m.keyframes = status.keyframes;
  m.anchor_height_m = status.anchor_height_m;
  Pack(status.window_centre, m.window_centre);
  m.window_side_px = status.window_side_px;
  return MakeMessage(channels.tracker_status, status.time, m);
}

Result<TrackerStatus> DecodeTracker(const WireMessage& message) {
  return DecodeAnd<tracker_status_t>(message,
                                     [](const tracker_status_t& m) -> Result<TrackerStatus> {
                                       TrackerStatus status;
                                       status.time = {m.utime};
                                       status.locked = m.locked != 0;
                                       status.mode = m.mode;
                                       status.coherence = m.coherence;
                                       status.site_pixel = Unpack(m.site_pixel);
                                       status.site_in_picture = m.site_in_picture != 0;
                                       status.inliers = m.inliers;
                                       status.keyframes = m.keyframes;
                                       status.anchor_height_m = m.anchor_height_m;
                                       status.window_centre = Unpack(m.window_centre);
                                       status.window_side_px = m.window_side_px;
                                       return status;
                                     });
}

WireMessage EncodeStationStatus(const EngineSnapshot& snapshot, const ChannelNames& channels) {
  station_status_t m{};
  m.utime = snapshot.time.us;
  m.sequence = WireId(snapshot.sequence);
  m.state = static_cast<std::int8_t>(snapshot.flight->mission.state);
  m.settings_hash = WireId(snapshot.session->settings_hash);
  m.decision_hash = WireId(snapshot.decision_hash);
  m.best_safe_distance_m = NAN;
  const TerrainDecision* map = snapshot.terrain->applied.get();
  const LandingSite* best =
      map != nullptr ? snapshot.flight->mission.BestStanding(map->selection.sites) : nullptr;
  if (best != nullptr) {
    m.best_site = best->letter;
    m.best_safe_distance_m = best->safe_distance_m;
  }
  m.height_above_site_m = snapshot.flight->mission.height_above_site_m;
  m.distance_to_site_m = snapshot.flight->mission.distance_to_site_m;
  m.height_m = snapshot.sensors->pose ? HeightFromDown(snapshot.sensors->pose->X_WB.p.z()) : NAN;
  for (const Alarm& alarm : snapshot.flight->mission.alarms) {
    m.alarms += alarm.active ? 1 : 0;
  }
  m.vision_in_force = snapshot.flight->navigation.OnVision();
  return MakeMessage(channels.station_status, snapshot.time, m);
}

Result<FlightRecordSample> DecodeStationStatus(const WireMessage& message) {
  return DecodeAnd<station_status_t>(
      message, [](const station_status_t& m) -> Result<FlightRecordSample> {
        if (m.state < 0 || m.state > static_cast<int>(MissionState::kLanded)) {
          return InvalidError("mission state " + std::to_string(m.state) + " is not one of 0..8");
        }
        FlightRecordSample sample;
        sample.time = {m.utime};
        sample.sequence = IdFromWire(m.sequence);
        sample.state = static_cast<MissionState>(m.state);
        sample.settings_hash = IdFromWire(m.settings_hash);
        sample.decision_hash = IdFromWire(m.decision_hash);
        sample.best_site = m.best_site;
        sample.best_safe_distance_m = m.best_safe_distance_m;
        sample.height_above_site_m = m.height_above_site_m;
        sample.distance_to_site_m = m.distance_to_site_m;
        sample.height_m = m.height_m;
        sample.alarms = m.alarms;
        sample.vision_in_force = m.vision_in_force != 0;
        return sample;
      });
}

WireMessage EncodeMission(const EngineSnapshot& snapshot, const ChannelNames& channels) {
  const MissionStatus& mission = snapshot.flight->mission;
  const Settings& settings = snapshot.session->settings;
  mission_t m{};
  m.utime = snapshot.time.us;
  m.state = static_cast<std::int8_t>(mission.state);
  m.since_utime = mission.since.us;
  m.why = mission.why;
  std::fill(m.site_pos, m.site_pos + 3, NAN);
  if (mission.armed) {
    m.site_id = WireId(mission.armed->id);
    Pack(mission.armed->p_WS, m.site_pos);
  }
  m.approval_id = mission.approval ? WireId(mission.approval->id) : 0;
  m.glide_slope_rad =
      mission.approach ? mission.approach->glide_slope_rad : Rad(settings.mission.glide_slope_deg);
  m.descent_rate_mps =
      mission.approach ? mission.approach->descent_rate_mps : settings.mission.descent_rate_mps;
  m.commit_height_m = settings.slad.fusion.commit_height_m;
  return MakeMessage(channels.mission, snapshot.time, m);
}

}  // namespace palace
