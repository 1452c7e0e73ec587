#include "renderer/frame/environment_lights.h"

#include <algorithm>
#include <cmath>

#include "protocol/base/text.h"
#include "protocol/fields/ranges.h"
#include "protocol/spec/frame_lights.h"
#include "protocol/spec/settled_sun.h"
#include "renderer/core/collect.h"
#include "renderer/core/light.h"
#include "renderer/environment/sky_model.h"

namespace gnomon {
namespace {

Vec3 fieldOf(const glm::dvec3& vector) {
  return {vector.x, vector.y, vector.z};
}

/// As a directional light: the largest component of its color is 1.
Light lightOf(const FoundSun& sun, const EnvironmentOptions& options) {
  const glm::dvec3 irradiance = sun.irradiance * intensityOf(options);
  const double most = std::max({irradiance.x, irradiance.y, irradiance.z});
  Light light;
  light.direction = fieldOf(-(glm::transpose(mapFromWorld(options.rotationDegrees)) * sun.towards));
  light.angularDiameterDegrees = glm::degrees(sun.angularDiameter);
  light.color = most > 0 ? fieldOf(irradiance / most) : Vec3{1, 1, 1};
  light.intensity = most;
  return light;
}

SunReport reportOf(const Light& light) {
  const Vec3& way = *light.direction;
  const Vec3& color = *light.color;
  return {{-way[0], -way[1], -way[2]},
          *light.angularDiameterDegrees,
          {color[0], color[1], color[2]},
          luminanceOf({color[0], color[1], color[2]}) * light.intensity};
}

/// Adds the sun to what is known of the rest.
Result<SettledEnvironment> withSun(SettledEnvironment settled, const std::optional<FoundSun>& sun,
                                   const EnvironmentOptions& options) {
  if (!sun) return settled;
  const Light light = lightOf(*sun, options);
  if (light.intensity > kIntensityRange.max) {
    return invalidValue("/environment/intensity", "The sun of the environment is brighter than a light may be.",
                        "at most " + shortNumber(kIntensityRange.max) + " lux", shortNumber(light.intensity) + " lux");
  }
  settled.report->sun = reportOf(light);
  if (options.extractSun != SunExtraction::removed) settled.lights.push_back(light);
  return settled;
}

constexpr double kNotedDifference = 0.1;

/// A light whose irradiance and picture are not of the same light.
std::string differs(double difference) {
  return "The irradianceCoefficients of the glTF's image-based light differ from the irradiance of its picture by up "
         "to " +
         shortNumber(std::round(100 * difference)) + " %; its picture lights the frame.";
}

Result<SettledEnvironment> settleFile(const EnvironmentFile& file, const EnvironmentOptions& options) {
  SettledEnvironment settled;
  auto known = file.facts(options.extractSun);
  if (!known) {
    auto read = file.read(options.extractSun);
    if (!read) return placedAt(placeOfSource(options), read.problems());
    known = Result<EnvironmentFacts>(read->facts);
    settled.split = *std::move(read);
  }
  if (!*known) return placedAt(placeOfSource(options), known->problems());
  const EnvironmentFacts& facts = **known;
  if (facts.irradianceDifference > kNotedDifference) settled.warnings.push_back(differs(facts.irradianceDifference));
  settled.report = EnvironmentReport{facts.width, facts.height, facts.meanRadiance, {}};
  return withSun(std::move(settled), facts.sun, options);
}

} // namespace

glm::dmat3 mapFromWorld(double rotationDegrees) {
  const double angle = glm::radians(rotationDegrees), along = std::cos(angle), across = std::sin(angle);
  return {glm::dvec3(along, 0, -across), glm::dvec3(0, 1, 0), glm::dvec3(across, 0, along)};
}

double intensityOf(const EnvironmentOptions& options) {
  return options.intensity.value_or(options.sky ? kUsualSkyIntensity : 1);
}

EnvironmentOptions sourcedEnvironment(const Scene& loaded, const FrameSpec& spec) {
  const int scene = spec.scene.value_or(loaded.defaultScene);
  const bool isThere = scene >= 0 && scene < fileScenes(loaded);
  const int light = isThere ? loaded.scenes[static_cast<std::size_t>(scene)].imageBasedLight : -1;
  return withSource(spec.environment, light < 0 ? std::nullopt : std::optional(light));
}

Result<std::shared_ptr<const EnvironmentFile>> environmentFileOf(const Scene& loaded,
                                                                 const EnvironmentOptions& options) {
  if (options.file) {
    const auto file = loaded.environmentFiles.find(*options.file);
    if (file != loaded.environmentFiles.end()) return file->second;
    return invalidValue(placeOfSource(options), "The upload has no .hdr or .exr file of that name.", "", *options.file);
  }
  if (!options.light) return std::shared_ptr<const EnvironmentFile>();
  const std::size_t count = loaded.imageBasedLights.size();
  const auto index = static_cast<std::size_t>(*options.light);
  if (index >= count) {
    return invalidValue(placeOfSource(options), "The glTF has no image-based light of that index.",
                        count == 0 ? "none" : "0.." + std::to_string(count - 1), std::to_string(*options.light));
  }
  if (loaded.imageBasedLights[index]) return loaded.imageBasedLights[index];
  return invalidValue(placeOfSource(options),
                      "That image-based light of the glTF is left out, as the scene's warnings say.", "",
                      std::to_string(*options.light));
}

std::string placeOfSource(const EnvironmentOptions& options) {
  return options.light ? "/environment/light" : "/environment/file";
}

Result<SettledEnvironment> settleEnvironment(const Scene& loaded, const EnvironmentOptions& options) {
  if (options.sky) {
    Sky sky = *options.sky;
    sky.sun = settledSun(sky.sun);
    return withSun({{}, EnvironmentReport{}, {}, {}}, sunOf(sky), options);
  }
  const auto file = environmentFileOf(loaded, options);
  if (!file) return file.problems();
  return *file ? settleFile(**file, options) : SettledEnvironment{};
}

} // namespace gnomon
