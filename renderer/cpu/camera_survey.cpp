#include "renderer/cpu/camera_survey.h"

#include <algorithm>
#include <functional>

#include "renderer/core/parallel.h"
#include "renderer/cpu/material_holes.h"
#include "renderer/prepare/box_depths.h"
#include "renderer/prepare/survey_slots.h"

namespace gnomon::cpu {

std::vector<RasterDraw> rasterDraws(const FrameScene& scene, DrawUse use, std::span<const std::uint8_t> keep) {
  const DrawList list = buildDrawList(scene.scene, scene.view, scene.geometry, use, keep);
  std::vector<RasterDraw> draws;
  for (const DrawGroup& group : list.groups) {
    // Where facing and holes don't matter draws share a group, whatever their material.
    const bool holed = group.material >= 0 &&
                       scene.scene.materials[static_cast<std::size_t>(group.material)].alphaMode != AlphaMode::opaque;
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

/// Depths of a block, reversed: 0 = nothing.
struct Depths {
  float nearest = 0;
  float farthest = 2;
  bool open = false;

  void add(float depth) {
    nearest = std::max(nearest, depth);
    farthest = depth > 0 ? std::min(farthest, depth) : farthest;
    open = open || depth == 0;
  }
};

/// Of a row of survey blocks, the `row`th from the top.
std::vector<Depths> rowDepths(const DepthBuffer& buffer, const ReceiverDepths& grid, int row) {
  std::vector<Depths> blocks(static_cast<std::size_t>(grid.columns));
  const int below = std::min((row + 1) * grid.blockSize, buffer.height);
  for (int fromTop = row * grid.blockSize; fromTop < below; ++fromTop) {
    const int y = buffer.height - 1 - fromTop;
    for (int x = 0; x < buffer.width; x += kBlockSide) {
      Depths& block = blocks[static_cast<std::size_t>(x / grid.blockSize)];
      const int last = std::min(kBlockSide, buffer.width - x);
      for (int s = 0; s < buffer.samples; ++s) {
        const float* depths = &buffer.depths[buffer.at(x, y, s)];
        for (int i = 0; i < last; ++i) block.add(depths[i]);
      }
    }
  }
  return blocks;
}

ReceiverDepths depthBlocks(const CameraView& camera, const DepthBuffer& buffer) {
  static_assert(kSurveyBlock % kBlockSide == 0);
  ReceiverDepths grid = emptyDepths(buffer.width, buffer.height);
  grid.blocks.resize(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows));
  forEach(static_cast<std::size_t>(grid.rows), [&](std::size_t row) {
    const std::vector<Depths> depths = rowDepths(buffer, grid, static_cast<int>(row));
    for (std::size_t i = 0; i < depths.size(); ++i) {
      if (depths[i].nearest <= 0) continue;
      grid.blocks[row * depths.size() + i] = {static_cast<float>(viewDepthOf(camera, depths[i].nearest)),
                                              static_cast<float>(viewDepthOf(camera, depths[i].farthest)),
                                              depths[i].open};
    }
  });
  for (const DepthSpan& span : grid.blocks) {
    if (span.empty()) continue;
    if (grid.range.empty()) grid.range = span;
    grid.range.nearest = std::min(grid.range.nearest, span.nearest);
    grid.range.farthest = std::max(grid.range.farthest, span.farthest);
  }
  return grid;
}

void addSlots(const CameraRaster& camera, std::span<const std::uint8_t> keep, DepthBuffer& buffer,
              std::uint64_t& triangles) {
  const std::vector<glm::mat4> clip =
      clipFromLocal(camera.scene, clipFromView(camera.camera) * viewFromRelative(camera.camera));
  const std::vector<RasterDraw> draws = rasterDraws(camera.scene, DrawUse::survey, keep);
  const MaterialHoles material({camera.scene, camera.textures, clip, glm::ivec2(buffer.width, buffer.height)});
  const Holes* holes = camera.coverage != nullptr ? camera.coverage : &material;
  triangles += raster({camera.scene.scene, camera.scene.slots, clip, draws, holes}, DepthRange::reversed, buffer,
                      camera.scratch);
}

} // namespace

Survey surveyScene(const CameraRaster& camera, int samples) {
  const FrameScene& scene = camera.scene;
  const SurveyInput input{scene.scene, scene.view, scene.geometry, camera.camera, camera.nodes};
  const std::vector<std::uint8_t> inView = slotsInView(input);
  std::vector<std::uint8_t> drawn = firstToDraw(input, inView);
  Survey survey;
  survey.buffer = emptyBuffer(scene.width, scene.height, samples, DepthRange::reversed, true);
  addSlots(camera, drawn, survey.buffer, survey.triangles);
  survey.receivers = depthBlocks(camera.camera, survey.buffer);
  if (drawn != inView) {
    const std::vector<std::uint8_t> rest =
        unhiddenBoxes(camera.camera, survey.receivers, scene.geometry.slotBounds, without(inView, drawn));
    addSlots(camera, rest, survey.buffer, survey.triangles);
    std::transform(drawn.begin(), drawn.end(), rest.begin(), drawn.begin(), std::bit_or<>());
    survey.receivers = depthBlocks(camera.camera, survey.buffer);
  }
  survey.visible = visibleBoxes(camera.camera, survey.receivers, scene.geometry.slotBounds, drawn);
  return survey;
}

DepthBuffer rasterVisible(const CameraRaster& camera, const Survey& survey, int samples, std::uint64_t& triangles) {
  DepthBuffer buffer = emptyBuffer(camera.scene.width, camera.scene.height, samples, DepthRange::reversed, true);
  addSlots(camera, survey.visible, buffer, triangles);
  return buffer;
}

} // namespace gnomon::cpu
