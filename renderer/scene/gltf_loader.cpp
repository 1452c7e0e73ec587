#include "renderer/scene/gltf_loader.h"

#include <algorithm>
#include <exception>
#include <new>
#include <string_view>

#include "protocol/base/bytes.h"
#include "renderer/core/grid_file_kind.h"
#include "renderer/environment/read_environment.h"
#include "renderer/scene/animation/motion.h"
#include "renderer/scene/animation/posed_scene.h"
#include "renderer/scene/decode/draco_primitives.h"
#include "renderer/scene/document/gltf_document.h"
#include "renderer/scene/findings.h"
#include "renderer/scene/geometry/accessor_view.h"
#include "renderer/scene/geometry/mesh_build.h"
#include "renderer/scene/geometry/mesh_source.h"
#include "renderer/scene/graph/attachments.h"
#include "renderer/scene/graph/image_based_lights.h"
#include "renderer/scene/graph/node_tree.h"
#include "renderer/scene/graph/scene_views.h"
#include "renderer/scene/ground.h"
#include "renderer/scene/materials/materials.h"
#include "renderer/scene/posing/deformation.h"
#include "renderer/scene/posing/pose.h"
#include "renderer/scene/summary.h"

namespace gnomon {

namespace {

bool isEmpty(const BuiltMesh& mesh) {
  return mesh.primitives.empty() && mesh.deformables.empty();
}

/// Volumes and environments are named by frames, and not by the model: kept as they are, by their first bytes.
template <class Kept, class Is>
std::map<std::string, std::shared_ptr<const Kept>> filesThat(const SceneBundle& bundle, const Is& are) {
  std::map<std::string, std::shared_ptr<const Kept>> files;
  for (const auto& [name, file] : bundle.files) {
    if (are(file)) files.emplace(name, std::make_shared<const Kept>(file));
  }
  return files;
}

Result<std::shared_ptr<const Scene>> load(const SceneBundle& bundle, const Limits& limits, const std::string& id,
                                          KnownContent* known) {
  Findings findings(bundle.strict ? Conformance::strict : Conformance::repaired);
  auto document = readGltf(bundle, limits, findings);
  if (!document) return std::move(document).problems();

  const gltf::Model& model = document->model;
  const std::vector<AccessorView> views = viewAccessors(*document, limits, findings);
  if (findings.refused()) return findings.takeProblems();
  const LoadContext context{*document, views, limits, findings};
  checkContents(context);
  auto motion = std::make_shared<Motion>();
  motion->animations = readAnimations(context);
  auto deformation = std::make_shared<Deformation>();
  deformation->skins = readSkins(context);
  checkVariantCount(model, limits, findings);
  const DracoPrimitives draco = decodeDracoPrimitives(context);
  if (findings.refused()) return findings.takeProblems();

  auto scene = std::make_shared<Scene>();
  scene->materials = readMaterials(model, findings);
  const std::vector<UvSets> uvSets = placeUvSets(model, scene->materials, findings);
  const auto sources = gatherMeshes(context, draco, uvSets);
  if (findings.refused()) return findings.takeProblems();
  const int defaultMaterial = static_cast<int>(scene->materials.size()) - 1;
  const std::vector<BuiltMesh> meshes =
      buildMeshes(sources, defaultMaterial, *scene, deformation->deformables, findings, known);
  if (findings.lostTriangles() && std::ranges::all_of(meshes, isEmpty)) findings.refuseRepaired();
  const NodeTree tree = buildNodeTree(model, findings);
  if (findings.refused()) return findings.takeProblems();
  checkSkinRoots(model, tree.parents, tree.order, findings);
  const std::vector<PosedMesh> posed = poseNodes(context, tree, meshes, *deformation, *scene);
  if (findings.refused()) return findings.takeProblems();
  FlatScenes flat = flattenScenes(context, {tree, meshes, posed, scene->primitives}, !motion->animations.empty());
  if (findings.refused()) return findings.takeProblems();
  scene->scenes = std::move(flat.views);
  scene->imageBasedLights = readImageBasedLights(context);
  if (findings.refused()) return findings.takeProblems();
  for (std::size_t i = 0; i < model.scenes.size(); ++i) {
    const int light = model.scenes[i].imageBasedLight;
    const bool isThere = light >= 0 && scene->imageBasedLights[static_cast<std::size_t>(light)];
    scene->scenes[i].imageBasedLight = isThere ? light : -1;
  }
  motion->parents = tree.parents;
  motion->order = tree.order;
  motion->locals = tree.locals;
  motion->visible = tree.visible;
  if (std::ranges::any_of(motion->animations, [](const Animation& each) { return !each.properties.empty(); })) {
    motion->properties = Properties{model.materials, model.cameras, model.lights};
  }
  motion->views = std::move(flat.moving);
  scene->motion = std::move(motion);
  scene->poses = std::make_shared<PoseCache>();
  scene->variants = model.variants;
  addVariantScenes(limits, *scene, findings);
  if (findings.refused()) return findings.takeProblems();
  if (!deformation->posed.empty()) scene->deformation = std::move(deformation);
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    scene->nodes.push_back({model.nodes[i].name, tree.parents[i]});
  }
  scene->leftOutCameras = leftOutCameras(model);
  scene->images = loadImages(*document, limits, scene->materials, findings, known);
  if (findings.refused()) return findings.takeProblems();

  if (findings.violated()) return findings.takeProblems();
  scene->grids = filesThat<Bytes>(bundle, [](const Bytes& file) { return gridFileKind(asText(file)).has_value(); });
  scene->environmentFiles =
      filesThat<EnvironmentFile>(bundle, [](const Bytes& file) { return isEnvironmentFile(file); });
  if (!scene->grids.empty()) scene->placedNodes = placedNodes(tree, tree.hidden);
  addGroundMesh(*scene);
  scene->defaultScene = std::max(model.scene, 0);
  scene->summary = summarize(model, bundle, *scene);
  scene->summary.id = id;
  scene->summary.warnings = findings.takeWarnings();
  if (known != nullptr) known->keepMeshes(scene);
  return std::shared_ptr<const Scene>(std::move(scene));
}

} // namespace

Result<std::shared_ptr<const Scene>> loadGltf(const SceneBundle& bundle, const Limits& limits, const std::string& id,
                                              KnownContent* known) {
  try {
    return load(bundle, limits, id, known);
  } catch (const std::bad_alloc&) {
    return noMemory({}, "There is not enough memory for this scene.");
  } catch (const std::exception&) {
    return Problem{ProblemCode::internal, {}, "The scene could not be loaded."};
  }
}

} // namespace gnomon
