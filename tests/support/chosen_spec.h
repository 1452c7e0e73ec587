#pragma once

#include "tests/support/chosen_scene.h"

namespace gnomon::testing {

struct ChosenFrame {
  Bytes glb;
  nlohmann::json spec;
};

/// Any bytes will do; the first 256 choose the spec, the others the scene.
ChosenFrame chosenFrame(std::span<const std::uint8_t> bytes);

} // namespace gnomon::testing
