#include "renderer/techniques/picture_points.h"

#include <algorithm>

#include "renderer/techniques/neighbours.h"

namespace gnomon {

ShownNumbers inOrder(const SampleGrid& grid, std::span<const std::uint32_t> numbers) {
  ShownNumbers shown{numbers, {}, {}, 1};
  const auto samples = static_cast<std::uint32_t>(grid.samples());
  for (int x = 0; x < grid.width; ++x) shown.ofColumn.push_back(static_cast<std::uint32_t>(x) * samples);
  const std::uint32_t row = static_cast<std::uint32_t>(grid.width) * samples;
  for (int y = 0; y < grid.height; ++y) shown.ofRow.push_back(static_cast<std::uint32_t>(y) * row);
  return shown;
}

bool ShownNumbers::areAll(std::uint32_t number, int y, int first, int last, std::uint32_t sample) const {
  constexpr int kTogether = 4; // often side by side, in rows as in blocks
  const std::uint32_t* row = numbers.data() + ofRow.data()[y] + sample * step;
  const std::uint32_t* columns = ofColumn.data();
  std::uint32_t differs = 0;
  int x = first;
  for (; x + kTogether <= last && columns[x + kTogether - 1] == columns[x] + kTogether - 1; x += kTogether) {
    for (int i = 0; i < kTogether; ++i) differs |= row[columns[x] + static_cast<std::uint32_t>(i)] ^ number;
  }
  for (; x < last; ++x) differs |= row[columns[x]] ^ number;
  return differs == 0;
}

bool PicturePoints::showsSeveral(const glm::ivec2& pixel) const {
  for (std::uint32_t i = 1; i < grid_.samples(); ++i) {
    if (shown_.at(pixel.x, pixel.y, i) != numberAt(pixel)) return true;
  }
  return false;
}

std::optional<std::uint32_t> PicturePoints::onlyNumberIn(const Rect& block) const {
  const std::uint32_t number = numberAt({block.x, block.y});
  if (numberAt({block.x + block.width - 1, block.y + block.height - 1}) != number) return std::nullopt;
  for (int y = block.y; y < block.y + block.height; ++y) {
    if (!shown_.areAll(number, y, block.x, block.x + block.width)) return std::nullopt;
  }
  return number;
}

std::optional<std::uint32_t> PicturePoints::onlyNumberOfSamplesIn(const Rect& block) const {
  const auto number = onlyNumberIn(block);
  const auto samples = static_cast<std::uint32_t>(grid_.samples());
  if (!number || samples == 1) return number;
  for (int y = block.y; y < block.y + block.height; ++y) {
    for (std::uint32_t i = 1; i < samples; ++i) {
      if (!shown_.areAll(*number, y, block.x, block.x + block.width, i)) return std::nullopt;
    }
  }
  return number;
}

DrawnBlock PicturePoints::drawnBlock(const Rect& block, std::uint32_t number) const {
  DrawnBlock drawn;
  const glm::vec2 sample = grid_.positions.front();
  const glm::ivec2 first(block.x, block.y);
  const glm::ivec2 last(block.x + block.width - 1, block.y + block.height - 1);
  drawn.first = placeIn(grid_, grid_.numberOf(first), sample);
  drawn.last = placeIn(grid_, grid_.numberOf(last), sample);
  drawn.shown = placed(number);
  return drawn;
}

DrawnPlaces PicturePoints::drawn(const ShownSamples& shown) const {
  DrawnPlaces places;
  const auto height = static_cast<float>(grid_.height);
  for (std::size_t i = 0; i < shown.count; ++i) {
    const glm::vec2 sample = grid_.positions.data()[shown.samples[i]];
    places.x[i] = static_cast<float>(shown.pixels[i].x) + sample.x;
    places.y[i] = height - (static_cast<float>(shown.pixels[i].y) + sample.y);
  }
  numbers_.of({shown.numbers, shown.count}, places.shown);
  return places;
}

std::vector<SurfacePoint> PicturePoints::traced(std::span<const std::uint32_t> pixels) const {
  const std::vector<glm::vec2> places = samplesOf(grid_, pixels);
  std::vector<SurfacePoint> points(places.size());
  camera_.firstHits(places, points);
  return points;
}

std::vector<std::uint32_t> PicturePoints::besideMasks() const {
  if (masks_.empty()) return {};
  return pixelsWhere(grid_, masks_, [](std::uint8_t /*least*/, std::uint8_t most) { return most != 0; });
}

std::vector<glm::vec2> samplesOf(const SampleGrid& grid, std::span<const std::uint32_t> pixels) {
  std::vector<glm::vec2> places;
  places.reserve(pixels.size() * grid.samples());
  for (const std::uint32_t pixel : pixels) {
    for (const glm::vec2 position : grid.positions) places.push_back(placeIn(grid, pixel, position));
  }
  return places;
}

} // namespace gnomon
