#include "renderer/environment/read_environment.h"

#include "protocol/spec/limits.h"
#include "renderer/environment/environment_checks.h"
#include "renderer/environment/rgbe_file.h"
#include "renderer/image/image_codec.h"

namespace gnomon {
namespace {

Result<EnvironmentMap> readExr(std::span<const std::uint8_t> file) {
  const auto size = exrColorSize(file);
  if (!size) return size.problems();
  if (const Status fits = checkEnvironmentSize({size->width, size->height}); !fits) return fits.problems();
  const auto image = decodeExrColor(file, kLimits.maxEnvironmentWidth);
  if (!image) return image.problems();
  const auto* numbers = pixelsAs<float>(*image);
  EnvironmentMap map{image->width, image->height, {}};
  map.texels.reserve(numbers->size() / 3);
  for (std::size_t at = 0; at < numbers->size(); at += 3) {
    map.texels.emplace_back((*numbers)[at], (*numbers)[at + 1], (*numbers)[at + 2]);
  }
  return map;
}

} // namespace

bool isEnvironmentFile(std::span<const std::uint8_t> file) {
  return isRgbe(file) || isExr(file);
}

std::optional<glm::ivec2> environmentSize(std::span<const std::uint8_t> file) {
  if (isExr(file)) {
    const auto size = exrColorSize(file);
    return size ? std::optional(glm::ivec2(size->width, size->height)) : std::nullopt;
  }
  const auto size = rgbeSize(file);
  return size ? std::optional(*size) : std::nullopt;
}

Result<EnvironmentMap> readEnvironment(std::span<const std::uint8_t> file) {
  auto map = isExr(file) ? readExr(file) : readRgbe(file);
  if (!map) return map;
  if (const Status sound = checkEnvironmentTexels(*map); !sound) return sound.problems();
  return map;
}

} // namespace gnomon
