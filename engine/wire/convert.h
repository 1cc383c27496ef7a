// Messages from and to the engine's vocabulary. Encoding always works; decoding any bytes gives a
// value or an Error and never allocates more than the bytes it was given justify.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/model/flight_record.h"
#include "engine/model/frame_bundle.h"
#include "engine/model/grid.h"
#include "engine/model/snapshot.h"
#include "engine/wire/bundle_assembler.h"
#include "engine/wire/channels.h"
#include "engine/wire/wire_message.h"

namespace palace {

/// The whole bundle but its recorded_commands, in fixed order, CAMERA_RIG last: it closes the
/// bundle. Every message carries the bundle's time. Pictures are raw grey, rotations exact: a
/// BundleAssembler gives back the same bits.
std::vector<WireMessage> EncodeBundle(const FrameBundle& bundle, const ChannelNames& channels);

WireMessage EncodeVehicleMessage(const VehicleMessage& message, Timestamp now,
                                 const ChannelNames& channels);
/// From COMMAND, POSITION_ESTIMATE, SESSION_REQUEST or ABORT. A healthy estimate must be finite;
/// numbers of an approval need not: who checks it says which is not.
Result<VehicleMessage> DecodeVehicleMessage(const WireMessage& message,
                                            const ChannelNames& channels);

/// The vehicle's answer to a command.
WireMessage EncodeAck(const CommandAck& ack, const ChannelNames& channels);

WireMessage EncodeCommand(const EngineCommand& command, Timestamp now,
                          const ChannelNames& channels);
Result<EngineCommand> DecodeCommand(const WireMessage& message);

WireMessage EncodeEvent(const Event& event, const ChannelNames& channels);
Result<Event> DecodeEvent(const WireMessage& message);

WireMessage EncodeSettings(const Settings& settings, Timestamp now, const ChannelNames& channels);
/// A setting this program does not know, or whose value is out of range, is an Error naming it.
Result<Settings> DecodeSettings(const WireMessage& message);

/// The sites of one map with the hashes they were decided under.
struct SiteProposal {
  Timestamp time;
  Timestamp map_time;
  std::uint64_t map_hash = 0;
  std::uint64_t settings_hash = 0;
  GridGeometry grid;  ///< of the map, which `cell` of each site counts in; no rows without a map
  SiteSelection selection;
};
WireMessage EncodeProposal(const TerrainDecision& decision, Timestamp now,
                           const ChannelNames& channels);
Result<SiteProposal> DecodeProposal(const WireMessage& message);

/// Without features and patches: those are for the screen.
WireMessage EncodeTracker(const TrackerStatus& status, const ChannelNames& channels);
Result<TrackerStatus> DecodeTracker(const WireMessage& message);

WireMessage EncodeStationStatus(const EngineSnapshot& snapshot, const ChannelNames& channels);
Result<FlightRecordSample> DecodeStationStatus(const WireMessage& message);

/// MISSION: state, site and approval as the vehicle's crew may show them.
WireMessage EncodeMission(const EngineSnapshot& snapshot, const ChannelNames& channels);

/// REFUSED: what was not let in, for the record. `now` is the time of its bundle.
WireMessage EncodeRefused(const RefusedDatagram& refused, Timestamp now,
                          const ChannelNames& channels);
Result<RefusedDatagram> DecodeRefused(const WireMessage& message);

/// True position from TRUTH.
Result<Truth> DecodeTruth(const WireMessage& message);

}  // namespace palace
