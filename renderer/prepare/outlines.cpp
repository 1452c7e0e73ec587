#include "renderer/prepare/outlines.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "renderer/core/cofactors.h"
#include "renderer/core/light.h"
#include "renderer/core/parallel.h"
#include "renderer/core/vec3.h"

namespace gnomon {

namespace {

/// Cosine of normal and light up to which a face counts as steep; rounded up. Faces on edge are among them, so that no
/// rounding tells their side.
const float kSteepCosine = 1.0f / std::sqrt(1.0f + kSteepest * kSteepest) + 1e-3f;

enum class Facing : std::int8_t { away, steep, towards };

/// How the triangles of one instance lie to the light.
struct FacingTest {
  glm::mat3 worldFromLocal;
  glm::mat3 normalFromLocal; ///< its cofactors: turns normals, whatever the scale
  glm::vec3 toLight{0};      ///< in the world; directional: unit length
  glm::vec3 light{0};        ///< spot and point: relative to the instance's origin, in the world
  bool directional = true;

  float cosine(glm::vec3 normal, glm::vec3 corner) const {
    const glm::vec3 turned = normalFromLocal * normal;
    const glm::vec3 towardsLight = directional ? toLight : light - worldFromLocal * corner;
    const float lengths = glm::length(turned) * glm::length(towardsLight);
    return lengths > 0 ? glm::dot(turned, towardsLight) / lengths : 0.0f;
  }
};

FacingTest facingTest(const OutlineInput& input, const Instance& instance) {
  FacingTest test;
  const glm::dmat3 linear(instance.worldFromLocal);
  const glm::dmat3 normals = cofactors(linear);
  const double size = std::max({glm::length(normals[0]), glm::length(normals[1]), glm::length(normals[2])});
  test.worldFromLocal = glm::mat3(linear);
  test.normalFromLocal = glm::mat3(size > 0 ? normals / size : normals);
  test.directional = input.light.type == LightType::directional;
  if (test.directional) {
    test.toLight = glm::vec3(-directionOf(input.light));
  } else {
    test.light = glm::vec3(toVector(*input.light.position) - glm::dvec3(instance.worldFromLocal[3]));
  }
  return test;
}

/// The edges of an instance that are outlines, as indices into its mesh.
std::vector<std::uint32_t> outlineEdges(const OutlineInput& input, const Instance& instance) {
  const Primitive& primitive = input.scene.primitives[static_cast<std::size_t>(instance.primitive)];
  const EdgeMesh& mesh = input.meshes[static_cast<std::size_t>(instance.primitive)];
  const FacingTest test = facingTest(input, instance);
  std::vector<Facing> facing(mesh.normals.size());
  for (std::size_t i = 0; i < facing.size(); ++i) {
    const std::uint32_t index = input.scene.indices[primitive.firstIndex + 3 * i];
    const float cosine = test.cosine(mesh.normals[i], input.scene.positions[primitive.baseVertex + index]);
    facing[i] = std::abs(cosine) <= kSteepCosine ? Facing::steep : cosine > 0 ? Facing::towards : Facing::away;
  }
  std::vector<std::uint32_t> edges;
  for (std::size_t i = 0; i < mesh.edges.size(); ++i) {
    const MeshEdge& edge = mesh.edges[i];
    const bool open = edge.right == kNoTriangle;
    const Facing left = facing[edge.left];
    if (open || left == Facing::steep || facing[edge.right] != left) edges.push_back(static_cast<std::uint32_t>(i));
  }
  return edges;
}

bool isDrawn(const OutlinedTile& tile, std::uint32_t firstSlot, std::uint32_t triangle) {
  return triangle != kNoTriangle && tile.casters.slots[firstSlot + triangle / kClusterTriangles] != 0;
}

void stampInstance(const OutlineInput& input, std::size_t index, const std::vector<std::uint32_t>& edges,
                   const OutlinedTile& tile, Stamps& stamps) {
  const Instance& instance = input.view.instances[index];
  const Primitive& primitive = input.scene.primitives[static_cast<std::size_t>(instance.primitive)];
  const std::uint32_t firstSlot = input.geometry.firstSlot[index];
  glm::dmat4 anchored = instance.worldFromLocal;
  anchored[3] -= glm::dvec4(input.anchor, 0.0);
  const glm::dmat4 clipFromLocal = tile.tile.clipFromAnchored * anchored;
  const auto clip = [&](std::uint32_t vertex) {
    return clipFromLocal * glm::dvec4(glm::dvec3(input.scene.positions[primitive.baseVertex + vertex]), 1.0);
  };
  const Material& material = input.scene.materials[static_cast<std::size_t>(materialOf(input.scene, instance))];
  if (material.alphaMode != AlphaMode::opaque) {
    const std::uint32_t* indices = input.scene.indices.data() + primitive.firstIndex;
    for (std::uint32_t i = 0; i < primitive.indexCount / 3; ++i) {
      if (!isDrawn(tile, firstSlot, i)) continue;
      stamps.stampTriangle(clip(indices[3 * i]), clip(indices[3 * i + 1]), clip(indices[3 * i + 2]));
    }
    return;
  }
  const EdgeMesh& mesh = input.meshes[static_cast<std::size_t>(instance.primitive)];
  for (const std::uint32_t i : edges) {
    const MeshEdge& edge = mesh.edges[i];
    if (!isDrawn(tile, firstSlot, edge.left) && !isDrawn(tile, firstSlot, edge.right)) continue;
    stamps.stampEdge(clip(edge.from), clip(edge.to));
  }
}

bool isDrawn(const OutlineInput& input, std::size_t instance, const OutlinedTile& tile) {
  const auto first = tile.casters.slots.begin() + input.geometry.firstSlot[instance];
  const auto last = tile.casters.slots.begin() + input.geometry.firstSlot[instance + 1];
  return std::any_of(first, last, [](std::uint8_t slot) { return slot != 0; });
}

} // namespace

std::vector<TileOutlines> outlinesOf(const OutlineInput& input, const std::vector<OutlinedTile>& tiles) {
  const std::size_t count = input.view.instances.size();
  std::vector<std::vector<std::uint32_t>> edges(count);
  forEach(count, [&](std::size_t i) {
    const bool drawn =
        std::any_of(tiles.begin(), tiles.end(), [&](const OutlinedTile& tile) { return isDrawn(input, i, tile); });
    if (drawn) edges[i] = outlineEdges(input, input.view.instances[i]);
  });
  std::vector<TileOutlines> outlines(tiles.size());
  forEach(tiles.size(), [&](std::size_t t) {
    Stamps stamps(tiles[t].tile.rect.width, tiles[t].tile.rect.height);
    for (std::size_t i = 0; i < count; ++i) {
      if (isDrawn(input, i, tiles[t])) stampInstance(input, i, edges[i], tiles[t], stamps);
    }
    outlines[t] = stamps.take();
  });
  return outlines;
}

namespace {

/// How near to a cell what passes marks it, texels: rounding of the places that are looked up.
constexpr double kReach = 0.02;

/// Texels that an edge is followed at once.
constexpr double kStep = 0.5;

/// Of a clip-space w: what lies behind the light, or in it, is cut off here.
constexpr double kLeastW = 1e-30;

/// The part of a..b where `distance` (of a, of b) is not negative.
struct Part {
  glm::dvec4 a, b;
};
std::optional<Part> cut(const Part& part, double atA, double atB) {
  if (atA < 0 && atB < 0) return std::nullopt;
  const auto between = [&] { return part.a + (part.b - part.a) * (atA / (atA - atB)); };
  if (atA < 0) return Part{between(), part.b};
  if (atB < 0) return Part{part.a, between()};
  return part;
}

} // namespace

Stamps::Stamps(int width, int height)
    : width_(width), height_(height), cells_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

void Stamps::fill(const Span& box) {
  const bool somewhere = box.lowest.x <= box.highest.x && box.lowest.y <= box.highest.y;
  if (!somewhere) return; // not a number: nothing is drawn there
  // Cell i runs from i + 0.5 to i + 1.5.
  const auto cellAt = [](double place) { return static_cast<int>(std::floor(std::clamp(place, -1e6, 1e6) - 0.5)); };
  const auto first = [&](double low) { return cellAt(low - kReach); };
  const auto last = [&](double high) { return cellAt(high + kReach); };
  const int left = std::max(first(box.lowest.x), 0);
  const int right = std::min(last(box.highest.x), width_ - 1);
  if (right < left) return;
  const int top = std::min(last(box.highest.y), height_ - 1);
  for (int y = std::max(first(box.lowest.y), 0); y <= top; ++y) {
    const auto row = cells_.begin() + static_cast<std::ptrdiff_t>(y) * width_;
    std::fill(row + left, row + right + 1, std::uint8_t{255});
  }
}

void Stamps::stampEdge(const glm::dvec4& from, const glm::dvec4& to) {
  // Cut to the tile and what reaches into it, before the division, so that nothing large is left.
  const double wide = 1.0 + 4.0 / width_;
  const double high = 1.0 + 4.0 / height_;
  std::optional<Part> part = cut({from, to}, from.w - kLeastW, to.w - kLeastW);
  const auto cutBy = [&](auto distance) {
    if (part) part = cut(*part, distance(part->a), distance(part->b));
  };
  cutBy([&](const glm::dvec4& p) { return wide * p.w - p.x; });
  cutBy([&](const glm::dvec4& p) { return wide * p.w + p.x; });
  cutBy([&](const glm::dvec4& p) { return high * p.w - p.y; });
  cutBy([&](const glm::dvec4& p) { return high * p.w + p.y; });
  if (!part) return;

  const auto texel = [&](const glm::dvec4& p) {
    return (glm::dvec2(p) / p.w * 0.5 + 0.5) * glm::dvec2(width_, height_);
  };
  const glm::dvec2 a = texel(part->a);
  const glm::dvec2 step = texel(part->b) - a;
  const double length = std::max(std::abs(step.x), std::abs(step.y));
  if (!(length < 1e6)) return; // not a number: no such edge is drawn
  const int steps = std::max(1, static_cast<int>(std::ceil(length / kStep)));
  for (int i = 0; i < steps; ++i) {
    const glm::dvec2 p = a + step * (static_cast<double>(i) / steps);
    const glm::dvec2 q = a + step * (static_cast<double>(i + 1) / steps);
    fill({glm::min(p, q), glm::max(p, q)});
  }
}

void Stamps::stampTriangle(const glm::dvec4& a, const glm::dvec4& b, const glm::dvec4& c) {
  if (a.w <= kLeastW && b.w <= kLeastW && c.w <= kLeastW) return;
  if (a.w <= kLeastW || b.w <= kLeastW || c.w <= kLeastW) {
    fill({glm::dvec2(0.0), glm::dvec2(width_, height_)}); // it reaches behind the light: anywhere
    return;
  }
  const auto texel = [&](const glm::dvec4& p) {
    return (glm::dvec2(p) / p.w * 0.5 + 0.5) * glm::dvec2(width_, height_);
  };
  const glm::dvec2 ta = texel(a);
  const glm::dvec2 tb = texel(b);
  const glm::dvec2 tc = texel(c);
  fill({glm::min(glm::min(ta, tb), tc), glm::max(glm::max(ta, tb), tc)});
}

} // namespace gnomon
