#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE \
  "renderer/cpu/shadow/read_texels.cpp" // NOLINT: Highway's foreach_target.h includes this file again
#include "renderer/cpu/shadow/read_texels.h"

#include <algorithm>
#include <hwy/foreach_target.h>
#include <iterator>
#include <vector>

#include "renderer/core/parallel.h"
#include "renderer/cpu/shadow/debug_light-inl.h"
#include "renderer/cpu/shadow/even_parts-inl.h"
#include "renderer/cpu/shadow/read_texels-inl.h"
#include "renderer/cpu/show/packet-inl.h"
#include "renderer/cpu/surface/receivers-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// For parts of a square of the picture, whose lower left pixel is x, y. Gives those that are done with, a bit each.
unsigned markParts(const ReadQuery& query, std::span<const std::uint32_t> lights, int x, int y,
                   std::span<TexelMarks> marks) {
  const auto alike = [&](std::uint32_t light) { return readsAlike(query.maps.lights[light]); };
  if (query.scene.frame.perspective == 0u || !std::all_of(lights.begin(), lights.end(), alike)) return 0;
  const EvenParts parts = evenParts(query.surfaces, x, y);
  return parts.empty | markCorners(query, lights, parts, marks);
}

/// For the fragments of the square.
void markSquare(const ReadQuery& query, std::span<const std::uint32_t> lights, const FragmentList& list, int x, int y,
                std::span<TexelMarks> marks) {
  const SampleMeans means = sampleMeans(query.surfaces.samples);
  for (std::size_t i = 0; i < list.count; i += kLanes) {
    const Receiver receiver = receiversOf(query.scene, packetAt(list, i, x, y, means).fragments);
    for (const std::uint32_t light : lights) {
      const LightData& data = query.maps.lights[light];
      markMapReads(query.maps, data, receiver, towardsLight(data, receiver.relative), marks);
    }
  }
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::cpu {
namespace {

GNOMON_EXPORT_KERNEL(markParts);
GNOMON_EXPORT_KERNEL(markSquare);

/// The blocks of four by four pixels that make up parts of a square.
unsigned blocksOf(unsigned parts) {
  constexpr std::uint32_t kBlocks[] = {0x0033, 0x00cc, 0x3300, 0xcc00};
  unsigned blocks = 0;
  for (unsigned part = 0; part < std::size(kBlocks); ++part) blocks |= (parts >> part & 1u) * kBlocks[part];
  return blocks;
}

bool readsMap(const shared::LightData& light) {
  return light.tileCount > 0 && light.visibilityLayer == 0;
}

/// The lights that may be asked for in a square of the picture, by what the lists of the squares around it say.
std::vector<std::uint32_t> lightsIn(const ReadQuery& query, int x, int y) {
  std::vector<std::uint32_t> lights;
  const auto add = [&](std::uint32_t light) {
    const bool known = std::find(lights.begin(), lights.end(), light) != lights.end();
    if (!known && readsMap(query.maps.lights[light])) lights.push_back(light);
  };
  if (query.lightLists.empty()) {
    for (std::uint32_t i = 0; i < query.maps.lights.size(); ++i) add(i);
    return lights;
  }
  if (query.debugLight >= 0) add(static_cast<std::uint32_t>(query.debugLight));
  static_assert(GNOMON_REGION_SIZE % kTileSide == 0);
  const int columns = (query.scene.width + GNOMON_REGION_SIZE - 1) / GNOMON_REGION_SIZE;
  // Lists count from the top of the picture, where whole squares begin elsewhere.
  const int top = std::max(query.scene.height - y - kTileSide, 0), bottom = query.scene.height - 1 - y;
  for (int row = top / GNOMON_REGION_SIZE; row <= bottom / GNOMON_REGION_SIZE; ++row) {
    const auto square = static_cast<std::size_t>(row * columns + x / GNOMON_REGION_SIZE);
    for (std::uint32_t k = query.lightLists[2 * square]; k < query.lightLists[2 * square + 1]; ++k) {
      add(query.lightLists[k]);
    }
  }
  return lights;
}

} // namespace

void markReadTexels(const ReadQuery& query, std::span<TexelMarks> marks) {
  if (std::none_of(query.maps.lights.begin(), query.maps.lights.end(), readsMap)) return;
  const auto across = static_cast<std::size_t>((query.scene.width + kTileSide - 1) / kTileSide);
  const auto up = static_cast<std::size_t>((query.scene.height + kTileSide - 1) / kTileSide);
  forEachPiece(across * up, 8, [&](std::size_t first, std::size_t last) {
    FragmentList list;
    for (std::size_t i = first; i < last; ++i) {
      const int x = static_cast<int>(i % across) * kTileSide;
      const int y = static_cast<int>(i / across) * kTileSide;
      const std::vector<std::uint32_t> lights = lightsIn(query, x, y);
      const unsigned done = GNOMON_KERNEL(markParts)(query, lights, x, y, marks);
      listFragments(query.surfaces, x, y, list, blocksOf(done));
      if (list.count > 0) GNOMON_KERNEL(markSquare)(query, lights, list, x, y, marks);
    }
  });
}

} // namespace gnomon::cpu
#endif
