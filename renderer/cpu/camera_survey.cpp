#include "renderer/cpu/camera_survey.h"

#include <algorithm>
#include <functional>

#include "renderer/core/parallel.h"
#include "renderer/cpu/raster/depth_spans.h"
#include "renderer/cpu/surface/material_holes.h"
#include "renderer/prepare/box_depths.h"
#include "renderer/prepare/cluster_choice.h"

namespace gnomon::cpu {

std::vector<RasterDraw> rasterDraws(const FrameScene& scene, DrawUse use, std::span<const std::uint8_t> keep) {
  const DrawList list = buildDrawList(scene.scene, scene.view, scene.geometry, use, keep);
  std::vector<RasterDraw> draws;
  for (const DrawGroup& group : list.groups) {
    // Where facing and holes don't matter draws share a group, whatever their material.
    const bool holed =
        group.material >= 0 && readsMaterial(scene.scene.materials[static_cast<std::size_t>(group.material)], use);
    for (const DrawRange& range : std::span(list.ranges).subspan(group.firstRange, group.rangeCount)) {
      const Instance& instance = scene.view.instances[range.instance];
      const Primitive& primitive = scene.scene.primitives[static_cast<std::size_t>(instance.primitive)];
      const std::uint32_t firstCluster = (range.firstIndex - primitive.firstIndex) / (3 * kClusterTriangles);
      const std::uint32_t clusters = (range.indexCount / 3 + kClusterTriangles - 1) / kClusterTriangles;
      for (std::uint32_t i = 0; i < clusters; ++i) {
        draws.push_back({scene.geometry.firstSlot[range.instance] + firstCluster + i, group.facing, holed});
      }
    }
  }
  return draws;
}

std::vector<glm::mat4> clipFromLocal(const FrameScene& scene, const glm::dmat4& clipFromRelative) {
  std::vector<glm::mat4> matrices;
  matrices.reserve(scene.geometry.instances.size());
  for (const PlacedInstance& instance : scene.geometry.instances) {
    matrices.emplace_back(clipFromRelative * instance.relativeFromLocal);
  }
  return matrices;
}

namespace {

DepthSpan spanOf(const CameraView& camera, const DepthEnds& ends) {
  if (ends.nearest == 0) return {};
  const auto depthOf = [&](float depth) { return static_cast<float>(viewDepthOf(camera, depth)); };
  return {depthOf(ends.nearest), depthOf(ends.farthest), ends.least == 0};
}

/// `ends`: as depthEnds gives them, of the rows from one to another.
template <class Ends>
ReceiverDepths depthBlocks(const CameraView& camera, const DepthBuffer& buffer, const Ends& endsOf) {
  static_assert(kSurveyBlock % kBlockSide == 0);
  ReceiverDepths grid = emptyDepths(buffer.width, buffer.height);
  grid.blocks.resize(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows));
  forEach(static_cast<std::size_t>(grid.rows), [&](std::size_t row) {
    const int highest = buffer.height - 1 - static_cast<int>(row) * grid.blockSize; // rows count from the top
    const int lowest = std::max(highest + 1 - grid.blockSize, 0);
    const std::vector<DepthEnds> ends = endsOf(lowest, highest, grid.blockSize);
    for (std::size_t i = 0; i < ends.size(); ++i) grid.blocks[row * ends.size() + i] = spanOf(camera, ends[i]);
  });
  for (const DepthSpan& span : grid.blocks) {
    if (span.empty()) continue;
    if (grid.range.empty()) grid.range = span;
    grid.range.nearest = std::min(grid.range.nearest, span.nearest);
    grid.range.farthest = std::max(grid.range.farthest, span.farthest);
  }
  return grid;
}

ReceiverDepths depthBlocks(const CameraView& camera, const DepthBuffer& buffer) {
  return depthBlocks(camera, buffer, [&](int y0, int y1, int side) { return depthEnds(buffer, y0, y1, side); });
}

/// What is seen of the surfaces of some receiver groups.
ReceiverDepths depthsOfPart(const CameraRaster& camera, const Survey& survey, std::uint32_t groups) {
  const std::vector<std::uint8_t> slots = slotsOfGroups(camera.scene.geometry, groups, survey.visible);
  if (slots == survey.visible) return survey.seen.all;
  return depthBlocks(camera.camera, survey.buffer,
                     [&](int y0, int y1, int side) { return depthEnds(survey.buffer, y0, y1, side, slots); });
}

/// `fresh`: as RasterInput's.
void addSlots(const CameraRaster& camera, std::span<const std::uint8_t> keep, bool fresh, DepthBuffer& buffer,
              std::uint64_t& triangles) {
  const std::vector<glm::mat4> clip =
      clipFromLocal(camera.scene, clipFromView(camera.camera) * viewFromRelative(camera.camera));
  const std::vector<RasterDraw> draws = rasterDraws(camera.scene, DrawUse::survey, keep);
  HolesInput seen{camera.scene, camera.textures, clip, glm::ivec2(buffer.width, buffer.height)};
  seen.masks = &camera.masks;
  const MaterialHoles material(seen);
  const Holes* holes = camera.coverage != nullptr ? camera.coverage : &material;
  triangles += raster({camera.scene.scene, camera.scene.slots, clip, draws, holes, nullptr, fresh},
                      DepthRange::reversed, buffer, camera.scratch);
}

} // namespace

Survey surveyScene(const CameraRaster& camera, int samples, std::span<const std::uint32_t> parts, DepthBuffer storage) {
  const FrameScene& scene = camera.scene;
  const SurveyInput input{scene.scene, scene.view, scene.geometry, camera.camera, camera.nodes};
  const std::vector<std::uint8_t> inView = slotsInView(input);
  std::vector<std::uint8_t> drawn = firstToDraw(input, inView);
  Survey survey;
  survey.buffer = unfilledBuffer(scene.width, scene.height, samples, true, std::move(storage));
  addSlots(camera, drawn, true, survey.buffer, survey.triangles);
  survey.seen.all = depthBlocks(camera.camera, survey.buffer);
  if (drawn != inView) {
    const std::vector<std::uint8_t> rest =
        unhiddenBoxes(camera.camera, survey.seen.all, scene.geometry.slotBounds, without(inView, drawn));
    addSlots(camera, rest, false, survey.buffer, survey.triangles);
    std::transform(drawn.begin(), drawn.end(), rest.begin(), drawn.begin(), std::bit_or<>());
    survey.seen.all = depthBlocks(camera.camera, survey.buffer);
  }
  survey.visible = visibleBoxes(camera.camera, survey.seen.all, scene.geometry.slotBounds, drawn);
  for (const std::uint32_t groups : parts) survey.seen.parts.push_back(depthsOfPart(camera, survey, groups));
  return survey;
}

DepthBuffer rasterVisible(const CameraRaster& camera, const Survey& survey, int samples, std::uint64_t& triangles) {
  DepthBuffer buffer = unfilledBuffer(camera.scene.width, camera.scene.height, samples, true);
  addSlots(camera, survey.visible, true, buffer, triangles);
  return buffer;
}

void rasterOver(const CameraRaster& camera, std::span<const std::uint8_t> keep, DepthBuffer& buffer,
                std::uint64_t& triangles) {
  addSlots(camera, keep, false, buffer, triangles);
}

} // namespace gnomon::cpu
