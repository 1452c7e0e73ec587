#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "protocol/spec/traits.h"
#include "renderer/core/light.h"
#include "renderer/core/linear_algebra.h"
#include "renderer/core/parallel.h"
#include "renderer/export/baked_glb.h"
#include "renderer/shaders/shared/functions.h"

namespace gnomon {
namespace {

/// As renderer/shaders/shared/light.h: irradiance on a surface that faces the light, and the way to it.
struct Arriving {
  glm::dvec3 irradiance{0};
  glm::dvec3 toLight{0, 1, 0};
};

Arriving arriving(const Light& light, const glm::dvec3& position) {
  const glm::dvec3 color = light.temperatureKelvin ? blackBodyColor(*light.temperatureKelvin)
                                                   : toVector(light.color.value_or(Vec3{1, 1, 1}));
  const glm::dvec3 radiance = color * light.intensity;
  if (traitsOf(light.type).parallel) return {radiance, -directionOf(light)};
  const glm::dvec3 offset = toVector(light.position.value_or(Vec3{})) - position;
  const double squared = std::max(glm::dot(offset, offset), 1e-8);
  const glm::dvec3 toLight = offset / std::sqrt(squared);
  double attenuation = 1 / squared;
  if (light.range) {
    const double ratio = squared / (*light.range * *light.range);
    attenuation *= std::clamp(1 - ratio * ratio, 0.0, 1.0);
  }
  if (traitsOf(light.type).hasCone) {
    const double inner = std::cos(glm::radians(light.innerConeDegrees));
    const double outer = std::cos(glm::radians(light.outerConeDegrees));
    const double cosine = glm::dot(directionOf(light), -toLight);
    const double falloff = std::clamp((cosine - outer) / std::max(inner - outer, 1e-5), 0.0, 1.0);
    attenuation *= falloff * falloff;
  }
  return {radiance * attenuation, toLight};
}

/// Where a place lies in a triangle of the map, or the place of the triangle that is nearest.
struct Nearest {
  glm::dvec3 weights{1, 0, 0};
  double distance = 0; ///< texels; 0 = inside
};

Nearest nearestIn(const FlatTriangle& t, const glm::dvec2& place) {
  const double area = signedArea(t);
  const auto weight = [&](std::size_t a, std::size_t b) { return signedArea({place, t[a], t[b]}) / area; };
  const glm::dvec3 inside(weight(1, 2), weight(2, 0), weight(0, 1));
  if (inside.x >= 0 && inside.y >= 0 && inside.z >= 0) return {inside, 0};
  Nearest best{{1, 0, 0}, std::numeric_limits<double>::infinity()};
  for (int side = 0; side < 3; ++side) {
    const auto a = static_cast<std::size_t>(side), b = (a + 1) % 3;
    const glm::dvec2 along = t[b] - t[a];
    const double share = std::clamp(glm::dot(place - t[a], along) / glm::dot(along, along), 0.0, 1.0);
    const double distance = glm::length(t[a] + share * along - place);
    if (distance >= best.distance) continue;
    best = {glm::dvec3(0), distance};
    best.weights[static_cast<int>(a)] = 1 - share;
    best.weights[static_cast<int>(b)] = share;
  }
  return best;
}

/// A triangle's corners in the world.
struct WorldTriangle {
  std::array<glm::dvec3, 3> positions, normals;
  glm::dvec3 front{0, 1, 0}; ///< normal of its own, on the front side
};

WorldTriangle worldTriangle(const Scene& scene, const Instance& instance, std::uint32_t triangle) {
  const Primitive& primitive = scene.primitives[static_cast<std::size_t>(instance.primitive)];
  const glm::dmat3 turned = normalMatrix(glm::dmat3(instance.worldFromLocal));
  WorldTriangle world;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t vertex =
        primitive.baseVertex + scene.indices[primitive.firstIndex + 3 * std::size_t{triangle} + k];
    world.positions[k] = glm::dvec3(instance.worldFromLocal * glm::dvec4(glm::dvec3(scene.positions[vertex]), 1));
    world.normals[k] = unitOr(turned * glm::dvec3(scene.attributes[vertex].normal), {0, 1, 0});
  }
  const auto& [a, b, c] = world.positions;
  const double side = glm::determinant(glm::dmat3(instance.worldFromLocal)) < 0 ? -1 : 1;
  world.front = side * unitOr(glm::cross(b - a, c - a), world.front);
  return world;
}

/// Irradiance of what faces `normal`, with nothing in the way; in the unit of the lights.
glm::dvec3 openIrradiance(const ShadowedEnvironment& sky, const glm::dvec3& normal) {
  const FrameEnvironment& around = sky.environment;
  if (!around.environment) {
    const float overPi = shared::irradianceOfStudio(glm::vec3(around.mapFromWorld * normal), glm::vec2(1, 0),
                                                    around.studioLamps ? 1 : 0);
    return std::numbers::pi * sky.ambient * double{overPi};
  }
  const glm::vec3 overPi = shared::environmentIrradiance(around.environment->prefiltered.texels.data(),
                                                         glm::vec3(around.mapFromWorld * normal));
  return std::numbers::pi * around.intensity * glm::dvec3(overPi);
}

class ChartLight {
 public:
  ChartLight(const Scene& scene, const Instance& instance, const NodeSwitches& node,
             std::span<const ShadowedLight> lights, const ShadowedEnvironment* environment)
      : lights_(lights),
        environment_(environment),
        node_(node),
        doubleSided_(scene.materials[static_cast<std::size_t>(materialOf(scene, instance))].doubleSided) {}

