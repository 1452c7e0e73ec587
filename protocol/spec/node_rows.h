#pragma once

#include "protocol/fields/fields.h"
#include "protocol/fields/ranges.h"
#include "protocol/spec/node_options.h"

/// The rows of a node's switches; see field_rows.h.
namespace gnomon {

template <>
inline constexpr auto kRows<NodeOptions> = rows(
    "NodeOptions", "Switches of a node and everything below it; an entry for a node further down takes precedence.",
    field("node", &NodeOptions::node,
          {.says = "The node's index, or its name (all nodes of that name); required.",
           .range = kNodeRange,
           .minCount = 1,
           .maxCount = 1024}),
    field("visible", &NodeOptions::visible, {.says = "False = the camera does not see it; absent = true."}),
    field("castShadow", &NodeOptions::castShadow,
          {.says = "Whether it casts shadows, visible or not; absent = the value of `visible`."}),
    field("receiveShadow", &NodeOptions::receiveShadow, {.says = "False = no shadow falls on it; absent = true."}),
    field("layers", &NodeOptions::layers,
          {.says = "Bit mask of its layers, matched with the lights' `cullingMask`; absent = 1, the first layer.",
           .range = {1, double(kAllLayers)}}));
static_assert(kRowsAreComplete<NodeOptions>);

} // namespace gnomon
