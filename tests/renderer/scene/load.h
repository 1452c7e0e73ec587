#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <memory>
#include <ostream>
#include <string>

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

/// The scene, or an empty one with a failure that names the problem.
inline Scene load(const SceneBundle& bundle, const Limits& limits = kLimits) {
  auto result = loadGltf(bundle, limits);
  if (result) return **result;
  const Problem& problem = result.problems().front();
  ADD_FAILURE() << problem.pointer << ": " << problem.detail;
  Scene empty;
  empty.scenes.resize(1);
  return empty;
}

inline Scene load(const testing::GlbBuilder& builder, const Limits& limits = kLimits) {
  return load(builder.bundle(), limits);
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

inline SceneBundle bundleOf(const std::string& json) {
  return {Bytes(json.begin(), json.end()), {}};
}

} // namespace gnomon
