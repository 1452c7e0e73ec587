#pragma once

#include <optional>

#include "protocol/bake/bake_file_type.h"
#include "protocol/base/bytes.h"
#include "protocol/base/result.h"

/// Part of the door: see render.h.
namespace gnomon {

struct BakedScene;

inline constexpr std::size_t kMostExportedBytes = 256u << 20; ///< of a GLB

/// What was baked as a file. `light`: index of one of the baked lights; absent = the first for PNG, all for the others.
/// Problems: at /light where that light was not baked; where lights that share a file were baked into charts of
/// different sizes; where the scene's pictures are broken; tooLarge where a GLB would have more than
/// kMostExportedBytes.
Result<Bytes> bakeFile(const BakedScene& baked, BakeFile kind, std::optional<int> light);

} // namespace gnomon
