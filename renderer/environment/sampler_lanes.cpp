#include <cmath>

#include "renderer/core/instruction_sets.h"
#include "renderer/environment/environment_sampler.h"

namespace gnomon {
namespace {

constexpr int kSide = EnvironmentSampler::kSide;
constexpr std::size_t kLanes = EnvironmentSampler::kLanes;

using Directions = EnvironmentSampler::Directions;

/// -1..1, of an octahedron's side: -1 or 1 whose sign is that of `of`.
[[gnu::always_inline]] inline float signOf(float of) {
  return of < 0 ? -1.0f : 1.0f;
}

GNOMON_FOR_EACH_INSTRUCTION_SET void lookUpAll(const float* cells, const Directions& directions,
                                               EnvironmentSampler::Light& light) {
  alignas(64) int at[kLanes];
  alignas(64) float cubed[kLanes];
  for (std::size_t i = 0; i < kLanes; ++i) {
    const float sum = std::fabs(directions.x[i]) + std::fabs(directions.y[i]) + std::fabs(directions.z[i]);
    const float x = directions.x[i] / sum;
    const float y = directions.y[i] / sum;
    const bool folded = directions.z[i] < 0;
    const float across = folded ? (1 - std::fabs(y)) * signOf(x) : x;
    const float up = folded ? (1 - std::fabs(x)) * signOf(y) : y;
    const int column = static_cast<int>((across + 1) * (kSide / 2));
    const int row = static_cast<int>((up + 1) * (kSide / 2));
    const int kept = column < 0 ? 0 : (column < kSide ? column : kSide - 1);
    at[i] = 4 * ((row < 0 ? 0 : (row < kSide ? row : kSide - 1)) * kSide + kept);
    cubed[i] = sum * sum * sum;
  }
  for (std::size_t i = 0; i < kLanes; ++i) {
    light.red[i] = cells[at[i]];
    light.green[i] = cells[at[i] + 1];
    light.blue[i] = cells[at[i] + 2];
    light.density[i] = cells[at[i] + 3] / cubed[i];
  }
}

GNOMON_FOR_EACH_INSTRUCTION_SET void ontoSphere(const float (&column)[kLanes], const float (&row)[kLanes],
                                                Directions& directions) {
  for (std::size_t i = 0; i < kLanes; ++i) {
    const float x = column[i] * (2.0f / kSide) - 1;
    const float y = row[i] * (2.0f / kSide) - 1;
    const float z = 1 - std::fabs(x) - std::fabs(y);
    const float turnedX = z < 0 ? (1 - std::fabs(y)) * signOf(x) : x;
    const float turnedY = z < 0 ? (1 - std::fabs(x)) * signOf(y) : y;
    const float over = 1 / std::sqrt(turnedX * turnedX + turnedY * turnedY + z * z);
    directions.x[i] = turnedX * over;
    directions.y[i] = turnedY * over;
    directions.z[i] = z * over;
  }
}

/// Where `sums`, which rise from 0 to 1, reach `value`, 0..1: the last of kSide that is no more.
int lastBelow(const float* sums, const std::uint8_t* guide, float value) {
  const int at = static_cast<int>(value * kSide);
  int index = guide[at < 0 ? 0 : (at < kSide ? at : kSide - 1)];
  while (index + 1 < kSide && sums[index + 1] <= value) ++index;
  return index;
}

/// That, and how far on to the next.
float placeAt(const float* sums, int index, float value) {
  const float width = sums[index + 1] - sums[index];
  const float part = width > 0 ? (value - sums[index]) / width : 0.5f;
  return static_cast<float>(index) + (part < 0 ? 0.0f : (part < 1 ? part : 1.0f));
}

} // namespace

void EnvironmentSampler::lookUp(const Directions& directions, Light& light) const {
  lookUpAll(&cells_.front().x, directions, light);
}

void EnvironmentSampler::aim(const float (&across)[kLanes], const float (&up)[kLanes], const int (&asked)[kLanes],
                             Directions& directions) const {
  alignas(64) float column[kLanes] = {}, row[kLanes] = {};
  for (std::size_t i = 0; i < kLanes; ++i) {
    if (asked[i] == 0) continue;
    const int index = lastBelow(rows_.data(), guides_.front().data(), up[i]);
    row[i] = placeAt(rows_.data(), index, up[i]);
    const float* sums = columns_.data()[index].data();
    column[i] = placeAt(sums, lastBelow(sums, guides_.data()[index + 1].data(), across[i]), across[i]);
  }
  ontoSphere(column, row, directions);
}

} // namespace gnomon
