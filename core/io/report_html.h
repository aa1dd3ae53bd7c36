// A report as one HTML page that needs no other file: headings, paragraphs, tables and pictures, fit for the printer.
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"

namespace odolab {

// Text is escaped; pictures are SVG as the pictures in core/io/picture come.
class HtmlReport {
 public:
  explicit HtmlReport(std::string title);

  void heading(const std::string& text);
  void paragraph(const std::string& text);
  // The first cell of a row is its name and stands left, the others right like numbers. Rows may be short.
  void table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows);
  void word_table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows);  // all stand left
  void picture(const std::string& svg, const std::string& caption = "");
  void pictures(const std::vector<std::string>& svgs, const std::string& caption = "");  // side by side, two in a row
  void sentence(const std::string& text);                                                // a paragraph that stands out
  void append(const HtmlReport& other);  // what another report says, without its title

  std::string text() const;

 private:
  std::string title_;
  std::string body_;
};

Result<Done> write_report(const std::string& path, const HtmlReport& report);

}  // namespace odolab
