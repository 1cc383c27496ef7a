// The consensus of several trackers, by hand.
#include "engine/tracking/tracker_consensus.h"

#include <gtest/gtest.h>

namespace palace {
namespace {

using Kind = TrackerMember::Kind;

TrackerMember Member(Kind kind, const char* name, double x, double y, double coherence) {
  TrackerMember member;
  member.kind = kind;
  member.name = name;
  member.state = FollowState::kFollowed;
  member.coherence = coherence;
  member.site_pixel = {x, y};
  member.sigma_px = 0.5;
  return member;
}

TEST(TrackerConsensus, IsTheMeanWeightedByCoherenceSquared) {
  std::vector<TrackerMember> members = {Member(Kind::kPlane, "Plane", 100, 50, 1),
                                        Member(Kind::kFeature, "Feature 1", 101, 50, 0.5),
                                        Member(Kind::kFeature, "Feature 2", 100, 52, 0.5)};
  const TrackerConsensus consensus = ConsensusOf(members);
  EXPECT_TRUE(consensus.trusted);
  EXPECT_EQ(consensus.agreeing, 3);
  EXPECT_NEAR(consensus.site_pixel.x(), (100 + 0.25 * 101 + 0.25 * 100) / 1.5, 1e-12);
  EXPECT_NEAR(consensus.site_pixel.y(), (50 + 0.25 * 50 + 0.25 * 52) / 1.5, 1e-12);
  EXPECT_NEAR(consensus.sigma_px, 0.5 * std::sqrt(1 + 2 * 0.0625) / 1.5, 1e-12);
  ShareWeights(consensus, members);
  EXPECT_NEAR(members[0].weight, 1 / 1.5, 1e-12);
}

TEST(TrackerConsensus, OneThatIsElsewhereMovesNothing) {
  const std::vector<TrackerMember> members = {Member(Kind::kPlane, "Plane", 100, 50, 0.8),
                                              Member(Kind::kTemplate, "Template", 140, 50, 1),
                                              Member(Kind::kFeature, "Feature 1", 101, 50, 0.8),
                                              Member(Kind::kFeature, "Feature 2", 99, 50, 0.8)};
  const TrackerConsensus consensus = ConsensusOf(members);
  EXPECT_TRUE(consensus.trusted);
  EXPECT_EQ(consensus.agreeing, 3);
  EXPECT_NEAR(consensus.site_pixel.x(), 100, 1e-9);
  EXPECT_NEAR(consensus.spread_px, 1, 1e-9);
  EXPECT_NEAR(DisagreementOf(members, 1), 40, 1e-9);
  EXPECT_TRUE(OthersAgree(members, 1));
  EXPECT_NEAR(DisagreementOf(members, 0), 0, 1e-9);
}

TEST(TrackerConsensus, OfTwoThatDifferNeitherIsNamed) {
  const std::vector<TrackerMember> members = {Member(Kind::kPlane, "Plane", 100, 50, 0.8),
                                              Member(Kind::kTemplate, "Template", 140, 50, 1)};
  EXPECT_FALSE(OthersAgree(members, 0));
  EXPECT_FALSE(OthersAgree(members, 1));
  EXPECT_EQ(ConsensusOf(members).why_not_trusted, "1 tracker agrees, min 3");
}

TEST(TrackerConsensus, LostOnesAndThoseThatDriftDoNotCount) {
  std::vector<TrackerMember> members = {Member(Kind::kPlane, "Plane", 100, 50, 0.8),
                                        Member(Kind::kFeature, "Feature 1", 101, 50, 0.8),
                                        Member(Kind::kFeature, "Feature 2", 300, 50, 0.9)};
  members[0].state = FollowState::kLost;
  members[2].drifts = true;
  members[2].disagreement_px = 199;
  const TrackerConsensus consensus = ConsensusOf(members);
  EXPECT_EQ(consensus.agreeing, 1);
  EXPECT_EQ(consensus.site_pixel, Eigen::Vector2d(101, 50));
  EXPECT_TRUE(std::isnan(DisagreementOf(members, 0)));
  EXPECT_EQ(DisagreementWords(members), "Feature 2 199 px off the others, limit 5 px");
  members[1].state = FollowState::kLost;
  EXPECT_EQ(ConsensusOf(members).why_not_trusted, "no tracker holds the ground");
  EXPECT_FALSE(ConsensusOf(members).site_pixel.allFinite());
}

TEST(TrackerConsensus, FeaturesAloneAreOfOneKind) {
  const std::vector<TrackerMember> members = {Member(Kind::kFeature, "Feature 1", 100, 50, 0.8),
                                              Member(Kind::kFeature, "Feature 2", 101, 50, 0.8),
                                              Member(Kind::kFeature, "Feature 3", 100, 51, 0.9)};
  EXPECT_EQ(ConsensusOf(members).why_not_trusted, "trackers of one kind agree, min 2 kinds");
}

}  // namespace
}  // namespace palace
