#include "renderer/reference/lit_fronts.h"

#include <algorithm>

namespace gnomon {

void LitFronts::set(std::size_t run, const RunFronts& fronts) {
  std::uint64_t lit = 0, mixed = 0;
  for (std::uint32_t i = 0; i < TriangleBoxes::kRunTriangles; ++i) {
    lit += fronts.of(i) == Front::lit ? 1 : 0;
    mixed += fronts.of(i) == Front::mixed ? 1 : 0;
  }
  runs_[run].store(fronts.bits(), std::memory_order_relaxed);
  known_.fetch_add(1, std::memory_order_relaxed);
  lit_.fetch_add(lit, std::memory_order_relaxed);
  mixed_.fetch_add(mixed, std::memory_order_relaxed);
}

bool LitFronts::areWorthKnowing() const {
  constexpr std::uint64_t kMany = 64;
  return known_.load(std::memory_order_relaxed) < kMany ||
         2 * lit_.load(std::memory_order_relaxed) > mixed_.load(std::memory_order_relaxed);
}

std::shared_ptr<LitFronts> KeptFronts::of(const LightAndCasters& light, std::size_t runs) {
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(kept_.begin(), kept_.end(), [&](const Kept& kept) { return kept.light == light; });
  if (found == kept_.end()) {
    if (kept_.size() == kMostLights) kept_.erase(kept_.begin());
    kept_.push_back({light, nullptr});
    return nullptr;
  }
  std::rotate(found, found + 1, kept_.end());
  Kept& last = kept_.back();
  if (!last.fronts) last.fronts = std::make_shared<LitFronts>(runs);
  return last.fronts->areWorthKnowing() ? last.fronts : nullptr;
}

} // namespace gnomon
