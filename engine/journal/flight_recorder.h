// FlightRecorder: writes `<folder>/<stamp>/flight.lcm`, what passed the doors of the engine.
//
// Per pass, in this order: the commands that were applied before the bundle (SITE_DECISION), the
// bundle (CAMERA_RIG last), what was sent to the vehicle, then the outputs (STATION_STATUS last).
// Everything carries the bundle's time; what was said between two bundles that of the older one.
//
// Written means: handed to the operating system, so that the death of this program loses nothing;
// every 6 MiB, about once a second, it is brought to the disk, for the loss of power. A pass is
// written whole or not at all. While the disk fills, RecordSpace says which pictures stay; what it
// set aside at the start is given back when the disk is full, for telemetry and decisions. When
// nothing can be written, decisions wait in memory, and it is tried again every second; when there
// are more than it holds, notes of events go before settings, and settings before commands.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/journal/log_writer.h"
#include "engine/journal/record_space.h"
#include "engine/runtime/record_sink.h"
#include "engine/wire/channels.h"
#include "engine/wire/output_encoder.h"

namespace palace {

class FlightRecorder final : public RecordSink {
 public:
  /// A flight in which nothing was heard, sent or told leaves no file and no folder behind.
  /// `stamp` names the flight, e.g. "2026-03-01_14-02-11"; the caller knows the time, this does
  /// not.
  static Result<std::unique_ptr<FlightRecorder>> Open(const std::filesystem::path& folder,
                                                      const std::string& stamp,
                                                      ChannelNames channels = {},
                                                      const Disk& disk = SystemDisk());
  ::palace::Status Record(const RecordItem& item) override;
  ::palace::Status Close() override;
  std::string Path() const override;
  RecordState State() const override;

 private:
  using Messages = std::vector<WireMessage>;
  FlightRecorder(LogWriter writer, ChannelNames channels, const Disk& disk);
  void Hear(const RecordItem& item);
  void Before(const RecordItem& item, Messages& messages);
  void After(const RecordItem& item, Messages& messages);
  ::palace::Status TryRecord(const RecordItem& item, Messages& before, Messages& after);
  ::palace::Status WritePass(const RecordItem& item, Messages before, const Messages& after);
  ::palace::Status WriteAll(const Messages& before, const FrameBundle* bundle, bool pictures,
                            const Messages& after);
  ::palace::Status WriteEach(const Messages& before, const FrameBundle* bundle, bool pictures,
                             const Messages& after);
  void Count(const FrameBundle& bundle, bool pictures);
  void Stop(const std::string& problem);
  void Miss(Messages& before, Messages& after);
  void Keep(WireMessage message);
  int RankOf(const WireMessage& message) const;
  bool MayTryAgain();
  Messages TakeMissed();
  bool KeepsPictures(const FrameBundle& bundle);
  void Thin(Messages& before);
  WireMessage Told(const std::string& text) const;

  LogWriter writer_;
  ChannelNames channels_;
  const Disk& disk_;
  OutputEncoder outputs_;
  Timestamp last_;
  bool any_ = false;                    ///< something was heard: there is a time
  std::vector<EngineCommand> waiting_;  ///< given before that: they go before the first bundle

  double step_s_ = 0;               ///< from bundle to bundle
  std::uint64_t bytes_before_ = 0;  ///< of log and sidecar, when the rate was counted last
  RecordSpace space_;
  SpaceReserve reserve_;
  std::uint64_t pairs_ = 0;
  std::uint64_t pairs_left_out_ = 0;  ///< for want of space
  std::uint64_t pairs_too_slow_ = 0;  ///< not told in the log yet
  Timestamp told_slow_;

  std::string problem_;  ///< why nothing is written
  Timestamp stopped_at_;
  Timestamp tried_at_;
  Messages missed_;                   ///< decisions, until they can be written
  std::uint64_t missed_dropped_ = 0;  ///< more than memory holds
  std::uint64_t passes_missed_ = 0;
};

}  // namespace palace
