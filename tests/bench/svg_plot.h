#pragma once

#include <optional>
#include <string>
#include <vector>

namespace gnomon::bench {

/// Values of one name, one for each place along the plot's x axis; empty = not measured.
struct PlotLine {
  std::string name;
  std::vector<std::optional<double>> values;
};

/// A chart of a few lines, or of groups of bars where the x axis only names things.
struct Plot {
  std::string title;
  std::string xLabel;
  std::string yLabel;
  std::vector<std::string> labels; ///< under the places along the x axis
  std::vector<double> xs;          ///< where these lie, on a logarithmic axis (all > 0); empty = bars, evenly apart
  std::vector<PlotLine> lines;     ///< at most four
};

/// An SVG file, readable on light and on dark ground (it follows the viewer's color scheme). The y axis starts at 0.
std::string svgOf(const Plot& plot);

} // namespace gnomon::bench
