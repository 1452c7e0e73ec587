#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <memory>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "renderer/scene/gltf_loader.h"
#include "tests/support/glb_builder.h"

namespace gnomon {

/// For the messages of failed tests.
inline void PrintTo(const Problem& problem, std::ostream* out) {
  *out << static_cast<int>(problem.code) << " at " << problem.pointer << ": " << problem.detail << " [" << problem.limit
       << " | " << problem.actual << "]";
}

/// The problem's code and place.
MATCHER_P2(ProblemAt, code, pointer, "") {
  return arg.code == code && arg.pointer == pointer && !arg.detail.empty();
}

inline Problems problemsOf(const SceneBundle& bundle, const Limits& limits = kLimits) {
  auto result = loadGltf(bundle, limits);
  return result ? Problems{} : result.problems();
}

inline Problems problemsOf(const testing::GlbBuilder& builder, const Limits& limits = kLimits) {
  return problemsOf(builder.bundle(), limits);
}

/// With the vertices and triangles of its file alone: without the square that grounds are made of, which is the last.
inline Scene ofFile(Scene scene) {
  const Primitive square = *std::exchange(scene.groundMesh, std::nullopt);
  scene.positions.edit().resize(square.baseVertex);
  scene.attributes.edit().resize(square.baseVertex);
  scene.indices.edit().resize(square.firstIndex);
  scene.welded.edit().resize(square.firstIndex);
  scene.clusters.resize(square.firstCluster);
  return scene;
}

/// The scene as `ofFile`, or an empty one with a failure that names the problem.
inline Scene load(const SceneBundle& bundle, const Limits& limits = kLimits) {
  auto result = loadGltf(bundle, limits);
  if (result) return ofFile(**result);
  const Problem& problem = result.problems().front();
  ADD_FAILURE() << problem.pointer << ": " << problem.detail;
  Scene empty;
  empty.scenes.resize(1);
  return empty;
}

inline Scene load(const testing::GlbBuilder& builder, const Limits& limits = kLimits) {
  return load(builder.bundle(), limits);
}

inline std::shared_ptr<const Scene> sharedScene(const testing::GlbBuilder& builder) {
  return std::make_shared<const Scene>(load(builder));
}

/// What is said of a file, a line each: the problems that refuse it, else its warnings. Each with its place.
inline std::string findingsOf(const SceneBundle& bundle) {
  const auto result = loadGltf(bundle);
  std::string text;
  if (result) {
    for (const std::string& warning : (*result)->summary.warnings) text += warning + "\n";
  } else {
    for (const Problem& problem : result.problems()) text += problem.detail + " (" + problem.pointer + ")\n";
  }
  return text;
}

inline std::string findingsOf(const testing::GlbBuilder& builder) {
  return findingsOf(builder.bundle());
}

/// The file loads where this limit is `least`, and is refused at the place where it is one less.
template <class Number>
void expectLimit(const testing::GlbBuilder& file, Number Limits::*limit, std::uint64_t least,
                 const std::string& pointer) {
  Limits limits;
  limits.*limit = static_cast<Number>(least);
  EXPECT_TRUE(problemsOf(file, limits).empty()) << pointer << " " << least;
  limits.*limit = static_cast<Number>(least - 1);
  EXPECT_THAT(problemsOf(file, limits), ::testing::ElementsAre(ProblemAt(ProblemCode::tooLarge, pointer)));
}

/// The file is refused at the place where this limit is `limit`.
template <class Number>
void expectBeyond(const testing::GlbBuilder& file, Number Limits::*member, std::uint64_t limit,
                  const std::string& pointer) {
  Limits limits;
  limits.*member = static_cast<Number>(limit);
  EXPECT_THAT(problemsOf(file, limits), ::testing::ElementsAre(ProblemAt(ProblemCode::tooLarge, pointer)));
}

/// A member of a file; null = it is taken away.
struct Change {
  std::string at;
  nlohmann::json value;
  std::string place; ///< that what is said of the file then names
};

inline void expectTold(const testing::GlbBuilder& sound, const std::vector<Change>& changes) {
  for (const Change& change : changes) {
    testing::GlbBuilder file = sound;
    const nlohmann::json::json_pointer at(change.at);
    if (change.value.is_null()) {
      file.json.at(at.parent_pointer()).erase(at.back());
    } else {
      file.json[at] = change.value;
    }
    EXPECT_THAT(findingsOf(file), ::testing::HasSubstr(change.place)) << change.at;
  }
}

/// Damage in any byte, of each `step` of the first ones, is no problem of the program's own.
inline void takeFlippedBytes(const testing::GlbBuilder& sound, std::size_t length, std::size_t step) {
  for (std::size_t at = 0; at < length; at += step) {
    for (const int bits : {0x01, 0x80, 0xFF}) {
      testing::GlbBuilder builder = sound;
      builder.binary[at] = static_cast<std::uint8_t>(builder.binary[at] ^ bits);
      for (const Problem& problem : problemsOf(builder)) EXPECT_NE(problem.code, ProblemCode::internal);
    }
  }
}

/// A cube whose vertices all follow the first joint of a skin that the file does not have yet.
inline testing::GlbBuilder cubeOnJoint() {
  testing::GlbBuilder builder = testing::cube();
  const std::vector<std::uint16_t> joints(std::size_t{24} * 4, 0);
  std::vector<float> weights(std::size_t{24} * 4, 0);
  for (std::size_t i = 0; i < 24; ++i) weights[4 * i] = 1;
  nlohmann::json& attributes = builder.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_0"] = builder.addAccessor(joints, "VEC4", 5123, 24);
  attributes["WEIGHTS_0"] = builder.addAccessor(weights, "VEC4", 5126, 24);
  return builder;
}

/// A PNG's header, and nothing after it.
inline Bytes pngHeader(std::uint32_t width, std::uint32_t height) {
  Bytes bytes{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n', 0, 0, 0, 13, 'I', 'H', 'D', 'R'};
  for (const std::uint32_t side : {width, height}) {
    for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::uint8_t>(side >> shift));
  }
  bytes.insert(bytes.end(), {8, 2, 0, 0, 0, 0, 0, 0, 0});
  return bytes;
}

inline const Material& onlyMaterial(const Scene& scene) {
  return scene.materials.at(static_cast<std::size_t>(scene.primitives.at(0).material));
}

inline SceneBundle bundleOf(const std::string& json) {
  return {Bytes(json.begin(), json.end()), {}};
}

} // namespace gnomon
