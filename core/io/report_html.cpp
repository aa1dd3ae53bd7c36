#include "core/io/report_html.h"

#include "core/io/picture/svg.h"
#include "core/io/whole_file.h"

namespace odolab {

namespace {

constexpr const char* kStyle = R"(
body { font: 16px/1.55 "DejaVu Sans", Verdana, sans-serif; color: #1a1a1a; background: #fff; max-width: 60em; margin: 2.5em auto; padding: 0 1.2em; }
h1 { font-size: 1.7em; line-height: 1.2; margin: 0 0 .8em; }
h2 { font-size: 1.2em; margin: 2em 0 .5em; border-bottom: 1px solid #ddd; padding-bottom: .2em; }
p { margin: .6em 0; max-width: 46em; }
table { border-collapse: collapse; margin: 1em 0; font-size: .92em; font-variant-numeric: tabular-nums; }
th, td { padding: .3em .9em .3em 0; text-align: right; vertical-align: top; }
th:first-child, td:first-child { text-align: left; }
.words th, .words td { text-align: left; }
thead th { border-bottom: 1.5px solid #1a1a1a; font-weight: 600; }
tbody tr + tr td { border-top: 1px solid #eee; }
figure { margin: 1.4em 0; }
figure svg { max-width: 100%; height: auto; display: block; }
.pair { display: grid; grid-template-columns: 1fr 1fr; gap: .8em; }
.sentence { font-weight: 600; margin-top: 1.4em; }
figcaption { color: #555; font-size: .9em; margin-top: .4em; }
@media print { body { margin: 0; max-width: none; font-size: 11pt; } figure, table { break-inside: avoid; } h2 { break-after: avoid; } }
)";

void append_row(std::string& html, const std::vector<std::string>& cells, std::size_t columns, const char* tag) {
  html += "<tr>";
  for (std::size_t i = 0; i < columns; ++i)
    html += std::string("<") + tag + ">" + (i < cells.size() ? escaped(cells[i]) : "") + "</" + tag + ">";
  html += "</tr>\n";
}

void append_table(std::string& html, const char* tag, const std::vector<std::string>& header,
                  const std::vector<std::vector<std::string>>& rows) {
  html += std::string(tag) + "<thead>\n";
  append_row(html, header, header.size(), "th");
  html += "</thead><tbody>\n";
  for (const std::vector<std::string>& row : rows) append_row(html, row, header.size(), "td");
  html += "</tbody></table>\n";
}

}  // namespace

HtmlReport::HtmlReport(std::string title) : title_(std::move(title)) {}

void HtmlReport::heading(const std::string& text) { body_ += "<h2>" + escaped(text) + "</h2>\n"; }
void HtmlReport::paragraph(const std::string& text) { body_ += "<p>" + escaped(text) + "</p>\n"; }

void HtmlReport::table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows) {
  append_table(body_, "<table>", header, rows);
}

void HtmlReport::word_table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows) {
  append_table(body_, "<table class=\"words\">", header, rows);
}

void HtmlReport::picture(const std::string& svg, const std::string& caption) {
  body_ += "<figure>\n" + svg;
  if (!caption.empty()) body_ += "<figcaption>" + escaped(caption) + "</figcaption>\n";
  body_ += "</figure>\n";
}

void HtmlReport::pictures(const std::vector<std::string>& svgs, const std::string& caption) {
  body_ += "<figure>\n<div class=\"pair\">\n";
  for (const std::string& svg : svgs) body_ += svg;
  body_ += "</div>\n";
  if (!caption.empty()) body_ += "<figcaption>" + escaped(caption) + "</figcaption>\n";
  body_ += "</figure>\n";
}

void HtmlReport::sentence(const std::string& text) { body_ += "<p class=\"sentence\">" + escaped(text) + "</p>\n"; }

void HtmlReport::append(const HtmlReport& other) { body_ += other.body_; }

std::string HtmlReport::text() const {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         escaped(title_) + "</title>\n<style>" + kStyle + "</style>\n</head>\n<body>\n<h1>" + escaped(title_) +
         "</h1>\n" + body_ + "</body>\n</html>\n";
}

Result<Done> write_report(const std::string& path, const HtmlReport& report) {
  return write_whole_file(path, report.text());
}

}  // namespace odolab
