#include "tests/renderer/cpu/surface/made_scene.h"

#include <glm/gtc/matrix_transform.hpp>

namespace gnomon::cpu {
namespace {

constexpr std::uint32_t kTriangles = kClusterTriangles + 200;

} // namespace

MadeScene::MadeScene(bool perspective) {
  frame_.spec.width = 320;
  frame_.spec.height = 202;
  frame_.spec.ambient.color = {0.5, 0.25, 0.125};
  frame_.spec.ambient.intensity = 1.5;
  frame_.spec.exposure = 0.5;
  frame_.spec.background = {{0.1, 0.2, 0.3}, 0.5};
  frame_.view.eye = {1000, -20, 3};
  frame_.view.perspective = perspective;
  frame_.view.halfSize = perspective ? glm::dvec2(0.8, 0.5) : glm::dvec2(16, 10);
  const glm::dmat3 turn(glm::rotate(glm::dmat4(1), 0.7, glm::normalize(glm::dvec3(1, 2, 3))));
  frame_.view.right = turn[0];
  frame_.view.up = turn[1];
  frame_.view.forward = -turn[2];
  frame_.view.far = 1000;
}

void MadeScene::place(const std::vector<Material>& materials, std::vector<std::shared_ptr<const Image>> images) {
  std::uniform_real_distribution<float> spread(-1, 1);
  const auto number = [&] { return spread(generator_); };
  const auto vector = [&] { return glm::vec3(number(), number(), number()); };
  scene_.materials = materials;
  scene_.images.clear();
  for (const auto& image : images) scene_.images.push_back(std::make_shared<const SceneImage>(*image));
  textures_ = std::make_unique<Textures>(scene_.images);
  for (std::size_t i = 0; i < materials.size(); ++i) {
    Primitive primitive;
    primitive.material = static_cast<int>(i);
    primitive.baseVertex = static_cast<std::uint32_t>(scene_.positions.size());
    primitive.vertexCount = 3 * kTriangles;
    primitive.firstIndex = static_cast<std::uint32_t>(scene_.indices.size());
    primitive.indexCount = 3 * kTriangles;
    primitive.firstCluster = static_cast<std::uint32_t>(scene_.clusters.size());
    primitive.clusterCount = 2;
    primitive.hasTangents = i % 2 == 1;
    for (std::uint32_t t = 0; t < kTriangles; ++t) {
      const glm::vec3 middle = vector() * 10.0f;
      const float size = std::exp2(number() * 3.0f);
      for (std::uint32_t c = 0; c < 3; ++c) {
        scene_.indices.edit().push_back(3 * t + (c + t) % 3);
        scene_.positions.edit().push_back(middle + vector() * size);
        VertexAttributes attributes;
        attributes.normal = vector();
        attributes.tangent = glm::vec4(glm::normalize(vector()), t % 2 == 0 ? 1 : -1);
        attributes.uv0 = glm::vec2(vector());
        attributes.uv1 = glm::vec2(vector());
        attributes.color = glm::u16vec4((glm::vec4(vector(), number()) * 0.5f + 0.5f) * 65535.0f);
        scene_.attributes.edit().push_back(attributes);
      }
    }
    scene_.primitives.push_back(primitive);
    scene_.clusters.resize(scene_.clusters.size() + 2);
    Instance instance;
    instance.primitive = static_cast<int>(i);
    instance.worldFromLocal = glm::translate(glm::dmat4(1), frame_.view.eye + frame_.view.forward * 18.0) *
                              glm::rotate(glm::dmat4(1), static_cast<double>(i), glm::normalize(glm::dvec3(vector()))) *
                              glm::scale(glm::dmat4(1), glm::dvec3(1.0, i % 3 == 2 ? -1.0 : 0.75, 1.25));
    sceneView_.instances.push_back(instance);
  }
  std::vector<std::uint8_t> groups;
  for (std::size_t i = 0; i < materials.size(); ++i) groups.push_back(static_cast<std::uint8_t>(i));
  geometry_ = frameGeometry(scene_, sceneView_, frame_.view.eye, groups);
  frameScene_ = std::make_unique<FrameScene>(cpu::frameScene(scene_, sceneView_, geometry_, frame_));
}

std::optional<MadeScene::Seen> MadeScene::seenAt(std::uint32_t instance, std::uint32_t triangle) {
  const Primitive& primitive = scene_.primitives[instance];
  Seen seen;
  seen.instance = instance;
  seen.triangle = geometry_.firstSlot[instance] * kClusterTriangles + triangle;
  std::uniform_real_distribution<double> spread(0, 1);
  glm::dvec2 share(spread(generator_), spread(generator_));
  if (share.x + share.y > 1) share = 1.0 - share;
  seen.weights = {1 - share.x - share.y, share.x, share.y};
  for (int c = 0; c < 3; ++c) {
    const auto index =
        static_cast<std::size_t>(primitive.firstIndex) + 3 * std::size_t{triangle} + static_cast<std::size_t>(c);
    seen.vertices[c] = scene_.indices[index] + primitive.baseVertex;
    const glm::dvec4 local(glm::dvec3(scene_.positions[seen.vertices[c]]), 1.0);
    seen.corners[c] = glm::dvec3(geometry_.instances[instance].relativeFromLocal * local);
  }
  const CameraView& view = frame_.view;
  const glm::dvec3 p = seen.point();
  const double depth = glm::dot(p, view.forward);
  const glm::dvec2 across(glm::dot(p, view.right), glm::dot(p, view.up));
  const glm::dvec2 ndc = across / (view.perspective ? depth : 1.0) / view.halfSize;
  seen.place = (ndc * 0.5 + 0.5) * glm::dvec2(frame_.spec.width, frame_.spec.height);
  const glm::dvec3 way = view.perspective ? glm::normalize(p) : view.forward;
  const bool edgeOn = std::abs(glm::dot(way, seen.normal())) < 0.05;
  if (depth < 0.5 || glm::abs(ndc.x) > 1 || glm::abs(ndc.y) > 1 || edgeOn) return std::nullopt;
  return seen;
}

std::vector<MadeScene::Seen> MadeScene::seen(std::size_t count) {
  std::vector<Seen> all;
  std::uint32_t triangle = 0;
  std::uint32_t instance = 0;
  while (all.size() < count) {
    // Packets of one triangle, of one instance, and of anything.
    const std::size_t kind = all.size() / 16 % 3;
    const bool first = all.size() % 16 == 0;
    if (first || kind == 2) instance = static_cast<std::uint32_t>(generator_() % sceneView_.instances.size());
    if (first || kind != 0) triangle = static_cast<std::uint32_t>(generator_() % kTriangles);
    std::optional<Seen> found = seenAt(instance, triangle);
    for (int tries = 0; !found && tries < 20; ++tries) found = seenAt(instance, triangle);
    if (found) {
      all.push_back(*found);
    } else if (kind == 0) {
      all.resize(all.size() / 16 * 16);
    }
  }
  return all;
}

FragmentInput MadeScene::fragmentsOf(const std::vector<Seen>& seen) const {
  FragmentInput in{*textures_, {}, {}, {}};
  for (const Seen& s : seen) {
    in.triangles.push_back(s.triangle);
    in.x.push_back(static_cast<float>(s.place.x));
    in.y.push_back(static_cast<float>(s.place.y));
  }
  return in;
}

} // namespace gnomon::cpu
