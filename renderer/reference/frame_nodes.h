#pragma once

#include <algorithm>
#include <iterator>

#include "renderer/reference/trace.h"
#include "renderer/reference/tree.h"

namespace gnomon {

inline NodeSwitches switchesOf(const TraceInput& input, std::uint32_t instance) {
  return switchesOf(input.nodes, input.traced.view().instances[instance].node);
}

/// One an instance: 1 where its node's switches pass.
template <class Pass>
std::vector<std::uint8_t> instancesWhere(const TraceInput& input, Pass pass) {
  std::vector<std::uint8_t> marks(input.traced.view().instances.size());
  for (std::uint32_t i = 0; i < marks.size(); ++i) marks[i] = pass(switchesOf(input, i)) ? 1 : 0;
  return marks;
}

} // namespace gnomon
