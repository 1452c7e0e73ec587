#include "renderer/environment/read_environment.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "protocol/spec/limits.h"
#include "renderer/environment/environment_checks.h"
#include "renderer/environment/rgbe_file.h"
#include "renderer/image/image_codec.h"

namespace gnomon {
namespace {

/// Where red, green and blue are in a layer; nothing = it has none.
std::optional<std::array<std::size_t, 3>> colorsOf(const Image& layer) {
  const auto placeOf = [&](const char* name) {
    return static_cast<std::size_t>(std::ranges::find(layer.channels, name) - layer.channels.begin());
  };
  const std::size_t none = layer.channels.size();
  const std::array places{placeOf("R"), placeOf("G"), placeOf("B")};
  if (std::ranges::find(places, none) == places.end()) return places;
  const std::size_t grey = placeOf("Y");
  return grey < none ? std::optional(std::array{grey, grey, grey}) : std::nullopt;
}

Result<EnvironmentMap> readExr(std::span<const std::uint8_t> file) {
  constexpr std::int64_t kWidth = kLimits.maxEnvironmentWidth;
  const auto layers = decodeExr(file, kLimits.maxEnvironmentWidth, kWidth * kWidth / 2 * 4);
  if (!layers) return layers.problems();
  for (const ExrLayer& layer : *layers) {
    const auto colors = colorsOf(layer.image);
    const auto* numbers = pixelsAs<float>(layer.image);
    if (!colors || numbers == nullptr) continue;
    if (const Status fits = checkEnvironmentSize({layer.image.width, layer.image.height}); !fits) {
      return fits.problems();
    }
    EnvironmentMap map{layer.image.width, layer.image.height, {}};
    map.texels.reserve(numbers->size() / layer.image.channels.size());
    for (std::size_t at = 0; at < numbers->size(); at += layer.image.channels.size()) {
      const float* const texel = numbers->data() + at;
      map.texels.emplace_back(texel[(*colors)[0]], texel[(*colors)[1]], texel[(*colors)[2]]);
    }
    return map;
  }
  return Problem{ProblemCode::unsupportedFeature, "", "The EXR has no layer with colors.", "channels R, G and B, or Y"};
}

} // namespace

bool isEnvironmentFile(std::span<const std::uint8_t> file) {
  return isRgbe(file) || isExr(file);
}

Result<EnvironmentMap> readEnvironment(std::span<const std::uint8_t> file) {
  auto map = isExr(file) ? readExr(file) : readRgbe(file);
  if (!map) return map;
  if (const Status sound = checkEnvironmentTexels(*map); !sound) return sound.problems();
  return map;
}

} // namespace gnomon
