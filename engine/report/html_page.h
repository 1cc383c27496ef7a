// One HTML page without scripts or outside files: what a report is made of.
#pragma once

#include <string>
#include <vector>

namespace palace {

/// Text with & < > " made safe.
std::string EscapeHtml(const std::string& text);

/// Adds blocks from top to bottom. Texts are escaped; figures are SVG from svg_plot.h.
class HtmlPage {
 public:
  explicit HtmlPage(std::string title);

  HtmlPage& Heading(const std::string& text);
  HtmlPage& Paragraph(const std::string& text);
  HtmlPage& List(const std::vector<std::string>& lines);
  /// A line with a green or red mark: one acceptance criterion.
  HtmlPage& Verdict(bool passed, const std::string& text);
  /// Cells that begin like a number are set to the right.
  HtmlPage& Table(const std::vector<std::string>& header,
                  const std::vector<std::vector<std::string>>& rows);
  HtmlPage& Figure(const std::string& svg, const std::string& caption);
  /// A picture file beside the page.
  HtmlPage& Picture(const std::string& file, const std::string& caption);
  /// Another page's blocks, closed until the reader opens them.
  HtmlPage& Fold(const std::string& summary, const HtmlPage& part);
  HtmlPage& Link(const std::string& before, const std::string& file);

  std::string Text() const;

 private:
  std::string title_;
  std::string body_;
};

}  // namespace palace
