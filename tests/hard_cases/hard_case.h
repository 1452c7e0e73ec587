#pragma once

#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <vector>

#include "protocol/json/json_codec.h"

namespace gnomon::testing {

/// One file of this folder; README.md says what it may hold.
struct HardCase {
  std::string name; ///< of the file, without .json
  Json file;
};

/// What a failure names it by.
void PrintTo(const HardCase& hard, std::ostream* out);

/// Every case, by name.
std::vector<HardCase> hardCases();

/// One way to make a shadow.
struct Way {
  std::string name; ///< "hard" and "pcf" for shadow maps, else the technique's
  Json shadow;      ///< what it sets in a `shadow`
};

/// Every technique that a request can name, shadow maps both hard and filtered.
std::vector<Way> everyWay();

/// The case's request with this way for every light; `views` as asked, floats, a value a pixel.
Json requestOf(const HardCase& hard, const Way& way, const std::vector<std::string>& views);

/// The requests of a case that has a path: the camera moved step by step.
std::vector<Json> pathOf(const HardCase& hard, const Json& request);

} // namespace gnomon::testing
