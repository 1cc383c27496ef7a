#include "engine/tracking/tracker_consensus.h"

#include <algorithm>

#include "engine/core/text.h"

namespace palace {
namespace {

constexpr int kMinAgreeing = 3;
constexpr double kLimit_px = TrackerSetStatus::kDrift_px;

double RawWeight(const TrackerMember& member) {
  const bool counts = member.followed() && !member.drifts && member.site_pixel.allFinite();
  return counts ? member.coherence * member.coherence : 0;
}

/// Weighted mean of those within the limit of `centre`; a member of no weight is not among them.
TrackerConsensus Around(const std::vector<TrackerMember>& members, const Eigen::Vector2d& centre) {
  TrackerConsensus around;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double total = 0, variance = 0;
  for (const TrackerMember& member : members) {
    const double weight = RawWeight(member);
    if (weight > 0 && (member.site_pixel - centre).norm() <= kLimit_px) {
      sum += weight * member.site_pixel;
      variance += weight * weight * member.sigma_px * member.sigma_px;
      total += weight;
      ++around.agreeing;
    }
  }
  if (around.agreeing > 0) {
    around.site_pixel = sum / total;
    around.sigma_px = std::sqrt(variance) / total;
  }
  return around;
}

double WeightAround(const std::vector<TrackerMember>& members, const Eigen::Vector2d& centre) {
  double total = 0;
  for (const TrackerMember& member : members) {
    const double distance_px = (member.site_pixel - centre).norm();
    // Nearer ones count a little more, or the first of a loose group would decide.
    total += distance_px <= kLimit_px ? RawWeight(member) * (1 - distance_px / (2 * kLimit_px)) : 0;
  }
  return total;
}

int Kinds(const std::vector<TrackerMember>& members, const Eigen::Vector2d& centre) {
  bool seen[3] = {false, false, false};
  for (const TrackerMember& member : members) {
    seen[static_cast<std::size_t>(member.kind)] |=
        RawWeight(member) > 0 && (member.site_pixel - centre).norm() <= kLimit_px;
  }
  return seen[0] + seen[1] + seen[2];
}

std::vector<TrackerMember> Without(std::vector<TrackerMember> members, std::size_t index) {
  members.erase(members.begin() + static_cast<std::ptrdiff_t>(index));
  return members;
}

}  // namespace

TrackerConsensus ConsensusOf(const std::vector<TrackerMember>& members) {
  const TrackerMember* best = nullptr;
  double best_weight = 0, total = 0;
  for (const TrackerMember& member : members) {
    const double own = RawWeight(member);
    const double weight = own > 0 ? WeightAround(members, member.site_pixel) : 0;
    total += own;
    if (weight > best_weight) {
      best_weight = weight;
      best = &member;
    }
  }
  TrackerConsensus consensus;
  if (best == nullptr) {
    consensus.why_not_trusted = "no tracker holds the ground";
    return consensus;
  }
  consensus = Around(members, best->site_pixel);
  if (const TrackerConsensus again = Around(members, consensus.site_pixel); again.agreeing > 0) {
    consensus = again;
  }
  double agreeing_weight = 0;
  consensus.spread_px = 0;
  for (const TrackerMember& member : members) {
    const double distance_px = (member.site_pixel - consensus.site_pixel).norm();
    if (RawWeight(member) > 0 && distance_px <= kLimit_px) {
      agreeing_weight += RawWeight(member);
      consensus.spread_px = std::max(consensus.spread_px, distance_px);
    }
  }
  const int kinds = Kinds(members, consensus.site_pixel);
  if (consensus.agreeing < kMinAgreeing) {
    consensus.why_not_trusted = WithNumbers(
        consensus.agreeing == 1 ? "%.0f tracker agrees, min %.0f" : "%.0f trackers agree, min %.0f",
        consensus.agreeing, kMinAgreeing);
  } else if (kinds < 2) {
    consensus.why_not_trusted = "trackers of one kind agree, min 2 kinds";
  } else if (agreeing_weight < 0.5 * total) {
    consensus.why_not_trusted =
        WithNumbers("%.0f %% of the weight agree, min 50 %%", 100 * agreeing_weight / total);
  }
  consensus.trusted = consensus.why_not_trusted.empty();
  return consensus;
}

double DisagreementOf(const std::vector<TrackerMember>& members, std::size_t index) {
  const TrackerMember& member = members[index];
  if (!member.followed()) {
    return NAN;
  }
  return (member.site_pixel - ConsensusOf(Without(members, index)).site_pixel).norm();
}

bool OthersAgree(const std::vector<TrackerMember>& members, std::size_t index) {
  return ConsensusOf(Without(members, index)).agreeing >= 2;
}

void ShareWeights(const TrackerConsensus& consensus, std::vector<TrackerMember>& members) {
  double total = 0;
  for (TrackerMember& member : members) {
    const bool agrees =
        (member.site_pixel - consensus.site_pixel).norm() <= TrackerSetStatus::kDrift_px;
    member.weight = agrees ? RawWeight(member) : 0;
    total += member.weight;
  }
  for (TrackerMember& member : members) {
    member.weight = total > 0 ? member.weight / total : 0;
  }
}

std::string DisagreementWords(const std::vector<TrackerMember>& members) {
  std::string words;
  for (const TrackerMember& member : members) {
    if (member.drifts) {
      words += (words.empty() ? "" : ", ") + member.name +
               WithNumbers(" %.0f px", member.disagreement_px);
    }
  }
  return words.empty() ? words : words + WithNumbers(" off the others, limit %.0f px", kLimit_px);
}

}  // namespace palace
