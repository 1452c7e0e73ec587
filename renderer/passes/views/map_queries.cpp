#include "renderer/passes/views/map_queries.h"

#include <bit>
#include <glm/gtc/packing.hpp>

#include "renderer/gl/draw.h"
#include "renderer/gl/texture.h"
#include "renderer/passes/views/view_pass.h"
#include "renderer/shaders/shared/functions.h"

namespace gnomon {

namespace {

glm::vec2 downwards(std::uint32_t halves) {
  return glm::unpackHalf2x16(halves) * glm::vec2(1, -1);
}

MapFootprint footprintOf(const glm::uvec4& lengths, const glm::uvec4& place) {
  MapFootprint footprint;
  footprint.shift = downwards(lengths.x);
  footprint.texelU = downwards(lengths.y);
  footprint.texelV = downwards(lengths.z);
  footprint.tile = static_cast<int>(lengths.w);
  footprint.viewDepth = std::bit_cast<float>(place.x);
  footprint.normal = shared::fromOctahedral(glm::unpackSnorm2x16(place.y));
  footprint.penumbra = std::bit_cast<float>(place.z);
  return footprint;
}

} // namespace

Result<std::vector<MapFootprint>> mapFootprints(const PassInputs& inputs, const Shading& shading,
                                                const Surfaces& surfaces) {
  ViewVariant variant = lightVariant(inputs, shading, false);
  variant.smoothPlaces = surfaces.smoothPlaces.id() != 0;
  const auto program = inputs.programs.get(displacementProgram(variant));
  if (!program) return program.problems();
  const gl::Texture lengths({GL_RGBA32UI, inputs.width, inputs.height}, "footprint lengths");
  const gl::Texture places({GL_RGBA32UI, inputs.width, inputs.height}, "footprint places");
  const auto target = gl::Framebuffer::create({{{&lengths}, {&places}}, {}}, "footprints");
  if (!target) return target.problems();

  const Rect whole{0, 0, inputs.width, inputs.height};
  bindInputs(inputs);
  const ShadowBindings bindings(shading);
  const gl::Texture& atlas = shading.atlas.textures->depth;
  (*program)->set(GNOMON_DEBUG_LIGHT, shading.debugLight);
  (*program)->set(GNOMON_ATLAS_SIZE, glm::vec2(atlas.width(), atlas.height()));
  (*program)->set(GNOMON_SAMPLE_POSITIONS, surfaces.samplePositions.front());
  gl::drawFullscreen(**program, {.framebuffer = target->id(), .viewport = whole},
                     {{GNOMON_DEPTH_UNIT, &depthOf(surfaces, shading.survey)},
                      {GNOMON_SURFACE_UNIT, &surfaces.bits},
                      {GNOMON_SMOOTH_UNIT, &surfaces.smoothPlaces}});

  const auto width = static_cast<std::size_t>(inputs.width);
  const auto height = static_cast<std::size_t>(inputs.height);
  std::vector<glm::uvec4> read(2 * width * height);
  const std::span<glm::uvec4> both(read);
  for (int i = 0; i < 2; ++i) {
    target->readColor(
        i, whole, {GL_RGBA_INTEGER, GL_UNSIGNED_INT},
        std::as_writable_bytes(both.subspan(static_cast<std::size_t>(i) * width * height, width * height)));
  }
  std::vector<MapFootprint> footprints;
  footprints.reserve(width * height);
  for (std::size_t row = height; row-- > 0;) {
    for (std::size_t at = row * width; at < (row + 1) * width; ++at) {
      footprints.push_back(footprintOf(both[at], both[width * height + at]));
    }
  }
  return footprints;
}

namespace {

/// Whole rows of the target.
std::vector<shared::ProbeData> padded(std::span<const ProbePoint> points, const glm::dvec3& forward) {
  std::vector<shared::ProbeData> rows;
  rows.reserve(points.size() + GNOMON_PROBE_COLUMNS);
  for (const ProbePoint& point : points) {
    rows.push_back(
        {glm::vec4(point.relative, glm::dot(point.relative, forward)), glm::vec4(point.normal, point.group)});
  }
  rows.resize((rows.size() + GNOMON_PROBE_COLUMNS - 1) / GNOMON_PROBE_COLUMNS * GNOMON_PROBE_COLUMNS,
              {glm::vec4(0, 0, 0, 1), glm::vec4(0, 1, 0, 0)});
  return rows;
}

} // namespace

Result<std::vector<float>> probeShadow(const PassInputs& inputs, const Shading& shading,
                                       std::span<const ProbePoint> points) {
  if (points.empty()) return std::vector<float>{};
  const auto program = inputs.programs.get(probeProgram(lightVariant(inputs, shading, false)));
  if (!program) return program.problems();
  const std::vector<shared::ProbeData> rows = padded(points, inputs.camera.forward);
  const Rect whole{0, 0, GNOMON_PROBE_COLUMNS, static_cast<int>(rows.size()) / GNOMON_PROBE_COLUMNS};
  const gl::Texture color({GL_R32F, whole.width, whole.height}, "probes");
  const auto target = gl::Framebuffer::create({{{&color}}, {}}, "probes");
  if (!target) return target.problems();

  bindInputs(inputs);
  const gl::Buffer probes(gl::bytesOf(rows), "probes");
  probes.bindStorage(GNOMON_PROBE_BUFFER);
  const ShadowBindings bindings(shading);
  (*program)->set(GNOMON_DEBUG_LIGHT, shading.debugLight);
  gl::drawFullscreen(**program, {.framebuffer = target->id(), .viewport = whole});

  std::vector<float> visibility(rows.size());
  target->readColor(0, whole, {GL_RED, GL_FLOAT}, std::as_writable_bytes(std::span(visibility)));
  visibility.resize(points.size());
  return visibility;
}

} // namespace gnomon