  /// `front`: the triangle's own normal.
  glm::dvec3 at(const glm::dvec3& position, const glm::dvec3& normal, const glm::dvec3& front,
                const glm::ivec2& texel) const {
    glm::dvec3 sum = environment_ ? ofEnvironment(normal, front, texel) : glm::dvec3(0);
    for (const ShadowedLight& each : lights_) {
      if (!isLitBy(each.light, node_)) continue;
      const Arriving light = arriving(each.light, position);
      const double facing = glm::dot(normal, light.toLight);
      const double cosine = doubleSided_ ? std::abs(facing) : std::max(facing, 0.0);
      const double share = node_.receiveShadow ? each.baked.map.at(texel.x, texel.y) / 65535.0 : 1;
      const Shadow& shadow = *each.light.shadow;
      const glm::dvec3 left(shadow.color[0], shadow.color[1], shadow.color[2]);
      const double hidden = shadow.strength * (1 - share);
      sum += light.irradiance * cosine * (1.0 - hidden * (1.0 - left));
    }
    return sum;
  }

 private:
  /// By the normal that a picture shades the front by.
  glm::dvec3 ofEnvironment(const glm::dvec3& normal, const glm::dvec3& front, const glm::ivec2& texel) const {
    const glm::dvec3 shown = doubleSided_ && glm::dot(normal, front) < 0 ? -normal : normal;
    const BakedLight& baked = environment_->baked;
    const glm::dvec3 share(baked.map.at(texel.x, texel.y), baked.greenAndBlue[0].at(texel.x, texel.y),
                           baked.greenAndBlue[1].at(texel.x, texel.y));
    const glm::dvec3 open = openIrradiance(*environment_, shown);
    return node_.receiveShadow ? open * share / 65535.0 : open;
  }

  std::span<const ShadowedLight> lights_;
  const ShadowedEnvironment* environment_;
  NodeSwitches node_;
  bool doubleSided_;
};

} // namespace

IrradianceMap irradianceMap(const Scene& scene, const SceneView& view, std::span<const NodeSwitches> nodes,
                            std::span<const ShadowedLight> lights, const ShadowedEnvironment* environment) {
  constexpr double kReach = 2; ///< texels around a triangle that may be read with it
  const LightMapLayout& layout = *(environment ? environment->baked : lights.front().baked).layout;
  const auto texels = static_cast<std::size_t>(layout.width) * static_cast<std::size_t>(layout.height);
  IrradianceMap map{layout.width, layout.height, std::vector<glm::vec3>(texels)};
  std::vector<float> distances(texels, std::numeric_limits<float>::infinity());
  forEach(layout.charts.size(), [&](std::size_t c) {
    const PlacedChart& chart = layout.charts[c];
    const Instance& instance = view.instances[chart.instance];
    const NodeSwitches node = switchesOf(nodes, instance.node);
    const ChartLight light(scene, instance, node, lights, environment);
    for (const std::uint32_t triangle : chart.triangles) {
      const FlatTriangle flat = layout.flat({chart.instance, triangle});
      if (signedArea(flat) == 0) continue;
      const WorldTriangle world = worldTriangle(scene, instance, triangle);
      const auto [left, right] = std::minmax({flat[0].x, flat[1].x, flat[2].x});
      const auto [low, high] = std::minmax({flat[0].y, flat[1].y, flat[2].y});
      const Rect& rect = chart.rect;
      for (int y = std::max(rect.y, int(low - kReach)); y < std::min(rect.y + rect.height, int(high + kReach) + 1);
           ++y) {
        for (int x = std::max(rect.x, int(left - kReach)); x < std::min(rect.x + rect.width, int(right + kReach) + 1);
             ++x) {
          const Nearest nearest = nearestIn(flat, {x + 0.5, y + 0.5});
          const std::size_t texel = static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) + std::size_t(x);
          if (nearest.distance >= double{distances[texel]}) continue;
          distances[texel] = static_cast<float>(nearest.distance);
          glm::dvec3 position(0), normal(0);
          for (std::size_t k = 0; k < 3; ++k) {
            const double weight = nearest.weights[static_cast<int>(k)];
            position += weight * world.positions[k];
            normal += weight * world.normals[k];
          }
          map.texels[texel] = glm::vec3(light.at(position, glm::normalize(normal), world.front, {x, y}));
        }
      }
    }
  });
  return map;
}

} // namespace gnomon
