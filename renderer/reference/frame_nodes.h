#pragma once

#include <algorithm>
#include <iterator>

#include "renderer/reference/trace.h"

namespace gnomon {

inline NodeSwitches switchesOf(const TraceInput& input, std::uint32_t instance) {
  return switchesOf(input.nodes, input.traced.view().instances[instance].node);
}

/// Whether an instance shows the shadows of a light.
inline bool receivesFrom(const TraceInput& input, const Light& light, std::uint32_t instance) {
  const Scene& scene = input.traced.scene();
  const int material = materialOf(scene, input.traced.view().instances[instance]);
  return receivesFrom(light, switchesOf(input, instance), scene.materials[static_cast<std::size_t>(material)]);
}

/// One an instance: 1 where its node's switches pass.
template <class Pass>
std::vector<std::uint8_t> instancesWhere(const TraceInput& input, Pass pass) {
  std::vector<std::uint8_t> marks(input.traced.view().instances.size());
  for (std::uint32_t i = 0; i < marks.size(); ++i) marks[i] = pass(switchesOf(input, i)) ? 1 : 0;
  return marks;
}

} // namespace gnomon
