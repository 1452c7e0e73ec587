#pragma once

#include <algorithm>
#include <random>
#include <utility>

#include "renderer/cpu/raster/raster.h"

namespace gnomon::cpu {

using Random = std::mt19937;

inline double between(Random& random, double low, double high) {
  return std::uniform_real_distribution(low, high)(random);
}

/// Triangles that stand in clip space as they are, after `clip`.
struct Mesh {
  Scene scene;
  std::vector<Slot> slots;
  std::vector<RasterDraw> draws;
  glm::mat4 clip{1};

  RasterInput input() const { return {scene, slots, std::span(&clip, 1), draws}; }
};

inline Mesh meshOf(std::vector<glm::vec3> positions, std::vector<std::uint32_t> indices, Facing facing = Facing::both) {
  Mesh mesh;
  mesh.scene.positions = std::move(positions);
  for (std::uint32_t first = 0; first < indices.size(); first += 3 * kClusterTriangles) {
    const auto left = static_cast<std::uint32_t>(indices.size()) - first;
    mesh.draws.push_back({static_cast<std::uint32_t>(mesh.slots.size()), facing});
    mesh.slots.push_back({0, first, std::min(left / 3, kClusterTriangles), 0, 0});
  }
  mesh.scene.welded = std::move(indices);
  return mesh;
}

inline DepthBuffer drawn(const Mesh& mesh, int width, int height, int samples = 1,
                         DepthRange range = DepthRange::reversed) {
  DepthBuffer buffer = unfilledBuffer(width, height, samples, true);
  RasterScratch scratch;
  RasterInput input = mesh.input();
  input.fresh = true;
  raster(input, range, buffer, scratch);
  return buffer;
}

/// A net of triangles over the whole picture and beyond, whose inner corners are moved at random; some of it slivers.
inline Mesh net(Random& random, int cells, double reach) {
  std::vector<glm::vec3> positions;
  for (int y = 0; y <= cells; ++y) {
    for (int x = 0; x <= cells; ++x) {
      const bool inner = x > 0 && x < cells && y > 0 && y < cells;
      const double move = inner ? 0.45 * 2 * reach / cells : 0;
      positions.emplace_back((2.0 * x / cells - 1) * reach + between(random, -move, move),
                             (2.0 * y / cells - 1) * reach + between(random, -move, move), between(random, 0, 1));
    }
  }
  std::vector<std::uint32_t> indices;
  const auto across = static_cast<std::uint32_t>(cells) + 1;
  for (std::uint32_t y = 0; y + 1 < across; ++y) {
    for (std::uint32_t x = 0; x + 1 < across; ++x) {
      const std::uint32_t at = y * across + x;
      indices.insert(indices.end(), {at, at + 1, at + across + 1, at, at + across + 1, at + across});
    }
  }
  return meshOf(std::move(positions), std::move(indices));
}

} // namespace gnomon::cpu
