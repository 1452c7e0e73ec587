#include "renderer/frame/frame_warnings.h"

#include "renderer/frame/faces_away.h"
#include "renderer/frame/shadow_warnings.h"
#include "renderer/frame/view_warnings.h"

namespace gnomon {

std::vector<std::string> frameWarnings(const WarnedFrame& warned, WarnedBy by,
                                       std::span<const LightMapCache::Found> baked) {
  std::vector<std::string> warnings;
  const auto add = [&](std::optional<std::string> warning) {
    if (warning) warnings.push_back(*std::move(warning));
  };
  const auto inView = instancesInView(warned.view, warned.frame);
  add(warningOfNothingInView(warned.frame, inView));
  add(warningOfNearPlane(warned.scene, warned.view, warned.frame));
  if (by == WarnedBy::drawing) {
    add(warningOfFacesAway(warned.scene, warned.view, warned.frame.view, warned.seen, inView.instances));
  }
  for (std::size_t i = 0; i < warned.plan.lights.size(); ++i) {
    add(warningOfNoTexel(warned.plan.lights[i]));
    add(warningOfCoarseTexels(warned.frame, warned.plan.lights[i], warned.errors.lights[i], warned.layered));
  }
  for (std::size_t light = 0; light < baked.size(); ++light) {
    if (baked[light].baked) {
      add(warningOfCoarseLightMap(warned.frame.view, warned.seen, static_cast<int>(light),
                                  *baked[light].baked->layout));
    }
  }
  return warnings;
}

} // namespace gnomon
