#include "renderer/scene/posing/skins.h"

#include <cmath>

#include "renderer/core/aabb.h"

namespace gnomon {

namespace {

bool isOfFloatMatrices(const tinygltf::Accessor& accessor) {
  return accessor.type == TINYGLTF_TYPE_MAT4 && accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
}

void readBindMatrices(const GltfDocument& document, const std::vector<AccessorView>& accessors, std::size_t accessor,
                      const std::string& pointer, Skin& skin, Findings& findings) {
  const AccessorView& view = accessors[accessor];
  if (!isOfFloatMatrices(document.model.accessors[accessor])) {
    return findings.invalid(pointer, "The accessor of the inverse bind matrices is not of MAT4 of floats.");
  }
  if (view.count < skin.joints.size()) {
    return findings.invalid(pointer, "The skin has fewer inverse bind matrices than joints.",
                            ">= " + std::to_string(skin.joints.size()), std::to_string(view.count));
  }
  for (std::size_t joint = 0; joint < skin.joints.size(); ++joint) {
    glm::dmat4& matrix = skin.jointFromMesh[joint];
    matrix = view.readMatrix(joint);
    for (int column = 0; column < 4; ++column) matrix[column].w = column < 3 ? 0 : 1; // affine, whatever was rounded
    if (finite(matrix)) continue;
    return findings.invalid(pointer, "An inverse bind matrix is not finite.", {}, "of joint " + std::to_string(joint));
  }
}

} // namespace

std::vector<Skin> readSkins(const GltfDocument& document, const std::vector<AccessorView>& accessors,
                            const Limits& limits, Findings& findings) {
  std::vector<Skin> skins;
  const auto sources = document.json.find("skins");
  if (sources == document.json.end()) return skins;
  std::size_t joints = 0;
  for (std::size_t i = 0; i < sources->size(); ++i) {
    const nlohmann::json& source = (*sources)[i];
    const std::string pointer = pointerTo("/skins", i);
    joints += source["joints"].size();
    if (joints > limits.maxJoints) {
      findings.tooLarge(pointer + "/joints", "The skins have too many joints.", std::to_string(limits.maxJoints),
                        std::to_string(joints));
      return {};
    }
    if (source["joints"].empty()) {
      findings.invalid(pointer + "/joints", "The skin has no joints.", ">= 1", "0");
      continue;
    }
    Skin skin{source["joints"].get<std::vector<int>>(), {}};
    skin.jointFromMesh.resize(skin.joints.size(), glm::dmat4(1));
    const auto matrices = source.find("inverseBindMatrices");
    if (matrices != source.end()) {
      readBindMatrices(document, accessors, matrices->get<std::size_t>(), pointer + "/inverseBindMatrices", skin,
                       findings);
    }
    skins.push_back(std::move(skin));
  }
  return skins;
}

} // namespace gnomon
