#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "renderer/render.h"

namespace gnomon::bench {

/// One request of a series.
struct CostPoint {
  std::string label;
  double x = 0; ///< on the series' axis; unused where it only names things
  nlohmann::json spec;
  std::function<ScenePtr()> scene; ///< makes it or gives one that is there
};

/// What a cost is measured against: requests that differ in one thing.
struct CostSeries {
  std::string name; ///< of its plot's file
  std::string title;
  std::string axis;
  bool numeric = true; ///< false = the axis only names things
  std::vector<CostPoint> points;
};

/// Lights of a spec: lamps on both sides of the city's street, which runs along z from the camera at 97 m.
nlohmann::json cityLamps(int count);

/// Cascades, shadowed spots, tile sizes, filters (all that the protocol knows) and triangles. `spec` holds what every
/// request has in common: picture size and antialiasing.
std::vector<CostSeries> costSeries(const nlohmann::json& spec);

} // namespace gnomon::bench
