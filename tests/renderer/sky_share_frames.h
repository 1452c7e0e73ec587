#pragma once

#include <numeric>
#include <vector>

#include "tests/renderer/frame_fixture.h"
#include "tests/renderer/rays/shapes.h"

/// Frames that show the share of a uniform sky that arrives.
namespace gnomon::testing {

/// Looks down at the origin from `height` through a lens of so many degrees, under the upload's white.hdr.
inline Json skyShareSpec(double height, double degrees) {
  return {{"width", 48},
          {"height", 48},
          {"camera",
           {{"eye", {0, height, 0}},
            {"target", {0, 0, 0}},
            {"up", {0, 0, -1}},
            {"perspective", {{"fovYDegrees", degrees}}}}},
          {"lights", Json::array()},
          {"environment", {{"file", "white.hdr"}, {"extractSun", "none"}, {"shadows", "rays"}, {"samples", 16}}},
          {"debug", {{"light", "environment"}}},
          {"antialiasing", "none"},
          {"views", {"shadow"}},
          {"output", {{"format", "exr"}, {"exrPixelType", "float"}}}};
}

/// A white matt square around the origin.
inline GlbBuilder whiteFloor(float half) {
  GlbBuilder builder;
  addSquare(builder, half, 0);
  builder.add("materials", {{"pbrMetallicRoughness",
                             {{"baseColorFactor", {1, 1, 1, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 1}}}});
  builder.json["meshes"][0]["primitives"][0]["material"] = 0;
  return builder;
}

inline double meanOf(const std::vector<float>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

} // namespace gnomon::testing
