#include "gui/app/report/approvals.h"

#include <cmath>
#include <string>

#include "engine/core/hash.h"
#include "engine/core/log.h"
#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/model/site_standing.h"
#include "engine/model/wind.h"
#include "engine/survey/map_pictures.h"
#include "gui/widgets/number_text.h"

namespace palace {
namespace {

using Rows = std::vector<std::vector<std::string>>;

/// "up to 6.3 m, 4.7 m where the way down begins; one of them at least 5 m"; empty: nobody asked.
std::string AirWords(const LandingSite& site) {
  if (std::isnan(site.air_seen_m)) {
    return {};
  }
  return WithNumbers("up to %.1f m", site.air_seen_m) +
         (std::isnan(site.air_on_way_m)
              ? ""
              : WithNumbers(", %.1f m where the way down begins; one of them at least %.0f m",
                            site.air_on_way_m, kLeastAirSeen_m));
}

/// "5.2 m/s from 240°"; of next to none the direction means nothing.
std::string WindWords(const ApprovalRecord& record) {
  return std::isnan(record.wind_mps)
             ? "not told by the vehicle"
             : WithNumbers("%.1f m/s", record.wind_mps) +
                   (WindHasDirection(record.wind_mps) ? " from " + HeadingText(record.wind_from_rad)
                                                      : "");
}

/// As the button said it.
const char* StandingWhenGiven(const ApprovalRecord& record) {
  if (!record.approval.provisional) {
    return ", confirmed";
  }
  const bool unseen = record.map != nullptr &&
                      StandingOf(record.site, record.map->settings) == SiteStanding::kToLookAt;
  return unseen ? ", not seen enough (look first)" : ", provisional";
}

Rows Figures(const ApprovalRecord& record) {
  const Approval& a = record.approval;
  Rows rows = {
      {"Given", ClockText(record.given) + " by " + (record.by.empty() ? "the record" : record.by)},
      {"Site", record.site.letter +
                   WithNumbers(": %.2f m north, %.2f m east, %.2f m up", a.p_WS.x(), a.p_WS.y(),
                               -a.p_WS.z()) +
                   StandingWhenGiven(record)},
      {"For", a.IsLook() ? WithNumbers("a look from %.0f m above it", a.stop_height_m) : "landing"},
      {"Radius to keep clear", WithNumbers("%.2f m", a.clear_radius_m)},
      {"Approach",
       "heading " + HeadingText(a.approach_heading_rad) +
           WithNumbers(", slope %.0f°, %.2f m/s down", Deg(a.glide_slope_rad), a.descent_rate_mps)},
      {"Wind", WindWords(record)},
      {"Must begin within", WithNumbers("%.0f s of it, the way to where it begins counted in",
                            SecondsBetween(a.approved_at, a.expires_at))},
      {"Bound to", "map " + ShortHash(a.map_hash) + ", limits " + ShortHash(a.settings_hash) +
                       ", calibration " + ShortHash(a.calibration_hash)},
      {"Vehicle's answer", record.answer},
      {"Came to", std::string(MissionStateName(record.last_state)) + ": " + record.why}};
  if (const std::string air = AirWords(record.site); !air.empty()) {
    rows.insert(rows.begin() + 2, {"Air over it seen", air});
  }
  if (std::isfinite(record.site.called_unsafe_s)) {
    rows.push_back({"Doubt", WithNumbers("a map called it unsafe %.0f s before",
                                         record.site.called_unsafe_s)});
  }
  return rows;
}

Rows Evidence(const ApprovalRecord& record) {
  Rows rows;
  for (const LimitRow& row : record.limits) {
    rows.push_back({row.label, ValueWords(row),
                    (row.is_least ? "at least " : "at most ") + LimitWords(row),
                    EnforcedByWord(row.enforced_by)});
  }
  return rows;
}

/// The picture's name when it could be written.
void AddPicture(HtmlPage& page, const Status& written, const std::string& name,
                const std::string& caption) {
  if (written) {
    page.Picture(name, caption);
  } else {
    LogWarning(written.error().message);
  }
}

}  // namespace

void AddApprovals(HtmlPage& page, const std::vector<ApprovalRecord>& approvals,
                  const std::filesystem::path& folder) {
  int number = 0;
  for (const ApprovalRecord& record : approvals) {
    const std::string name = "approval-" + std::to_string(++number);
    page.Heading("Approval " + std::to_string(number)).Table({"", ""}, Figures(record));
    page.Table({"Evidence", "Value", "Limit", "Beyond it acts"}, Evidence(record));
    SiteSelection chosen;
    chosen.sites = {record.site};
    if (record.left && record.range && record.map && record.map->verdict) {
      AddPicture(page,
                 WriteOverlay(folder / (name + ".png"), *record.left, chosen, *record.range,
                              *record.map->verdict),
                 name + ".png", "The left picture when it was approved, with the site");
    }
    if (record.map && record.map->elevation && record.map->hazards) {
      AddPicture(page,
                 WriteSafeLandingPicture(folder / (name + "-map.png"), *record.map->elevation,
                                         *record.map->hazards, chosen),
                 name + "-map.png", "The map that it was bound to, north up");
    }
  }
}

}  // namespace palace
