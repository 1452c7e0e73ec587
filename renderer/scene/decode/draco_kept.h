#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>

#include "renderer/scene/decode/draco_stream.h"
#include "renderer/scene/findings.h"

namespace draco {
class Mesh;
}

namespace gnomon {

/// Triangles and the attributes `wanted` of a decoded mesh; nothing, and a problem, where an index lies outside of it
/// or an attribute is none that a glTF may have.
std::optional<DracoMesh> keptMesh(const draco::Mesh& mesh, const std::set<std::uint32_t>& wanted,
                                  const std::string& pointer, Findings& findings);

} // namespace gnomon
