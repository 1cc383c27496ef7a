#include "engine/report/html_page.h"

#include <cctype>
#include <utility>

namespace palace {
namespace {

// Dark on screen as the program is, black on white on paper.
constexpr const char* kStyle = R"(<style>
:root{--page:#090c10;--plot:#0c1015;--text:#e8ecf1;--dim:#aeb8c4;--rule:#2b3541}
body{background:var(--page);color:var(--text);font:15px Roboto,sans-serif;margin:32px auto;max-width:1200px;padding:0 16px}
h1{font-size:24px}h2{font-size:18px;margin-top:32px}a{color:#5cb2ff}
table{border-collapse:collapse}td,th{padding:4px 16px 4px 0;text-align:left;border-bottom:1px solid var(--rule)}
th{color:var(--dim);font-weight:500}td.n{text-align:right;font-variant-numeric:tabular-nums}
img{width:100%;border:1px solid var(--rule);border-radius:4px;margin:6px 0 2px}
figcaption{color:var(--dim);font-size:13px}figure{margin:12px 0 24px}
svg{background:var(--plot);width:100%;height:auto;max-width:960px;border-radius:4px}
details{border-left:2px solid var(--rule);padding-left:16px;margin:12px 0}summary{color:#5cb2ff;cursor:pointer}details h2{font-size:15px;margin-top:16px}
.pass:before{content:"\2713\00a0";color:#4fd18b}.fail:before{content:"\2717\00a0";color:#ff6b5e}
p.pass,p.fail{margin:4px 0}
@media print{:root{--page:#fff;--plot:#fff;--text:#111;--dim:#444;--rule:#bbb}}
</style>)";

bool LooksLikeNumber(const std::string& text) {
  std::size_t i = !text.empty() && (text[0] == '-' || text[0] == '+') ? 1 : 0;
  return i < text.size() && std::isdigit(static_cast<unsigned char>(text[i])) != 0;
}

}  // namespace

std::string EscapeHtml(const std::string& text) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '&':
        out += "&amp;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

HtmlPage::HtmlPage(std::string title) : title_(std::move(title)) {}

HtmlPage& HtmlPage::Heading(const std::string& text) {
  body_ += "<h2>" + EscapeHtml(text) + "</h2>\n";
  return *this;
}

HtmlPage& HtmlPage::Paragraph(const std::string& text) {
  body_ += "<p>" + EscapeHtml(text) + "</p>\n";
  return *this;
}

HtmlPage& HtmlPage::List(const std::vector<std::string>& lines) {
  body_ += "<ul>\n";
  for (const std::string& line : lines) {
    body_ += "<li>" + EscapeHtml(line) + "</li>\n";
  }
  body_ += "</ul>\n";
  return *this;
}

HtmlPage& HtmlPage::Verdict(bool passed, const std::string& text) {
  body_ += std::string("<p class=\"") + (passed ? "pass" : "fail") + "\">" + EscapeHtml(text) +
           (passed ? "" : " (not met)") + "</p>\n";
  return *this;
}

HtmlPage& HtmlPage::Table(const std::vector<std::string>& header,
                          const std::vector<std::vector<std::string>>& rows) {
  body_ += "<table><tr>";
  for (const std::string& cell : header) {
    body_ += "<th>" + EscapeHtml(cell) + "</th>";
  }
  body_ += "</tr>\n";
  for (const auto& row : rows) {
    body_ += "<tr>";
    for (const std::string& cell : row) {
      body_ += (LooksLikeNumber(cell) ? "<td class=\"n\">" : "<td>") + EscapeHtml(cell) + "</td>";
    }
    body_ += "</tr>\n";
  }
  body_ += "</table>\n";
  return *this;
}

HtmlPage& HtmlPage::Figure(const std::string& svg, const std::string& caption) {
  body_ += "<figure>" + svg + "<figcaption>" + EscapeHtml(caption) + "</figcaption></figure>\n";
  return *this;
}

HtmlPage& HtmlPage::Picture(const std::string& file, const std::string& caption) {
  const std::string name = EscapeHtml(file);
  body_ += "<figure><img src=\"" + name + "\" alt=\"" + EscapeHtml(caption) + "\"><figcaption>" +
           EscapeHtml(caption) + "</figcaption></figure>\n";
  return *this;
}

HtmlPage& HtmlPage::Fold(const std::string& summary, const HtmlPage& part) {
  body_ +=
      "<details><summary>" + EscapeHtml(summary) + "</summary>\n" + part.body_ + "</details>\n";
  return *this;
}

HtmlPage& HtmlPage::Link(const std::string& before, const std::string& file) {
  const std::string name = EscapeHtml(file);
  body_ += "<p>" + EscapeHtml(before) + " <a href=\"" + name + "\">" + name + "</a></p>\n";
  return *this;
}

std::string HtmlPage::Text() const {
  const std::string title = EscapeHtml(title_);
  return "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>" + title +
         "</title>" + kStyle + "</head><body>\n<h1>" + title + "</h1>\n" + body_ +
         "</body></html>\n";
}

}  // namespace palace
