#include "renderer/frame/shadow_warnings.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "protocol/base/text.h"
#include "renderer/shadow/predicted_error.h"

namespace gnomon {
namespace {

std::string lightName(int light) {
  return "Light " + std::to_string(light);
}

bool containsLight(std::span<const int> lights, int light) {
  return std::find(lights.begin(), lights.end(), light) != lights.end();
}

} // namespace

std::optional<std::string> warningOfNoTexel(const PlannedLight& planned) {
  switch (planned.noTexels) {
    case NoTexels::none:
      return std::nullopt;
    case NoTexels::atlasFull:
      return lightName(planned.light) + " casts no shadow: the atlas has no room for its tiles of " +
             std::to_string(planned.askedTileSize) +
             " texels. Raise atlas.size, lower shadow.size or "
             "shadow.importance of other lights, or take shadow.technique rayTraced, which needs no atlas.";
    case NoTexels::outOfRange:
      return lightName(planned.light) +
             " casts no shadow: nothing in view lies within its shadow.depthRange. "
             "Widen shadow.depthRange.min to max, or set its mode to automatic.";
  }
  return std::nullopt;
}

std::optional<std::string> warningOfCoarseTexels(const ResolvedFrame& frame, const PlannedLight& planned,
                                                 const std::optional<PredictedError>& error,
                                                 std::span<const int> layered) {
  if (!error || !(error->p95 > kCoarseMapTexel) || containsLight(layered, planned.light)) return std::nullopt;
  const Light& light = (*frame.spec.lights)[static_cast<std::size_t>(planned.light)];
  const std::string size = planned.grantedTileSize < planned.askedTileSize ? "atlas.size" : "shadow.size";
  return lightName(planned.light) + "'s shadow is coarse: a texel of its map spans up to " + shortNumber(error->p95) +
         " pixels (over " + shortNumber(kCoarseMapTexel) + " is warned of). " +
         (light.type == LightType::directional ? "Raise shadow.cascadeCount or " : "Move the light nearer, raise ") +
         size + ", or take shadow.technique rayTraced.";
}

std::optional<std::string> warningOfCoarseLightMap(const CameraView& view, const ReceiverDepths& seen, int light,
                                                   const LightMapLayout& layout) {
  if (seen.width <= 0 || !(layout.texelsPerMetre > 0)) return std::nullopt;
  std::vector<float> extents;
  for (const DepthSpan& span : seen.blocks) {
    if (span.empty()) continue;
    const double metres = 2 * view.halfSize.y / seen.height * (view.perspective ? double{span.nearest} : 1.0);
    extents.push_back(static_cast<float>(1.0 / (layout.texelsPerMetre * metres)));
  }
  const auto error = errorOf(std::move(extents));
  if (!error || !(error->p95 > kCoarseLightMapTexel)) return std::nullopt;
  return lightName(light) + "'s light map is coarse: its texels of " + shortNumber(1.0 / layout.texelsPerMetre) +
         " m span up to " + shortNumber(error->p95) + " pixels (over " + shortNumber(kCoarseLightMapTexel) +
         " is warned of). Raise shadow.lightMap.texelsPerMetre or shadow.lightMap.size.";
}

} // namespace gnomon
