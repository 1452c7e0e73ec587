#pragma once

#include <string>
#include <string_view>

/// The pieces that charts are made of.
namespace gnomon::svg {

std::string number(double value);      ///< four significant digits
std::string shortNumber(double value); ///< three
std::string escaped(std::string_view text);

/// `anchor`: start, middle or end. `more`: further attributes, with a space in front.
std::string text(double x, double y, std::string_view anchor, std::string_view words, std::string_view more = "");
std::string line(std::string_view kind, double x1, double y1, double x2, double y2);

/// The class of something in one of four colors: `fill` or `line` and an index.
std::string colored(std::string_view kind, std::size_t index);

/// A whole file around `content`, readable on light and on dark ground (it follows the viewer's color scheme). Classes:
/// title, bold, small, grid, axis; fill0..3 and line0..3 in color, fillRest without.
std::string document(double width, double height, std::string_view content);

} // namespace gnomon::svg
