#include "renderer/environment/environment_file.h"

#include <algorithm>
#include <glm/gtc/constants.hpp>

#include "renderer/core/light.h"
#include "renderer/environment/environment_checks.h"
#include "renderer/environment/extract_sun.h"
#include "renderer/environment/read_environment.h"

namespace gnomon {
namespace {

double meanRadianceOf(const EnvironmentMap& map) {
  double sum = 0;
  for (int y = 0; y < map.height; ++y) {
    double row = 0;
    for (int x = 0; x < map.width; ++x) row += luminanceOf(glm::dvec3(map.at(x, y)));
    sum += row * texelSolidAngle(map, y);
  }
  return sum / (4 * glm::pi<double>());
}

Result<SplitEnvironment> splitFile(const Bytes& bytes, SunExtraction extraction) {
  auto map = readEnvironment(bytes);
  if (!map) return map.problems();
  SplitEnvironment split{*std::move(map), {}};
  split.facts = {split.map.width, split.map.height, meanRadianceOf(split.map), {}};
  if (extraction != SunExtraction::none) split.facts.sun = takeSun(split.map);
  return split;
}

} // namespace

std::uint64_t EnvironmentFile::memory() const {
  const auto size = environmentSize(bytes_);
  const bool isRead = size && checkEnvironmentSize(*size);
  const std::uint64_t texels = isRead ? static_cast<std::uint64_t>(size->x) * static_cast<std::uint64_t>(size->y) : 0;
  return bytes_.size() + texels * sizeof(glm::vec3);
}

Result<SplitEnvironment> EnvironmentFile::read(SunExtraction extraction) const {
  auto split = splitFile(bytes_, extraction);
  const std::lock_guard lock(mutex_);
  facts_[slotOf(extraction)] = split ? Result<EnvironmentFacts>(split->facts) : split.problems();
  return split;
}

std::optional<Result<EnvironmentFacts>> EnvironmentFile::facts(SunExtraction extraction) const {
  const std::lock_guard lock(mutex_);
  return facts_[slotOf(extraction)];
}

} // namespace gnomon
