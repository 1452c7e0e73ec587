#pragma once

#include "protocol/spec/output_options.h"
#include "renderer/cpu/frame_scene.h"
#include "renderer/device/device.h"
#include "tests/renderer/cpu/shadow/shadow_kernels.h"

namespace gnomon::cpu {

/// What views of light 0 are made from.
struct DebugMaps {
  const ShadowMaps& maps;
  const shared::FrameData& frame;
  std::span<const TileMap> casters = {};
  std::span<const std::int32_t> slotNodes = {};
};

// Sixteen points at a time; `points` and `out` are of one length, which may be any.

void debugDataByLanes(const DebugMaps& debug, View view, bool encoded, std::span<const AskedPoint> points,
                      glm::vec4* out);
void texelGridByLanes(const DebugMaps& debug, const glm::vec3& shown, std::span<const AskedPoint> points,
                      glm::vec3* out);
void footprintsByLanes(const DebugMaps& debug, std::span<const AskedPoint> points, MapFootprint* out);

/// Places of the picture, pixels from the lower left corner, and the triangles that they show.
struct ShownPlaces {
  std::span<const std::uint32_t> triangles; ///< kNoNumber: nothing
  std::span<const glm::vec2> places;
};

/// receiversOf; `toLight` is left alone, and all of those that show nothing.
void receiversByLanes(const FrameScene& scene, const ShownPlaces& shown, AskedPoint* out);

} // namespace gnomon::cpu
