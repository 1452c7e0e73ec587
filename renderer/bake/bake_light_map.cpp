#include "renderer/bake/bake_light_map.h"

#include <cmath>

#include "renderer/bake/bake_texels.h"

namespace gnomon {
namespace {

constexpr std::size_t kPoints = 512; ///< that are traced together

/// Of one light.
class LightSums : public TexelSums {
 public:
  LightSums(const TracedLight& light, const Rect& rect, int samplesOfPlace, const GoOn& goOn)
      : light_(light), goOn_(goOn), rect_(rect), samples_(samplesOfPlace), sums_(texels()), counts_(texels()) {}

  void add(const TexelPlace& place) override {
    points_.push_back(light_.pointFacing(place.triangle, place.weights));
    texels_.push_back(texelIn(rect_, place.texel));
    if (points_.size() == kPoints) trace();
  }

  std::vector<std::vector<std::int32_t>> means() override {
    trace();
    std::vector<std::int32_t> means(texels(), kUncovered);
    for (std::size_t i = 0; i < means.size(); ++i) {
      if (counts_[i] > 0) means[i] = static_cast<std::int32_t>(std::lround(sums_[i] / counts_[i] * 65535));
    }
    return {std::move(means)};
  }

 private:
  std::size_t texels() const { return texelsIn(rect_); }

  void trace() {
    shares_.resize(points_.size());
    stopIfAsked();
    if (goOn_()) light_.visibility(points_, samples_, shares_);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      sums_[texels_[i]] += double{shares_[i]};
      ++counts_[texels_[i]];
    }
    points_.clear();
    texels_.clear();
  }

  const TracedLight& light_;
  GoOn goOn_;
  Rect rect_;
  int samples_;
  std::vector<SurfacePoint> points_;
  std::vector<std::size_t> texels_; ///< of each point
  std::vector<float> shares_;
  std::vector<double> sums_;
  std::vector<int> counts_;
};

} // namespace

std::optional<LightMap> bakeLightMap(const TraceInput& rays, int light, const LightMapLayout& layout, int samples,
                                     const Progress& progress) {
  const TracedLight traced(rays, light);
  const auto sums = [&](const Rect& rect, int places, const GoOn& goOn) -> std::unique_ptr<TexelSums> {
    return std::make_unique<LightSums>(traced, rect, (samples + places - 1) / places, goOn);
  };
  auto maps = bakeTexels(layout, 1, sums, progress);
  if (!maps) return std::nullopt;
  return std::move(maps->front());
}

} // namespace gnomon
