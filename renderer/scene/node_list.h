#pragma once

#include "protocol/report/node_list.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// A page of the file's nodes. It ends early where their names are long.
NodeList nodesOf(const Scene& scene, const NodePage& page);

} // namespace gnomon
