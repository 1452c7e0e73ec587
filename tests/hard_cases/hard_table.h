#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "protocol/json/json_codec.h"

namespace gnomon::testing {

/// What one technique reached in one case.
struct HardRow {
  std::string name;
  std::string way;
  Json metrics;            ///< by the keys of the bounds; null where it was refused
  double milliseconds = 0; ///< of a frame with nothing but the color view
};

/// One line a row; times as ratios to the hard shadow map of the same case.
std::string tableOf(const std::vector<HardRow>& rows);

/// The same for programs.
Json numbersOf(const std::vector<HardRow>& rows);

} // namespace gnomon::testing
