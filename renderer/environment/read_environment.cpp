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
  EnvironmentMap map{size->width, size->height, {}};
  const Status read = decodeExrColor(file, kLimits.maxEnvironmentWidth, [&](const ImageSize& own) {
    map.texels.resize(static_cast<std::size_t>(own.width) * static_cast<std::size_t>(own.height));
    return std::span(&map.texels.front().x, 3 * map.texels.size());
  });
  if (!read) return read.problems();
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
