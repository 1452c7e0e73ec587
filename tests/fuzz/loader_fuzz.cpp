// The whole way from a model's bytes to a scene: container, schema, accessors, compression, graph, materials, images;
// and to what its first animations make of it.
#include <algorithm>
#include <cmath>

#include "renderer/scene/animation/posed_scene.h"
#include "renderer/scene/gltf_loader.h"
#include "tests/fuzz/glb_parts.h"
#include "tests/fuzz/sound_problems.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t capacity);

namespace {

using namespace gnomon;

/// As a server's, but so low that any file takes milliseconds.
Limits quickLimits() {
  Limits limits;
  limits.maxJsonValues = 20'000;
  limits.maxNodes = 2'000;
  limits.maxInstances = 4'000;
  limits.maxTriangles = 20'000;
  limits.maxVertices = 60'000;
  limits.maxDecodedBytes = 4u << 20;
  limits.maxMorphedVertices = 60'000;
  limits.maxImageSide = 512;
  limits.maxImagePixels = 512 * 512;
  return limits;
}

void requireWithin(const Scene& scene, const Limits& limits) {
  fuzz::require(!scene.scenes.empty(), "a scene that loads has a scene");
  fuzz::require(scene.summary.triangles <= limits.maxTriangles, "no more triangles than the limit");
  for (const auto& image : scene.images) {
    fuzz::require(image->width() <= limits.maxImageSide && image->height() <= limits.maxImageSide,
                  "images within the limit");
    if (const Status decoded = image->decode(); !decoded) fuzz::requireSound(decoded.problems());
  }
}

bool isFinite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// At its ends, between them, and beyond them.
void requirePoses(const std::shared_ptr<const Scene>& scene) {
  const std::size_t most = std::min<std::size_t>(scene->summary.animations.size(), 2);
  for (std::size_t i = 0; i < most; ++i) {
    const double duration = scene->summary.animations[i].durationSeconds;
    for (const double seconds : {-1.0, 0.0, duration / 3, duration, 2 * duration + 1}) {
      AnimationMoment moment;
      moment.index = static_cast<int>(i);
      moment.timeSeconds = seconds;
      const auto posed = posedScene(scene, {moment});
      if (!posed) {
        fuzz::requireSound(posed.problems());
        continue;
      }
      for (const SceneView& view : (*posed)->scenes) {
        fuzz::require(view.bounds.empty() || (isFinite(view.bounds.min) && isFinite(view.bounds.max)),
                      "what an animation places is finite");
      }
    }
  }
}

} // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t capacity,
                                               unsigned seed) {
  return gnomon::fuzz::mutatePart(data, size, capacity, seed, LLVMFuzzerMutate);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Limits limits = quickLimits();
  const auto scene = loadGltf({Bytes(data, data + size), {}}, limits);
  if (scene) {
    requireWithin(**scene, limits);
    requirePoses(*scene);
  } else {
    fuzz::requireSound(scene.problems());
  }
  return 0;
}
