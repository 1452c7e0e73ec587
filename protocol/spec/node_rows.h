#pragma once

#include "protocol/fields/fields.h"
#include "protocol/fields/ranges.h"
#include "protocol/spec/node_options.h"

/// The rows of a node's switches; see field_rows.h.
namespace gnomon {

template <>
inline constexpr auto kRows<NodeOptions> = rows(
    "NodeOptions", "Switches of a node and of all below it, as far as no entry for a node further down says otherwise.",
    field("node", &NodeOptions::node,
          {.says = "The node's index, or the name of one or more; always needed.",
           .range = kNodeRange,
           .minCount = 1,
           .maxCount = 1024}),
    field("visible", &NodeOptions::visible, {.says = "False = the camera does not see it; absent = true."}),
    field("castShadow", &NodeOptions::castShadow,
          {.says = "Whether it throws shadows, seen or not; absent = as `visible`."}),
    field("receiveShadow", &NodeOptions::receiveShadow,
          {.says = "False = nothing throws a shadow on it; absent = true."}),
    field("layers", &NodeOptions::layers,
          {.says = "Its layers, one bit each, for the lights' `cullingMask`; absent = 1, the first layer.",
           .range = {1, double(kAllLayers)}}));
static_assert(kRowsAreComplete<NodeOptions>);

} // namespace gnomon
