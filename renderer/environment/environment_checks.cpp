#include "renderer/environment/environment_checks.h"

#include <string>

#include "protocol/base/text.h"
#include "protocol/spec/limits.h"

namespace gnomon {

Status checkEnvironmentSize(const glm::ivec2& size) {
  const auto text = [](const glm::ivec2& sides) { return std::to_string(sides.x) + "x" + std::to_string(sides.y); };
  const glm::ivec2 least(kLimits.minEnvironmentWidth, kLimits.minEnvironmentWidth / 2);
  const glm::ivec2 most(kLimits.maxEnvironmentWidth, kLimits.maxEnvironmentWidth / 2);
  if (size.x > most.x || size.y > most.y) {
    return Problem{ProblemCode::tooLarge, "", "The environment has too many texels.", text(most), text(size)};
  }
  if (size.x != 2 * size.y || size.x < least.x) {
    return invalidValue("", "The environment must be twice as wide as high, and not too small.",
                        text(least) + ".." + text(most), text(size));
  }
  return Done{};
}

Status checkEnvironmentTexels(const EnvironmentMap& map) {
  const auto most = static_cast<float>(kLimits.maxRadiance);
  const auto isSound = [&](float number) { return number >= 0 && number <= most; }; // false for what is no number
  for (std::size_t i = 0; i < map.texels.size(); ++i) {
    for (int channel = 0; channel < 3; ++channel) {
      const float number = map.texels[i][channel];
      if (isSound(number)) continue;
      const auto width = static_cast<std::size_t>(map.width);
      return invalidValue(
          "",
          "A texel of the environment has a radiance that light can't have: " + std::string(1, "RGB"[channel]) +
              " of column " + std::to_string(i % width) + ", row " + std::to_string(i / width) + ".",
          "0.." + shortNumber(kLimits.maxRadiance), shortNumber(double{number}));
    }
  }
  return Done{};
}

} // namespace gnomon
