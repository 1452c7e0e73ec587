#include "renderer/charts/svg.h"

#include <cstdio>

namespace gnomon::svg {
namespace {

// Colors are written out, not held in variables, which some viewers do not know.
constexpr const char* kStyle = R"(<style>
  text { font: 13px sans-serif; fill: #24292f } .title { font-size: 16px; font-weight: bold } .small { font-size: 11px } .bold { font-weight: bold }
  .grid { stroke: #d0d7de } .axis { stroke: #24292f } polyline { fill: none; stroke-width: 2 }
  .fill0 { fill: #0969da } .fill1 { fill: #cf222e } .fill2 { fill: #1a7f37 } .fill3 { fill: #8250df }
  .line0 { stroke: #0969da } .line1 { stroke: #cf222e } .line2 { stroke: #1a7f37 } .line3 { stroke: #8250df }
  .fillRest { fill: #8c959f }
  @media (prefers-color-scheme: dark) {
    text { fill: #e6edf3 } .grid { stroke: #3d444d } .axis { stroke: #e6edf3 }
    .fill0 { fill: #58a6ff } .fill1 { fill: #ff7b72 } .fill2 { fill: #56d364 } .fill3 { fill: #d2a8ff }
    .line0 { stroke: #58a6ff } .line1 { stroke: #ff7b72 } .line2 { stroke: #56d364 } .line3 { stroke: #d2a8ff }
  }
</style>
)";

} // namespace

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string shortNumber(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string escaped(std::string_view text) {
  std::string out;
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
      default:
        out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c; // control characters are no XML
    }
  }
  return out;
}

std::string text(double x, double y, std::string_view anchor, std::string_view words, std::string_view more) {
  return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" text-anchor=\"" + std::string(anchor) + "\"" +
         std::string(more) + ">" + escaped(words) + "</text>\n";
}

std::string line(std::string_view kind, double x1, double y1, double x2, double y2) {
  return "<line class=\"" + std::string(kind) + "\" x1=\"" + number(x1) + "\" y1=\"" + number(y1) + "\" x2=\"" +
         number(x2) + "\" y2=\"" + number(y2) + "\"/>\n";
}

std::string colored(std::string_view kind, std::size_t index) {
  return "class=\"" + std::string(kind) + std::to_string(index % 4) + "\"";
}

std::string document(double width, double height, std::string_view content) {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + number(width) + " " + number(height) +
         "\" width=\"" + number(width) + "\" height=\"" + number(height) + "\">\n" + kStyle + std::string(content) +
         "</svg>\n";
}

} // namespace gnomon::svg
