#include <algorithm>
#include <cstring>

#include "renderer/cpu/show/show_view.h"
#include "renderer/prepare/draw_list.h"

namespace gnomon::cpu {
namespace {

void add(std::uint32_t triangle, int pixel, int samples, FragmentList& list) {
  list.triangle[list.count] = triangle;
  list.pixel[list.count] = pixel;
  list.samples[list.count] = samples;
  ++list.count;
}

bool isUniform(const std::uint32_t* numbers) {
  std::uint32_t differs = 0;
  for (int i = 0; i < kBlockPlaces; ++i) differs |= numbers[i] ^ numbers[0];
  return differs == 0;
}

/// Every place of the block shows one triangle in all of its samples, or none of the places shows any.
bool isWhole(const std::uint32_t* numbers, int samples) {
  std::uint32_t differs = 0;
  for (int s = 1; s < samples; ++s) {
    for (int i = 0; i < kBlockPlaces; ++i) differs |= numbers[s * kBlockPlaces + i] ^ numbers[i];
  }
  if (differs != 0) return false;
  bool none = false;
  for (int i = 0; i < kBlockPlaces; ++i) none = none || numbers[i] == kNoNumber;
  return !none || isUniform(numbers);
}

void addWhole(const std::uint32_t* numbers, int samples, int firstPixel, FragmentList& list) {
  std::copy_n(numbers, kBlockPlaces, &list.triangle[list.count]);
  for (int i = 0; i < kBlockPlaces; ++i) {
    list.pixel[list.count + static_cast<std::size_t>(i)] = firstPixel + i;
    list.samples[list.count + static_cast<std::size_t>(i)] = (1 << samples) - 1;
  }
  list.count += kBlockPlaces;
}

/// `numbers`: of a block's samples, sixteen each. Places beyond the picture show nothing.
void listBlock(const std::uint32_t* numbers, int samples, int firstPixel, int width, int height, FragmentList& list) {
  for (int place = 0; place < kBlockPlaces; ++place) {
    if (place % kBlockSide >= width || place / kBlockSide >= height) continue;
    int left = (1 << samples) - 1;
    for (int s = 0; s < samples; ++s) {
      if ((left >> s & 1) == 0) continue;
      const std::uint32_t triangle = numbers[s * kBlockPlaces + place];
      int same = 1 << s;
      for (int other = s + 1; other < samples; ++other) {
        same |= static_cast<int>(numbers[other * kBlockPlaces + place] == triangle) << other;
      }
      left &= ~same;
      if (triangle != kNoNumber) add(triangle, firstPixel + place, same, list);
    }
  }
}

} // namespace

void listFragments(const DepthBuffer& buffer, int x, int y, FragmentList& list) {
  list.count = 0;
  for (int block = 0; block < kTileSide / kBlockSide * kTileSide / kBlockSide; ++block) {
    const int column = x + columnOf(block * kBlockPlaces);
    const int row = y + rowOf(block * kBlockPlaces);
    if (column >= buffer.width || row >= buffer.height) continue;
    const std::uint32_t* numbers = &buffer.triangles[buffer.at(column, row)];
    if (column + kBlockSide <= buffer.width && row + kBlockSide <= buffer.height && isWhole(numbers, buffer.samples)) {
      if (numbers[0] != kNoNumber || !isUniform(numbers)) addWhole(numbers, buffer.samples, block * kBlockPlaces, list);
      continue;
    }
    listBlock(numbers, buffer.samples, block * kBlockPlaces, buffer.width - column, buffer.height - row, list);
  }
  if (list.count == 0) return;
  // Whole packets may be read.
  const std::size_t last = list.count - 1;
  for (std::size_t i = list.count; i % 16 != 0; ++i) {
    list.triangle[i] = list.triangle[last];
    list.pixel[i] = list.pixel[last];
    list.samples[i] = list.samples[last];
  }
}

} // namespace gnomon::cpu
