// What a log tells of its flight before it is played: states, sites, maps, refusals, touchdown,
// silences.
#include "tests/journal/replay_flight.h"

namespace palace {
namespace {

TEST_F(ReplayTest, TellsWhatTheFlightDecided) {
  const auto record = Open(Fast())->recorded();
  ASSERT_EQ(record->samples.size(), flight_.items.size());
  for (std::size_t i = 0; i < record->samples.size(); ++i) {
    const EngineSnapshot& snapshot = *flight_.items[i].snapshot;
    EXPECT_EQ(record->samples[i].state, snapshot.flight->mission.state);
    EXPECT_EQ(record->samples[i].decision_hash, snapshot.decision_hash);
    EXPECT_EQ(record->samples[i].best_site, "C");
  }
  EXPECT_EQ(record->events.size(), flight_.items.size());
  EXPECT_TRUE(record->has_settings);
  ASSERT_EQ(record->settings.size(), 1u);
  EXPECT_EQ(record->settings[0].settings, record->settings_at_start);
  EXPECT_EQ(record->settings_at_start, flight_.items[0].snapshot->session->settings);
  EXPECT_NEAR(record->duration_s, 1.1, 1e-9);
}

TEST_F(ReplayTest, TellsGapsAndWhatEachMapProposed) {
  auto record = Open(Fast())->recorded();
  EXPECT_TRUE(record->gaps.empty());
  ASSERT_FALSE(record->proposals.empty());
  const auto& sites = flight_.items[0].snapshot->terrain->applied->selection.sites;
  ASSERT_EQ(record->proposals[0].places.size(), sites.size());
  for (std::size_t i = 0; i < sites.size(); ++i) {
    EXPECT_EQ(record->proposals[0].places[i].letter, sites[i].letter);
    EXPECT_EQ(record->proposals[0].places[i].id, sites[i].id);
    EXPECT_EQ(record->proposals[0].places[i].north_east_m, sites[i].p_WS.head<2>());
    EXPECT_EQ(record->proposals[0].places[i].safe_distance_m, sites[i].safe_distance_m);
    EXPECT_EQ(record->proposals[0].places[i].slope_rad.value, sites[i].slope_rad.value);
    EXPECT_EQ(record->proposals[0].places[i].slope_rad.three_sigma, sites[i].slope_rad.three_sigma);
    EXPECT_EQ(record->proposals[0].places[i].roughness_m.value, sites[i].roughness_m.value);
    EXPECT_EQ(record->proposals[0].places[i].roughness_m.three_sigma,
              sites[i].roughness_m.three_sigma);
  }
}

/// Forty bundles, 0.1 s apart. B is refused in number 1; a refusal in number 3 is not taken. A is
/// selected in number 2, looked at from 4 and approved in number 5; from number 7 on the vehicle
/// stands on the ground and no map is made. From number 10 to 29 bundles come in which nothing was
/// heard.
class LandedFlight : public JournalTest {
 protected:
  static constexpr int kBundles = 40;
  LandedFlight() {
    RandomStream random(71);
    const auto rig = std::make_shared<const StereoRig>(RandomRig(random));
    auto recorder = FlightRecorder::Open(folder_, "flight", {});
    EXPECT_TRUE(recorder.ok());
    auto events = std::make_shared<std::vector<Event>>();
    for (int i = 0; i < kBundles; ++i) {
      RecordItem item;
      auto bundle = RandomBundle(random, static_cast<std::uint64_t>(i), rig);
      if (i >= 10 && i < 30) {
        bundle->stereo = nullptr;
        bundle->pose_at_exposure.reset();
        bundle->poses.clear();
        bundle->imu.clear();
        bundle->truth.clear();
        bundle->laser.clear();
        bundle->gps.clear();
        bundle->status.reset();
      }
      const auto say = [&](const char* text) {
        events->push_back({bundle->time, EventKind::kDecision, text, events->size() + 1});
      };
      if (i == 1) {
        item.commands.push_back({CommandOrigin::kOperator, RefuseSite{2}});
        say("Site B refused by the operator");
      } else if (i == 2) {
        item.commands.push_back({CommandOrigin::kOperator, SelectSite{1}});
      } else if (i == 3) {
        item.commands.push_back({CommandOrigin::kOperator, RefuseSite{1}});
        say("Refuse refused: No site is proposed");
      } else if (i == 4) {
        item.commands.push_back({CommandOrigin::kOperator, LookAtSite{1, 3, 12}});
        say("Look at site A from 12 m approved");
      } else if (i == 5) {
        item.commands.push_back({CommandOrigin::kOperator, ApproveSite{1, 4}});
        say("Site A approved");
      }
      auto snapshot = std::make_shared<EngineSnapshot>(RandomSnapshot(random, *bundle));
      auto decision = std::make_shared<TerrainDecision>(*snapshot->terrain->applied);
      decision->selection.sites[0].id = 1;
      decision->selection.sites[1].id = 2;
      decision->selection.sites[0].p_WS = p_WS_;
      decision->map_time = i < 7 ? bundle->time : map_time_;
      decision->map_hash = 5;
      map_time_ = decision->map_time;
      snapshot->terrain.Edit().applied = decision;
      MissionStatus& mission = snapshot->flight.Edit().mission;
      mission.state = i < 2   ? MissionState::kProposed
                      : i < 4 ? MissionState::kArmed
                      : i < 7 ? MissionState::kDescending
                              : MissionState::kLanded;
      mission.distance_to_site_m = 0.1 * i;
      snapshot->session.Edit().events = std::make_shared<const std::vector<Event>>(*events);
      if (i == 7) {
        const Eigen::Vector3d skid_W =
            bundle->truth.back().X_WB * Settings{}.slad.lander.skid_centre_B();
        true_miss_m_ = (skid_W - p_WS_).head<2>().norm();
      }
      item.bundle = bundle;
      item.snapshot = snapshot;
      times_.push_back(bundle->time);
      EXPECT_TRUE((*recorder)->Record(item).ok());
    }
    EXPECT_TRUE((*recorder)->Close().ok());
    auto source = ReplaySource::Open((*recorder)->Path());
    EXPECT_TRUE(source.ok());
    record_ = (*source)->recorded();
  }
  const Eigen::Vector3d p_WS_{1, 2, 0};
  Timestamp map_time_;
  double true_miss_m_ = NAN;
  std::vector<Timestamp> times_;
  std::shared_ptr<const FlightRecord> record_;
};

TEST_F(LandedFlight, TellsItsTouchdownByTheStationAndByTruth) {
  ASSERT_EQ(record_->touchdowns.size(), 1U);
  EXPECT_EQ(record_->touchdowns[0].time, times_[7]);
  EXPECT_NEAR(record_->touchdowns[0].miss_m, 0.7, 1e-12);
  EXPECT_NEAR(record_->touchdowns[0].true_miss_m, true_miss_m_, 1e-9);
}

TEST_F(LandedFlight, TellsWhatTheOperatorRefusedAndTheStationTook) {
  ASSERT_EQ(record_->refusals.size(), 1U);
  EXPECT_EQ(record_->refusals[0].from, times_[1]);
  EXPECT_EQ(record_->refusals[0].site_ids, std::vector<std::uint64_t>{2});
}

TEST_F(LandedFlight, TellsALookFromALanding) {
  for (std::size_t i = 0; i < kBundles; ++i) {
    EXPECT_EQ(record_->samples[i].stop_height_m, i == 4 ? 12 : 0) << i;
  }
}

TEST_F(LandedFlight, TellsWithWhichBundlesAMapCame) {
  for (int i = 0; i < kBundles; ++i) {
    EXPECT_EQ(record_->samples[static_cast<std::size_t>(i)].new_map, i < 7) << i;
  }
}

TEST_F(LandedFlight, TellsWhenItHeardEachChannelAndASilenceThoughBundlesCame) {
  const auto& left = record_->heard[static_cast<std::size_t>(ChannelId::kCameraLeft)];
  ASSERT_EQ(left.size(), 20U);
  EXPECT_EQ(left[9], times_[9]);
  EXPECT_EQ(left[10], times_[30]);
  ASSERT_EQ(record_->gaps.size(), 1U);
  EXPECT_NEAR(record_->gaps[0].from_s, 0.9, 1e-9);
  EXPECT_NEAR(record_->gaps[0].to_s, 3.0, 1e-9);
}

}  // namespace
}  // namespace palace
