#include "renderer/scene/document/gltf_document.h"

#include "renderer/scene/checks/gltf_schema.h"
#include "renderer/scene/container/json_text.h"
#include "renderer/scene/container/model_container.h"
#include "renderer/scene/container/resources.h"
#include "renderer/scene/decode/meshopt.h"
#include "renderer/scene/document/read_model.h"
#include "renderer/scene/graph/attachments.h"
#include "renderer/scene/graph/node_tree.h"

namespace gnomon {

namespace {

struct Count {
  const char* key;
  std::size_t limit;
};

void checkCounts(const nlohmann::json& document, const Limits& limits, Findings& findings) {
  for (const Count& count : {Count{"nodes", limits.maxNodes}, Count{"materials", limits.maxMaterials},
                             Count{"images", limits.maxImages}, Count{"animations", limits.maxAnimations}}) {
    const auto member = document.find(count.key);
    if (member == document.end() || member->size() <= count.limit) continue;
    findings.tooLarge(pointerTo("", count.key), "The glTF has too many " + std::string(count.key) + ".",
                      std::to_string(count.limit), std::to_string(member->size()));
  }
}

} // namespace

Result<GltfDocument> readGltf(const SceneBundle& bundle, const Limits& limits, Findings& findings) {
  auto container = openContainer(bundle.model, findings);
  if (!container) return std::move(container).problems();
  auto parsed = parseJsonText(container->json, limits);
  if (!parsed) return std::move(parsed).problems();

  checkVersion(*parsed, findings);
  checkExtensions(*parsed, findings);
  if (findings.refused()) return findings.takeProblems();
  checkSchema(*parsed, findings);
  checkCounts(*parsed, limits, findings);
  if (findings.refused()) return findings.takeProblems();

  GltfDocument document;
  document.model = readModel(*std::move(parsed));
  checkCameras(document.model.cameras, findings);
  checkLights(document.model.lights, findings);
  settleSceneRoots(document.model, limits, findings);
  const gltf::Model& model = document.model;
  checkTransforms(model.nodes, findings);
  const std::vector<bool> fallbacks = meshoptFallbacks(model, container->binary.has_value());
  document.buffers = readBuffers(model, fallbacks, container->binary, bundle, findings);
  DecodeBudget budget(limits.maxDecodedBytes);
  BufferViews views = readBufferViews(model, document.buffers, fallbacks, budget, findings);
  document.bufferViews = std::move(views.bytes);
  document.decodedViews = std::move(views.decoded);
  document.decodedBytes = budget.used();
  document.images = readImages(model, document.bufferViews, bundle, findings);
  if (findings.refused()) return findings.takeProblems();
  return document;
}

} // namespace gnomon
