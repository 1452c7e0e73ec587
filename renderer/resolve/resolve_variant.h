#pragma once

#include <string>

#include "protocol/base/result.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// Index into Scene::variants; of two of one name the first. A problem at /materialVariant names those there are.
Result<int> resolveVariant(const std::string& name, const Scene& scene);

} // namespace gnomon
