#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "renderer/scene/document/gltf_document.h"
#include "renderer/scene/findings.h"
#include "renderer/scene/geometry/accessor_view.h"

namespace gnomon {

/// The copies that EXT_mesh_gpu_instancing makes of a node's mesh.
struct Instancing {
  std::uint64_t count = 0;
  const AccessorView* translations = nullptr; ///< nullptr = none
  const AccessorView* rotations = nullptr;
  const AccessorView* scales = nullptr;

  /// Where the copy stands, relative to the node. Nothing where its rotation has no direction or a number is not
  /// finite.
  std::optional<glm::dmat4> nodeFromCopy(std::size_t copy) const;
};

/// The instancing of a node that has it; nothing, and perhaps a problem, otherwise. The
/// accessors must outlive the result.
std::optional<Instancing> instancingOf(const LoadContext& load, std::size_t node);

} // namespace gnomon
