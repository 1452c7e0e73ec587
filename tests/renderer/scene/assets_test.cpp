// Files gathered from public repositories, sound and broken. They are no part of the repository: the folder with
// their manifest.json is named by GNOMON_TEST_ASSETS, and without it these tests are skipped.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/renderer/scene/load.h"
#include "tests/support/files.h"
#include "tests/support/gathered_model.h"

namespace gnomon {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

fs::path assetFolder() {
  const char* named = std::getenv("GNOMON_TEST_ASSETS");
  return named ? fs::path(named) : fs::path(GNOMON_TEST_ASSETS_DEFAULT);
}

json manifest() {
  std::ifstream file(assetFolder() / "manifest.json");
  return file ? json::parse(file) : json();
}

std::string textOf(const Problems& problems) {
  std::string text;
  for (const Problem& problem : problems) text += problem.pointer + ": " + problem.detail + "\n";
  return text;
}

/// A file whose hint is that other readers lack the extensions that it requires; here all of them are read.
constexpr const char* kOnlyForOthers = "bad/magnum/GltfImporter/required-extensions-unsupported.gltf";

TEST(Assets, BrokenFilesAreToldApart) {
  const json list = manifest();
  if (list.is_null()) GTEST_SKIP() << "no manifest.json in " << assetFolder() << " (GNOMON_TEST_ASSETS)";
  for (const json& entry : list["bad"]) {
    SCOPED_TRACE(entry["path"].get<std::string>());
    auto result = loadGltf(testing::gatheredBundle(assetFolder(), entry));
    if (result) {
      EXPECT_TRUE(entry["expect_hint"] != "reject" || !(*result)->summary.warnings.empty() ||
                  entry["path"] == kOnlyForOthers)
          << "nothing is said";
      continue;
    }
    ASSERT_FALSE(result.problems().empty());
    for (const Problem& problem : result.problems()) {
      EXPECT_FALSE(problem.detail.empty());
      EXPECT_NE(problem.code, ProblemCode::internal);
    }
  }
}

TEST(Assets, SoundFilesLoadOrNameTheExtensionThatTheyNeed) {
  const json list = manifest();
  if (list.is_null()) GTEST_SKIP() << "no manifest.json in " << assetFolder() << " (GNOMON_TEST_ASSETS)";
  for (const json& entry : list["models"]) {
    SCOPED_TRACE(entry["path"].get<std::string>());
    auto result = loadGltf(testing::gatheredBundle(assetFolder(), entry));
    if (result) {
      EXPECT_LE((*result)->summary.triangles, entry["triangles_default_scene"].get<std::uint64_t>());
      EXPECT_GT((*result)->summary.triangles, 0u);
      continue;
    }
    ASSERT_EQ(result.problems().front().code, ProblemCode::unsupportedFeature) << textOf(result.problems());
    for (const Problem& problem : result.problems()) {
      const std::string prefix = "/extensionsRequired/";
      ASSERT_EQ(problem.pointer.substr(0, prefix.size()), prefix) << problem.detail;
      bool named = false;
      for (const json& name : entry["extensions_required"]) {
        named = named || problem.detail.find('"' + name.get<std::string>() + '"') != std::string::npos;
      }
      EXPECT_TRUE(named) << problem.detail;
    }
  }
}

} // namespace
} // namespace gnomon
