#include "renderer/scene/gltf_document.h"

#include "renderer/scene/checks/extension_gate.h"
#include "renderer/scene/checks/gltf_schema.h"
#include "renderer/scene/checks/typed_model.h"
#include "renderer/scene/container/gltf_resources.h"
#include "renderer/scene/container/json_text.h"
#include "renderer/scene/container/model_container.h"
#include "renderer/scene/decode/meshopt_view.h"
#include "renderer/scene/graph/cameras.h"
#include "renderer/scene/graph/lights.h"
#include "renderer/scene/graph/node_transform.h"

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
  auto container = openContainer(bundle.model);
  if (!container) return std::move(container).problems();
  auto json = parseJsonText(container->json, limits);
  if (!json) return std::move(json).problems();

  checkVersion(*json, findings);
  checkExtensions(*json, findings);
  if (findings.refused()) return findings.takeProblems();
  checkSchema(*json, findings);
  checkCounts(*json, limits, findings);
  if (findings.refused()) return findings.takeProblems();
  checkCameras(*json, findings);
  checkLights(*json, findings);
  checkTransforms(*json, findings);

  GltfDocument document;
  document.json = *std::move(json);
  const std::vector<bool> fallbacks = meshoptFallbacks(document.json, container->binary.has_value());
  document.buffers = readBuffers(document.json, fallbacks, container->binary, bundle, findings);
  DecodeBudget budget(limits.maxDecodedBytes);
  BufferViews views = readBufferViews(document.json, document.buffers, fallbacks, budget, findings);
  document.bufferViews = std::move(views.bytes);
  document.decodedViews = std::move(views.decoded);
  document.decodedBytes = budget.used();
  document.images = readImages(document.json, document.bufferViews, bundle, findings);
  if (findings.refused()) return findings.takeProblems();

  auto model = typedModel(document.json);
  if (!model) return std::move(model).problems();
  document.model = *std::move(model);
  return document;
}

} // namespace gnomon
