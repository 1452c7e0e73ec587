// Environments as they come in files of Radiance and OpenEXR.
#include "protocol/spec/limits.h"
#include "renderer/environment/environment_file.h"
#include "tests/fuzz/sound_problems.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gnomon;
  const EnvironmentFile file(Bytes(data, data + size));
  const auto split = file.read(SunExtraction::auto_);
  if (!split) {
    fuzz::requireSound(split.problems());
    return 0;
  }
  const EnvironmentMap& map = split->map;
  fuzz::require(map.width == 2 * map.height && map.width <= kLimits.maxEnvironmentWidth, "sides are within the limits");
  fuzz::require(file.memory() >= size + map.texels.size() * sizeof(glm::vec3), "memory is known from the header");
  for (const glm::vec3& texel : map.texels) {
    for (int i = 0; i < 3; ++i)
      fuzz::require(texel[i] >= 0 && double{texel[i]} <= kLimits.maxRadiance, "light is sound");
  }
  return 0;
}
