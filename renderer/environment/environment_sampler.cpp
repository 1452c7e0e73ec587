#include "renderer/environment/environment_sampler.h"

#include <algorithm>
#include <cmath>

#include "renderer/core/light.h"
#include "renderer/core/parallel.h"

namespace gnomon {
namespace {

constexpr int kSide = EnvironmentSampler::kSide;

// Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors", JCGT 2014.
glm::vec2 foldedOver(const glm::vec2& p) {
  return {std::copysign(1 - std::abs(p.y), p.x), std::copysign(1 - std::abs(p.x), p.y)};
}

/// Of a place of the grid, -1..1: |x| + |y| + |z| = 1.
glm::vec3 onOctahedron(const glm::vec2& p) {
  const float z = 1 - std::abs(p.x) - std::abs(p.y);
  return {z >= 0 ? p : foldedOver(p), z};
}

glm::vec2 placeOf(double column, double row) {
  return {static_cast<float>(2 * column / kSide - 1), static_cast<float>(2 * row / kSide - 1)};
}

/// The place of `sums`, which rise from 0 to 1, where they reach `value`: an index, and how far on to the next.
struct Found {
  int index;
  float part;
};
Found find(const std::array<float, kSide + 1>& sums, float value) {
  const auto above = std::upper_bound(sums.begin() + 1, sums.end() - 1, value);
  const int index = static_cast<int>(above - sums.begin()) - 1;
  const float from = sums[static_cast<std::size_t>(index)];
  const float width = *above - from;
  return {index, width > 0 ? std::clamp((value - from) / width, 0.0f, 1.0f) : 0.5f};
}

/// Running sums of `parts`, of 1 in all, and what they were in all; even where there are none.
double accumulate(const std::array<double, kSide>& parts, std::array<float, kSide + 1>& sums) {
  double whole = 0;
  for (const double part : parts) whole += part;
  double sum = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    sums[i] = static_cast<float>(whole > 0 ? sum / whole : static_cast<double>(i) / kSide);
    sum += parts[i];
  }
  sums[kSide] = 1;
  return whole;
}

std::array<std::uint8_t, kSide> guideOf(const std::array<float, kSide + 1>& sums) {
  std::array<std::uint8_t, kSide> guide{};
  int index = 0;
  for (int i = 0; i < kSide; ++i) {
    while (index + 1 < kSide && sums[static_cast<std::size_t>(index) + 1] <= static_cast<float>(i) / kSide) ++index;
    guide[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(index);
  }
  return guide;
}

constexpr std::size_t kMostPlaces = 8; ///< along a side of a cell

int placesAcross(const EnvironmentMap& map) {
  return std::clamp(map.width / (2 * kSide) + 1, 2, static_cast<int>(kMostPlaces));
}

glm::vec3 texelTowards(const EnvironmentMap& map, const glm::dvec3& direction) {
  const glm::dvec2 place = environmentPlace(direction);
  return map.at(std::clamp(static_cast<int>(place.x * map.width), 0, map.width - 1),
                std::clamp(static_cast<int>(place.y * map.height), 0, map.height - 1));
}

} // namespace

EnvironmentSampler::EnvironmentSampler(const EnvironmentMap& map)
    : EnvironmentSampler([&](const glm::dvec3& direction) { return texelTowards(map, direction); }, placesAcross(map)) {
}

EnvironmentSampler::EnvironmentSampler(const std::function<glm::vec3(const glm::dvec3&)>& radiance, int across)
    : cells_(std::size_t{kSide} * kSide), columns_(kSide) {
  std::array<double, kSide> rowParts{};
  std::array<double, kSide> squares{}, angles{};
  forEach(kSide, [&](std::size_t row) {
    std::array<double, kSide> parts{};
    for (std::size_t column = 0; column < kSide; ++column) {
      glm::dvec3 sum(0);
      double angle = 0;
      for (int i = 0; i < across * across; ++i) {
        const glm::vec3 place = onOctahedron(placeOf(static_cast<double>(column) + (i % across + 0.5) / across,
                                                     static_cast<double>(row) + (i / across + 0.5) / across));
        const double length = glm::length(glm::dvec3(place));
        const double part = 1 / (length * length * length); // of its solid angle
        sum += part * glm::dvec3(radiance(glm::dvec3(place) / length));
        angle += part;
      }
      const glm::vec3 mean(sum / angle);
      const double luminance = luminanceOf(glm::dvec3(mean));
      cells_[row * kSide + column] = glm::vec4(mean, static_cast<float>(luminance));
      parts[column] = luminance * angle;
      squares[row] += luminance * luminance * angle;
      angles[row] += angle;
    }
    rowParts[row] = accumulate(parts, columns_[row]);
  });
  const double whole = accumulate(rowParts, rows_);
  double square = 0, angle = 0;
  for (std::size_t row = 0; row < kSide; ++row) {
    square += squares[row];
    angle += angles[row];
  }
  forEach(kSide, [&](std::size_t row) {
    for (std::size_t column = 0; column < kSide; ++column) {
      const auto [from, to] = std::pair(columns_[row][column], columns_[row][column + 1]);
      const double part = static_cast<double>(rows_[row + 1] - rows_[row]) * static_cast<double>(to - from);
      cells_[row * kSide + column].w = static_cast<float>(part * kSide * kSide / 4); // of the grid's area, which is 4
    }
  });
  guides_.push_back(guideOf(rows_));
  for (const auto& sums : columns_) guides_.push_back(guideOf(sums));
  constexpr double kVaries = 1; // squared standard deviation, of the mean squared
  share_ = whole > 0 && square * angle / (whole * whole) - 1 > kVaries ? 0.5f : 0.0f;
}

const glm::vec4& EnvironmentSampler::cellAt(const glm::vec3& direction) const {
  const glm::vec2 flat = glm::vec2(direction) / sumOf(direction);
  const glm::vec2 place = direction.z >= 0 ? flat : foldedOver(flat);
  const auto cellOf = [](float along) { return std::clamp(static_cast<int>((along + 1) * (kSide / 2)), 0, kSide - 1); };
  return cells_[static_cast<std::size_t>(cellOf(place.y) * kSide + cellOf(place.x))];
}

glm::vec3 EnvironmentSampler::direction(glm::vec2 place) const {
  const Found row = find(rows_, place.y);
  const Found column = find(columns_[static_cast<std::size_t>(row.index)], place.x);
  return glm::normalize(onOctahedron(placeOf(static_cast<double>(column.index) + static_cast<double>(column.part),
                                             static_cast<double>(row.index) + static_cast<double>(row.part))));
}

} // namespace gnomon
