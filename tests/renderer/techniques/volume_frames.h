#pragma once

#include "tests/renderer/techniques/traced_frame.h"

/// Frames of technique shadowVolume, and what rays say of them.
namespace gnomon::testing {

/// The shadow view of one light by shadow volumes, 240 x 160 pixels.
Json volumeSpec(const Json& light, const Json& camera);
Json cameraFrom(const Json& eye, const Json& target);

struct TestLights {
  Json sun, lowSun, vertical, point, spot;
};
const TestLights& testLights();

/// Receivers on which a frame and the rays disagree: within a pixel of an edge of what the rays say, and elsewhere.
struct Difference {
  std::size_t receivers = 0;
  std::size_t shadowed = 0;
  std::size_t atEdges = 0;
  std::size_t elsewhere = 0;
};
Difference difference(const ScenePtr& scene, const Json& spec);

/// No pixel off the edges of the shadows differs from what rays say, and there is a shadow to be seen.
void expectTruth(const ScenePtr& scene, const Json& spec);

/// A node's JSON.
nlohmann::json placed(int mesh, const Json& translation, const Json& scale);

/// A cube of 2 m at the origin of its node (mesh 0), and a square of 2 m that faces up (mesh 1); no node yet.
GlbBuilder shapes();

/// A box of 2 m that floats 0.5 m over a floor of 40 m: nodes 1 and 0.
GlbBuilder boxOverFloor();

/// A camera that sees both, and the shadow.
const Json& usualCamera();

} // namespace gnomon::testing
