#pragma once

#include <memory>
#include <optional>
#include <span>

#include "protocol/base/bytes.h"
#include "renderer/bake/baked_light.h"

namespace gnomon {

/// A light map as bytes that outlive the process: a line that names the form, width, height and nanoseconds of baking,
/// a SHA-256, and the shares, of an environment plane by plane. Numbers are little-endian.
Bytes lightMapFile(const BakedLight& baked);

/// What a map holds: shares of a light, or of the red, green and blue light of an environment.
enum class BakedPlanes { one, rgb };

/// The map that lightMapFile wrote for this layout. Nothing for any other bytes: cut, changed, of another form, or of a
/// layout that differs in a single corner.
std::optional<BakedLight> readLightMapFile(std::span<const std::uint8_t> file,
                                           const std::shared_ptr<const LightMapLayout>& layout,
                                           BakedPlanes planes = BakedPlanes::one);

} // namespace gnomon
