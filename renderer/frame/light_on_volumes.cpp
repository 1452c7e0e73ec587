#include "renderer/frame/light_on_volumes.h"

#include <algorithm>
#include <type_traits>

#include "renderer/core/parallel.h"
#include "renderer/core/vec3.h"
#include "renderer/reference/trace.h"
#include "renderer/resolve/plan_input.h"
#include "renderer/scene/animation/node_places.h"
#include "renderer/shaders/shared/functions.h"

namespace gnomon {
namespace {

constexpr std::size_t kPiece = 4096; // points that a core traces at a time

/// A text that differs where values do.
class Values {
 public:
  template <class T>
  Values& add(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    text_.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }
  Values& add(const std::string& text) {
    add(text.size());
    text_.append(text);
    return *this;
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

void addPlace(const NodeOptions& entry, Values& text) {
  const auto addPart = [&](const auto& part) {
    text.add(part.has_value());
    if (part) text.add(*part);
  };
  if (!hasPlace(entry)) return;
  const int* index = std::get_if<int>(&*entry.node);
  text.add(index != nullptr ? *index : -1);
  if (index == nullptr) text.add(std::get<std::string>(*entry.node));
  addPart(entry.matrix);
  addPart(entry.translation);
  addPart(entry.rotation);
  addPart(entry.scale);
}

bool isShadowing(const ShiningLights& shining, std::size_t light) {
  return std::find(shining.shadowing.begin(), shining.shadowing.end(), static_cast<int>(light)) !=
         shining.shadowing.end();
}

double strengthOf(const ShiningLights& shining, std::size_t light) {
  return isShadowing(shining, light) ? shining.lights[light].shadow->strength : 0;
}

} // namespace

ShiningLights shiningLights(const ResolvedFrame& frame, const glm::dvec3& origin) {
  const std::vector<Light>& lights = *frame.spec.lights;
  return {lightData(litLights(lights, ShadowPlan{}, origin)), origin, lights, shadowingLights(frame)};
}

std::string lightsText(const ShiningLights& shining) {
  Values text;
  for (std::size_t i = 0; i < shining.data.size(); ++i) {
    const Light& light = shining.lights[i];
    const shared::LightData& data = shining.data[i];
    text.add(data.type).add(directionOf(light)).add(light.position.value_or(Vec3{})).add(data.range);
    text.add(data.radiance).add(data.coneScale).add(data.coneOffset).add(strengthOf(shining, i));
    text.add(light.cullingMask).add(light.shadow->blendedCasters);
  }
  return text.take();
}

std::string castersText(const ResolvedFrame& frame) {
  Values text;
  text.add(frame.scene);
  for (const NodeSwitches& node : frame.nodes) text.add(node.castShadow).add(node.layers);
  std::string pose;
  if (const auto& moment = frame.spec.animation) {
    text.add(moment->timeSeconds).add(moment->index.value_or(-1));
    pose = moment->name.value_or("");
  }
  for (const NodeOptions& entry : frame.spec.nodes) addPlace(entry, text);
  return text.take() + pose;
}

LightShares surfaceShares(const ShiningLights& shining, const TraceInput& rays, const VolumeSpace& space,
                          const glm::ivec3& size) {
  LightShares shares(shining.lights.size());
  const glm::dvec3 anchor = anchorOf(rays.traced.view());
  for (std::size_t light = 0; light < shares.size(); ++light) {
    const double strength = strengthOf(shining, light);
    if (strength == 0) continue;
    const TracedLight traced(rays, static_cast<int>(light));
    std::vector<float>& own = shares[light];
    own.resize(pointsOf(size));
    forEachPiece(own.size(), kPiece, [&](std::size_t first, std::size_t last) {
      std::vector<glm::dvec3> places;
      for (std::size_t i = first; i < last; ++i) places.push_back(latticePlace(space, size, i) - anchor);
      const std::span<float> piece(own.data() + first, last - first);
      traced.airVisibility(places, piece);
      for (float& share : piece) share = static_cast<float>(1 - strength * (1 - double{share}));
    });
  }
  return shares;
}

std::vector<ArrivalAt> arrivalsOf(const ShiningLights& shining, const LightShares& shares) {
  std::vector<ArrivalAt> arrivals;
  for (std::size_t i = 0; i < shining.data.size(); ++i) {
    arrivals.push_back([&shining, &shares, i](std::size_t point, const glm::dvec3& place) {
      const Light& light = shining.lights[i];
      Arrival arrival;
      glm::vec3 towards;
      arrival.irradiance = glm::dvec3(shared::irradiance(shining.data[i], glm::vec3(place - shining.origin), towards));
      if (light.type == LightType::directional) {
        arrival.towards = -directionOf(light);
      } else {
        const glm::dvec3 way = toVector(*light.position) - place;
        arrival.distance = glm::length(way);
        if (arrival.distance > 0) arrival.towards = way / arrival.distance;
      }
      if (!shares.empty() && !shares[i].empty()) arrival.surfaceVisibility = double{shares[i][point]};
      return arrival;
    });
  }
  return arrivals;
}

} // namespace gnomon
