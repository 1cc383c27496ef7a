#include "engine/tools/track_files.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "engine/core/csv_row.h"
#include "engine/core/rounding.h"
#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/core/version.h"
#include "engine/report/html_page.h"
#include "engine/report/svg_plot.h"
#include "engine/survey/map_pictures.h"

namespace palace {
namespace {

constexpr int kBracket_px = 20;
constexpr std::size_t kPicturesInReport = 12;
constexpr int kWhite = 255, kGrey = 170, kBlack = 0;

cv::Mat View(ImageU8& picture) {
  return {picture.height(), picture.width(), CV_8U, picture.pixels().data()};
}

cv::Point At(const Eigen::Vector2d& pixel) {
  return {static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y()))};
}

void DrawWindow(cv::Mat& picture, const FollowedFeature& told) {
  const int half = told.window_side_px / 2;
  const cv::Point centre = At(told.window_centre), reach(half, half);
  for (const auto& [grey, width] : {std::pair(kBlack, 3), {kWhite, 1}}) {
    cv::rectangle(picture, centre - reach, centre + reach, cv::Scalar(grey), width);
  }
}

void DrawBrackets(cv::Mat& picture, const FollowedFeature& told) {
  const cv::Point centre = At(told.pixel);
  const int half = kBracket_px / 2, arm = kBracket_px / 4;
  const int ink = told.state == FollowState::kLost ? kGrey : kWhite;
  for (const auto& [grey, width] : {std::pair(kBlack, 3), {ink, 1}}) {
    for (const cv::Point side : {cv::Point(-1, -1), {1, -1}, {-1, 1}, {1, 1}}) {
      const cv::Point corner = centre + half * side;
      cv::line(picture, corner, corner - cv::Point(arm * side.x, 0), cv::Scalar(grey), width);
      cv::line(picture, corner, corner - cv::Point(0, arm * side.y), cv::Scalar(grey), width);
    }
  }
}

/// Black behind it; moved into the picture as far as it goes.
void DrawText(cv::Mat& picture, const std::string& text, cv::Point top_left) {
  const double size = 0.5 * std::max(1.0, picture.cols / 1280.0);
  int below = 0;
  const cv::Size extent = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, size, 1, &below);
  const int edge = 4;
  const cv::Size plate(extent.width + 2 * edge, extent.height + below + 2 * edge);
  top_left.x = std::max(std::min(top_left.x, picture.cols - plate.width), 0);
  top_left.y = std::max(std::min(top_left.y, picture.rows - plate.height), 0);
  cv::rectangle(picture, cv::Rect(top_left, plate), cv::Scalar(kBlack), cv::FILLED);
  cv::putText(picture, text, top_left + cv::Point(edge, edge + extent.height),
              cv::FONT_HERSHEY_SIMPLEX, size, cv::Scalar(kWhite), 1, cv::LINE_AA);
}

std::string FrameText(const TrackedPicture& picture) {
  const std::string frame = WithNumbers("frame %.0f", picture.frame);
  return std::isfinite(picture.time_s) ? frame + WithNumbers(", %.3f s", picture.time_s) : frame;
}

int CountOf(const Track& track, FollowState state) {
  return static_cast<int>(
      std::count_if(track.pictures.begin(), track.pictures.end(),
                    [&](const TrackedPicture& picture) { return picture.told.state == state; }));
}

bool IsChange(const Track& track, std::size_t i) {
  const FollowState now = track.pictures[i].told.state;
  return now == FollowState::kReacquired ||
         (now == FollowState::kLost && track.pictures[i].told.pictures_lost == 1);
}

LinePlot CoherencePlot(const Track& track) {
  LinePlot plot{"Coherence with the anchor", "frame", "coherence, 0 to 1"};
  PlotSeries all{"best place in the window", {}, {}}, lost{"LOST", {}, {}};
  for (const TrackedPicture& picture : track.pictures) {
    all.x.push_back(picture.frame);
    all.y.push_back(picture.told.coherence);
    if (picture.told.state == FollowState::kLost) {
      lost.x.push_back(picture.frame);
      lost.y.push_back(picture.told.coherence);
    }
  }
  all.points = false;
  lost.line = false;
  plot.series.push_back(std::move(all));
  if (!lost.x.empty()) {
    plot.series.push_back(std::move(lost));
  }
  plot.limits.push_back(
      {track.options.min_coherence, WithNumbers("limit %.2f", track.options.min_coherence)});
  plot.y_min = 0;
  plot.y_max = 1;
  return plot;
}

LinePlot PlacePlot(const Track& track) {
  LinePlot plot{"Place of the feature, where it was seen", "frame", "pixel"};
  PlotSeries x{"x, right", {}, {}}, y{"y, down", {}, {}};
  for (const TrackedPicture& picture : track.pictures) {
    const bool seen = picture.told.state != FollowState::kLost;
    for (PlotSeries* series : {&x, &y}) {
      series->x.push_back(picture.frame);
    }
    x.y.push_back(seen ? picture.told.pixel.x() : NAN);
    y.y.push_back(seen ? picture.told.pixel.y() : NAN);
  }
  x.points = y.points = false;
  plot.series = {std::move(x), std::move(y)};
  return plot;
}

