#pragma once

#include "tests/support/chosen_scene.h"

namespace gnomon::testing {

/// A FrameSpec as JSON for a small picture of that scene, at most 64 x 48 pixels: any camera, up to three lights of any
/// type and technique, every option of shadows and atlas, any one or two views. Nearly all can be drawn; some are bad
/// requests.
nlohmann::json chosenSpec(Choices& choices, const ChosenScene& scene);

struct ChosenFrame {
  Bytes glb;
  nlohmann::json spec;
};

/// Any bytes will do; the first 256 choose the spec, the others the scene.
ChosenFrame chosenFrame(std::span<const std::uint8_t> bytes);

} // namespace gnomon::testing
