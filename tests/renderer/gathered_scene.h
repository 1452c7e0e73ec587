#pragma once

#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "renderer/render.h"
#include "tests/support/gathered_model.h"

namespace gnomon::testing {

/// A model that a manifest lists, or none where it requires an extension that is not supported: then the problem must
/// name that. Any other refusal is a failure of the test.
inline ScenePtr gatheredScene(const std::filesystem::path& assets, const nlohmann::json& entry) {
  const auto scene = loadScene(gatheredBundle(assets, entry));
  if (scene) return *scene;
  SCOPED_TRACE(entry.at("id").get<std::string>());
  const Problem& problem = scene.problems().front();
  EXPECT_EQ(problem.code, ProblemCode::unsupportedFeature) << problem.detail;
  EXPECT_EQ(problem.pointer.rfind("/extensionsRequired/", 0), 0u) << problem.pointer;
  EXPECT_FALSE(entry.at("extensions_required").empty());
  return nullptr;
}

} // namespace gnomon::testing
