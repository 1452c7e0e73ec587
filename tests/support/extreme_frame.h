#pragma once

#include "protocol/base/scene_bundle.h"
#include "tests/support/chosen_spec.h"

namespace gnomon::testing {

struct ExtremeFrame {
  SceneBundle bundle;
  nlohmann::json spec;
};

/// A chosen frame (chosen_spec.h) some of whose numbers are extreme, and finite: those of the file's vertices, nodes,
/// keyframes, morph targets, cameras and lights, and those of the request. One file in four has so many triangles that
/// they are sorted for rays in the quick way. Any bytes will do; the first 128 choose what is extreme.
ExtremeFrame extremeFrame(std::span<const std::uint8_t> bytes);

} // namespace gnomon::testing
