// Every public model cut short and with bytes changed: a problem or a scene, never anything else. Minutes; the folder
// of models is named by GNOMON_TEST_ASSETS, and without it these tests are skipped.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <malloc.h>
#include <nlohmann/json.hpp>
#include <random>

#include "tests/renderer/scene/load.h"
#include "tests/support/gathered_model.h"

namespace gnomon {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t kCuts = 200;
constexpr int kFlips = 1000;
constexpr std::size_t kLargeModel = 1 << 20; ///< bytes; from here on ten of the flips are made at once

/// A server's, but for what takes seconds to draw on when a changed number asks for it.
Limits quickLimits() {
  Limits limits;
  limits.maxTriangles = 1'000'000;
  limits.maxVertices = 2'000'000;
  limits.maxMorphedVertices = 4'000'000;
  limits.maxDecodedBytes = 64u << 20;
  limits.maxImagePixels = 16'777'216;
  limits.maxImageSide = 4096;
  return limits;
}

fs::path assetFolder() {
  const char* named = std::getenv("GNOMON_TEST_ASSETS");
  return named ? fs::path(named) : fs::path(GNOMON_TEST_ASSETS_DEFAULT);
}

struct Model {
  std::string name;
  SceneBundle bundle;
};

std::vector<Model> models() {
  std::vector<Model> found;
  std::ifstream manifest(assetFolder() / "manifest.json");
  if (!manifest) return found;
  const json list = json::parse(manifest);
  for (const json& entry : list["models"]) {
    found.push_back({entry["path"].get<std::string>(), testing::gatheredBundle(assetFolder(), entry)});
  }
  return found;
}

void write32(Bytes& bytes, std::size_t offset, std::size_t value) {
  for (std::size_t i = 0; i < 4; ++i) bytes[offset + i] = static_cast<std::uint8_t>(value >> (8 * i));
}

/// A GLB that was cut, with lengths that fit what is left, so that its buffer ends too early and nothing else is wrong.
void mendLengths(Bytes& glb) {
  if (glb.size() < 20 || glb[0] != 'g') return;
  const std::size_t text = glb[12] | glb[13] << 8 | glb[14] << 16 | glb[15] << 24;
  const std::size_t binary = 20 + text;
  if (glb.size() >= binary + 8) {
    glb.resize(glb.size() / 4 * 4);
    write32(glb, binary, glb.size() - binary - 8);
  }
  write32(glb, 8, glb.size());
}

/// Every other cut lies in what the JSON names: the GLB's binary, or the files beside the model.
SceneBundle cutShort(const SceneBundle& whole, std::size_t cut) {
  SceneBundle bundle = whole;
  if (cut % 2 == 1 && !bundle.files.empty()) {
    for (auto& [name, content] : bundle.files) content.resize(content.size() * cut / kCuts);
    return bundle;
  }
  bundle.model.resize(bundle.model.size() * cut / kCuts);
  if (cut % 2 == 1) mendLengths(bundle.model);
  return bundle;
}

struct Answers {
  int loaded = 0;
  int refused = 0;

  void add(const SceneBundle& bundle, const std::string& name) {
    const auto scene = loadGltf(bundle, quickLimits());
    Problems problems = scene ? Problems{} : scene.problems();
    for (const auto& image : scene ? (*scene)->images : SceneImages{}) {
      if (const Status decoded = image->decode(); !decoded) problems = decoded.problems();
    }
    if (scene && problems.empty()) {
      ++loaded;
      return;
    }
    ++refused;
    ASSERT_FALSE(problems.empty()) << name;
    for (const Problem& problem : problems) {
      EXPECT_NE(problem.code, ProblemCode::internal) << name << " " << problem.pointer << " " << problem.detail;
    }
  }
};

/// The bytes that this program has taken and not given back.
std::size_t heldBytes() {
  return mallinfo2().uordblks + mallinfo2().hblkhd;
}

void expectNothingKept(std::size_t before, std::size_t largest) {
  const std::size_t after = heldBytes();
  EXPECT_LE(after, before + before / 20 + largest / 20) << "bytes held before, and after";
}

/// What `breakModel` does to each model: answered soundly, and nothing of it is kept.
void expectSurvived(const std::vector<Model>& all, const std::function<void(const Model&, Answers&)>& breakModel) {
  for (const Model& model : all) {
    Answers().add(model.bundle, model.name); // loads what decoding needs
    const std::size_t before = heldBytes();
    Answers answers;
    breakModel(model, answers);
    expectNothingKept(before, model.bundle.model.size());
    std::cout << model.name << ": " << answers.refused << " refused, " << answers.loaded << " loaded" << std::endl;
  }
}

void cutEverywhere(const Model& model, Answers& answers) {
  for (std::size_t cut = 0; cut < kCuts; ++cut) answers.add(cutShort(model.bundle, cut), model.name);
}

void changeBytes(const Model& model, Answers& answers) {
  std::mt19937 random(20);
  const int together = model.bundle.model.size() < kLargeModel ? 1 : 10;
  for (int file = 0; file < kFlips / together; ++file) {
    SceneBundle bundle = model.bundle;
    std::vector<Bytes*> parts{&bundle.model};
    for (auto& [name, content] : bundle.files) parts.push_back(&content);
    for (int flip = 0; flip < together; ++flip) {
      Bytes& part = *parts[random() % parts.size()];
      if (!part.empty()) part[random() % part.size()] ^= static_cast<std::uint8_t>(1 + random() % 255);
    }
    answers.add(bundle, model.name);
  }
}

class BrokenFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    if (all_.empty()) GTEST_SKIP() << "no models in " << assetFolder() << " (GNOMON_TEST_ASSETS)";
  }

  const std::vector<Model> all_ = models();
};

TEST_F(BrokenFiles, EachModelCutAt200Places) {
  expectSurvived(all_, cutEverywhere);
}

TEST_F(BrokenFiles, EachModelWith1000BytesChanged) {
  expectSurvived(all_, changeBytes);
}

} // namespace
} // namespace gnomon
