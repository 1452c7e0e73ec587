#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "renderer/bake/baked_light.h"
#include "renderer/core/vectors.h"
#include "renderer/techniques/picture_points.h"

namespace gnomon {

/// One light's shadow over a picture.
struct TracedShadow {
  UnfilledVector<std::uint16_t> values;      ///< share of the light at every sample, 0..65535, in the grid's order
  std::optional<std::uint64_t> tracedPixels; ///< that rays decided; nothing where all was looked up
};

/// Whether any of these lights is traced when a frame is drawn. `layered`: indices of those that fill layers.
bool sendsRays(std::span<const int> layered, std::span<const Light> lights);

/// What arrives of light `light` of `rays`. Rays from the points that were drawn decide. What was drawn may differ from
/// what a camera ray meets within rounding of a surface's rim, and an edge may pass between the samples of a pixel. So
/// a camera ray finds the point of every sample next to masks, where a surface that is turned away from the light ends,
/// and wherever a pixel's share differs from a neighbour's. `samples`: most rays a pixel towards a light that has a
/// size, which takes them in penumbras alone (tracePenumbras).
TracedShadow tracedShadow(const PicturePoints& points, const TraceInput& rays, int light, int samples);

/// Looks up what each sample of the picture sees of a baked light. Lit where nothing shows. What is turned away from
/// the light has the share of the surface's other side, and is dark.
TracedShadow bakedShadow(const PicturePoints& points, const BakedLight& baked);

} // namespace gnomon
