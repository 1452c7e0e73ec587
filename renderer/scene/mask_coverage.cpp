#include "renderer/scene/mask_coverage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "renderer/core/parallel.h"
#include "renderer/scene/texture_reads.h"

namespace gnomon {
namespace {

constexpr int kColumns = 128;   ///< of the places that a row is counted from, as many as rows of them
constexpr int kFinest = 256;    ///< the same of the texture itself
constexpr double kSlack = 1e-3; ///< of a step of alpha, for rounding: what is as large as the cutoff is kept

/// A well mixed number (Wellons, "Prospecting for Hash Functions", 2018: lowbias32).
std::uint32_t mixed(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  return x ^ x >> 16;
}

/// 0..1, the same for all places of a texel of the level that is nearest to the place's.
double hashAt(const MaskPlace& place, const glm::ivec2& size) {
  const double level = std::exp2(-std::floor(place.halvings + 0.5));
  const auto cell = [&](double uv, int texels) {
    const double at = std::floor(uv * texels * level);
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(std::abs(at) < 1e9 ? at : 0));
  };
  return (mixed(cell(place.uv.x, size.x) + mixed(cell(place.uv.y, size.y))) >> 8) * 0x1p-24;
}

std::size_t roundedAlpha(double alpha) {
  return static_cast<std::size_t>(std::clamp(alpha, 0.0, 1.0) * 255 + 0.5);
}

/// Counts places that are spread evenly over the texture, each somewhere in a square of its own.
void countRow(const AlphaLevels& levels, const TextureUse& use, int row, std::span<float> numbers) {
  const int columns = row == 0 ? kFinest : kColumns;
  const glm::dvec2 texel(1.0 / levels.largest().width(), 1.0 / levels.largest().height());
  // A pixel as wide as so many texels; of row 0 as wide as none.
  const double wide = row == 0 ? 0 : std::exp2(0.5 * row);
  const TexturePlace step{{}, {wide * texel.x, 0}, {0, wide * texel.y}};
  std::array<std::uint32_t, 256> counts{};
  for (int y = 0; y < columns; ++y) {
    for (int x = 0; x < columns; ++x) {
      const std::uint32_t hash = mixed(static_cast<std::uint32_t>(y * columns + x));
      TexturePlace place = step;
      place.uv = (glm::dvec2(x, y) + glm::dvec2(hash & 0xffffu, hash >> 16) * 0x1p-16) / static_cast<double>(columns);
      ++counts[roundedAlpha(textureAlpha(levels, use, place))];
    }
  }
  const double all = static_cast<double>(columns) * columns;
  std::uint32_t below = 0;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    numbers[k] = static_cast<float>(below / all);
    below += counts[k];
  }
  numbers[counts.size()] = 1;
}

} // namespace

bool MaskCoverage::countsLevels(const AlphaLevels& levels, const TextureUse& use) {
  return takesLevels(use.minFilter) && levels.count() > 1;
}

MaskCoverage::MaskCoverage(const AlphaLevels& levels, const TextureUse& use)
    : table_((2 * levels.count() - 1) * kRow),
      mixesLevels_(gnomon::mixesLevels(use.minFilter)),
      size_(levels.largest().width(), levels.largest().height()) {
  for (int row = 0; row < rows(); ++row) {
    countRow(levels, use, row, std::span(table_).subspan(static_cast<std::size_t>(row) * kRow, kRow));
  }
}

// As isKept of common_mask_coverage.glsl.
bool MaskCoverage::keeps(const MaskPlace& place, double factor, double cutoff) const {
  const double halvings = mixesLevels_ ? place.halvings : std::ceil(place.halvings - 0.5);
  const std::size_t alpha = roundedAlpha(place.alpha);
  // Where all texels read are empty, or all are filled, ranks say nothing new.
  if (!(halvings > 0) || alpha == 0 || alpha == 255) return place.alpha * factor >= cutoff;
  const double least = std::ceil(255 * cutoff / factor - kSlack);
  if (!(least <= 255)) return false; // nor where the factor is 0
  const double row = std::min(2 * halvings, static_cast<double>(rows() - 1));
  const auto first = static_cast<std::size_t>(row);
  const double share = row - static_cast<double>(first);
  const auto below = [&](std::size_t number) {
    const double one = table_[first * kRow + number];
    return share > 0 ? one + share * (table_[(first + 1) * kRow + number] - one) : one;
  };
  const double low = below(alpha);
  const double rank = low + hashAt(place, size_) * (below(alpha + 1) - low);
  return rank >= table_[static_cast<std::size_t>(std::max(least, 0.0))];
}

MaskCoverages KeptCoverages::of(const Scene& scene, std::span<const std::uint8_t> wanted) {
  const std::lock_guard lock(mutex_);
  std::vector<std::pair<Key, const TextureUse*>> missing;
  std::vector<std::optional<Key>> keys(scene.materials.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (wanted[i] == 0 || !readsAlpha(scene.materials[i])) continue;
    const TextureUse& use = *scene.materials[i].baseColor;
    keys[i] = Key{use.image, use.nearest, use.minFilter};
    if (kept_.try_emplace(*keys[i]).second && takesLevels(use.minFilter)) missing.emplace_back(*keys[i], &use);
  }
  std::vector<std::shared_ptr<const MaskCoverage>> made(missing.size());
  forEach(missing.size(), [&](std::size_t i) {
    const auto& [key, use] = missing[i];
    const auto levels = scene.images[static_cast<std::size_t>(key.image)]->alpha();
    if (MaskCoverage::countsLevels(*levels, *use)) made[i] = std::make_shared<const MaskCoverage>(*levels, *use);
  });
  for (std::size_t i = 0; i < made.size(); ++i) kept_[missing[i].first] = std::move(made[i]);
  MaskCoverages coverages(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (keys[i]) coverages[i] = kept_.at(*keys[i]);
  }
  return coverages;
}

MaskCoverages KeptCoverages::of(const Scene& scene, const SceneView& view) {
  std::vector<std::uint8_t> placed(scene.materials.size());
  for (const Instance& instance : view.instances) placed[static_cast<std::size_t>(materialOf(scene, instance))] = 1;
  return of(scene, placed);
}

MaskCoverages KeptCoverages::of(const Scene& scene) {
  return of(scene, std::vector<std::uint8_t>(scene.materials.size(), 1));
}

} // namespace gnomon
