#include "renderer/environment/environment_file.h"

#include <algorithm>
#include <glm/gtc/constants.hpp>

#include "renderer/core/light.h"
#include "renderer/environment/environment_checks.h"
#include "renderer/environment/extract_sun.h"
#include "renderer/environment/read_environment.h"
#include "renderer/environment/stated_irradiance.h"

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

using Content = std::variant<Bytes, CubeLight>;

Result<EnvironmentMap> readMap(const Content& content) {
  const auto* cube = std::get_if<CubeLight>(&content);
  return cube != nullptr ? readCube(*cube) : readEnvironment(std::get<Bytes>(content));
}

double irradianceDifferenceOf(const Content& content, const EnvironmentMap& map) {
  const auto* cube = std::get_if<CubeLight>(&content);
  if (cube == nullptr) return 0;
  Irradiance stated{};
  for (std::size_t i = 0; i < stated.size(); ++i) stated[i] = luminanceOf(cube->irradiance[i]) * cube->intensity;
  const glm::dmat3 leftHanded(glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, -1));
  return greatestDifference(stated, irradianceOf(map, leftHanded * cube->cubeFromWorld));
}

/// Width and height as far as its header says.
std::optional<glm::ivec2> statedSize(const Content& content) {
  const auto* cube = std::get_if<CubeLight>(&content);
  return cube != nullptr ? mapSizeOf(sideOf(*cube)) : environmentSize(std::get<Bytes>(content));
}

Result<SplitEnvironment> splitFile(const Content& content, SunExtraction extraction) {
  auto map = readMap(content);
  if (!map) return map.problems();
  SplitEnvironment split{*std::move(map), {}};
  split.facts = {
      split.map.width, split.map.height, meanRadianceOf(split.map), {}, irradianceDifferenceOf(content, split.map)};
  if (extraction != SunExtraction::none) split.facts.sun = takeSun(split.map);
  return split;
}

} // namespace

std::uint64_t EnvironmentFile::size() const {
  const auto* cube = std::get_if<CubeLight>(&content_);
  return cube != nullptr ? bytesIn(*cube) : std::get<Bytes>(content_).size();
}

std::uint64_t EnvironmentFile::memory() const {
  const auto sides = statedSize(content_);
  const bool isRead = sides && checkEnvironmentSize(*sides);
  const std::uint64_t texels = isRead ? static_cast<std::uint64_t>(sides->x) * static_cast<std::uint64_t>(sides->y) : 0;
  return size() + texels * sizeof(glm::vec3);
}

Result<SplitEnvironment> EnvironmentFile::read(SunExtraction extraction) const {
  auto split = splitFile(content_, extraction);
  const std::lock_guard lock(mutex_);
  facts_[slotOf(extraction)] = split ? Result<EnvironmentFacts>(split->facts) : split.problems();
  return split;
}

std::optional<Result<EnvironmentFacts>> EnvironmentFile::facts(SunExtraction extraction) const {
  const std::lock_guard lock(mutex_);
  return facts_[slotOf(extraction)];
}

} // namespace gnomon