std::vector<std::string> SummaryLines(const Track& track) {
  std::vector<std::string> lines = {TrackSummary(track)};
  lines.push_back(
      track.source +
      WithNumbers(", pictures of %.0f x %.0f px, by palacectl ", track.width, track.height) +
      kProgramVersion);
  lines.push_back("Feature " + track.chosen);
  const FollowerOptions& options = track.options;
  lines.push_back(WithNumbers("Template %.0f px, search %.0f px around it, coherence at least %.2f",
                              options.template_px, options.search_px, options.min_coherence) +
                  (options.update ? "" : "; the first template stays"));
  const FollowedFeature& last = track.pictures.back().told;
  lines.push_back(WithNumbers("Anchors cut: %.0f. Last scale %.2f, turn %.1f ° since frame 0",
                              last.anchors, last.scale, Deg(last.angle_rad)));
  if (track.undecodable > 0) {
    lines.push_back(WithNumbers("Pictures that could not be decoded: %.0f", track.undecodable));
  }
  if (!track.ended.empty()) {
    lines.push_back("It ended early: " + track.ended);
  }
  return lines;
}

}  // namespace

std::string TrackSummary(const Track& track) {
  const int lost = CountOf(track, FollowState::kLost);
  const double count = static_cast<double>(track.pictures.size());
  double total_ms = 0;
  for (const TrackedPicture& picture : track.pictures) {
    total_ms += picture.follow_ms;
  }
  return WithNumbers("%.0f pictures, tracked %.0f, lost %.0f", count, count - lost, lost) +
         WithNumbers(", re-acquired %.0f, %.1f ms a picture",
                     CountOf(track, FollowState::kReacquired), total_ms / std::max(count, 1.0));
}

std::string TrackEvent(const TrackedPicture& picture) {
  const FollowedFeature& told = picture.told;
  return FrameText(picture) + ": " + FollowWord(told.state) +
         (told.state == FollowState::kLost
              ? ", " + told.why_lost
              : WithNumbers(" at %.1f,%.1f px, coherence %.2f", told.pixel.x(), told.pixel.y(),
                            told.coherence));
}

ImageU8 AnnotatedPicture(const ImageU8& picture, const TrackedPicture& tracked,
                         double min_coherence) {
  ImageU8 annotated = picture;
  cv::Mat view = View(annotated);
  const FollowedFeature& told = tracked.told;
  DrawWindow(view, told);
  DrawBrackets(view, told);
  const bool lost = told.state == FollowState::kLost;
  const double coherence = lost ? told.coherence : ShownBeyond(told.coherence, min_coherence, 2);
  std::string text = WithNumbers("coherence %.2f, limit %.2f", coherence, min_coherence);
  if (lost) {
    const bool is_coherence = told.coherence < min_coherence;
    text = WithNumbers("LOST, picture %.0f: ", told.pictures_lost) +
           (is_coherence ? told.why_lost : text + ", but " + told.why_lost);
  } else if (told.state == FollowState::kReacquired) {
    text = "re-acquired: " + text;
  }
  const int half = told.window_side_px / 2;
  const cv::Point below = At(told.window_centre) + cv::Point(-half, half + 4);
  DrawText(view, text, below);
  DrawText(view, FrameText(tracked), {0, 0});
  return annotated;
}

std::string TrackCsv(const Track& track) {
  std::string text =
      "frame,time_s,x_px,y_px,coherence,state,follow_ms,scale,turn_deg,anchors,why_lost\n";
  for (const TrackedPicture& picture : track.pictures) {
    const FollowedFeature& told = picture.told;
    CsvRow row;
    row << picture.frame << picture.time_s << told.pixel.x() << told.pixel.y() << told.coherence
        << FollowWord(told.state) << picture.follow_ms << told.scale << Deg(told.angle_rad)
        << told.anchors << told.why_lost;
    text += row.line();
  }
  return text;
}

std::string TrackReport(const Track& track, const std::filesystem::path& folder) {
  HtmlPage page("PALACE: a feature followed");
  page.List(SummaryLines(track));
  page.Figure(
      LinePlotSvg(CoherencePlot(track)),
      "Below the limit nothing is followed and nothing is learned. LOST above it: another place "
      "looks as much like the feature, or what lies around it differs.");
  page.Figure(LinePlotSvg(PlacePlot(track)), "Gaps: the feature was lost.");
  std::vector<std::vector<std::string>> events;
  std::vector<const TrackedPicture*> shown;
  for (std::size_t i = 0; i < track.pictures.size(); ++i) {
    const TrackedPicture& picture = track.pictures[i];
    if (IsChange(track, i)) {
      events.push_back({std::to_string(picture.frame), OrDash("%.3f", picture.time_s),
                        FollowWord(picture.told.state), WithNumbers("%.2f", picture.told.coherence),
                        picture.told.why_lost});
    }
    const bool end = i == 0 || i + 1 == track.pictures.size();
    if (!picture.file.empty() && (end || IsChange(track, i))) {
      shown.push_back(&picture);
    }
  }
  if (!events.empty()) {
    page.Heading("What happened").Table({"Frame", "Time, s", "State", "Coherence", "Why"}, events);
  }
  if (!shown.empty()) {
    page.Heading("Pictures")
        .Paragraph(
            "Square: the search window. Brackets: the feature; grey while it is lost: it is only "
            "expected there.");
    shown.resize(std::min(shown.size(), kPicturesInReport));
    for (const TrackedPicture* picture : shown) {
      const std::string data = PictureAsDataUri(folder / picture->file);
      if (!data.empty()) {
        page.Picture(data, TrackEvent(*picture));
      }
    }
  }
  page.Link("Every picture: ", "track.csv");
  return page.Text();
}

}  // namespace palace
