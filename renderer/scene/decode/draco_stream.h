#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "protocol/base/bytes.h"
#include "protocol/spec/limits.h"
#include "renderer/scene/decode/decode_budget.h"
#include "renderer/scene/geometry/accessor_view.h"

namespace gnomon {

/// What the accessors of a glTF say that a Draco stream holds.
struct DracoClaims {
  std::uint64_t points = 0;
  std::optional<std::uint64_t> triangles; ///< nothing where the glTF does not say
};

/// One value a point, packed.
struct DracoAttribute {
  ComponentType type = ComponentType::float32;
  int components = 0; ///< 1..4
  Bytes bytes;
};

struct DracoMesh {
  std::uint32_t points = 0;
  std::vector<std::uint32_t> corners;                 ///< three a triangle, below the number of points
  std::map<std::uint32_t, DracoAttribute> attributes; ///< by the id within the stream
};

/// Decodes a Draco bitstream 2.2 and keeps the attributes `wanted`. The numbers of triangles, points and attributes
/// that the stream states are held against the claims, the limits and the budget before memory is taken for them.
/// Nothing, and a problem at `pointer`, where they do not hold or the bytes can't be decoded.
/// Numbers of triangles and points other than the claimed ones are taken, with a repair, where the triangles could use
/// as many points: some encoders split vertices after they have counted them.
std::optional<DracoMesh> decodeDraco(std::span<const std::uint8_t> stream, const DracoClaims& claims,
                                     const std::set<std::uint32_t>& wanted, const Limits& limits, DecodeBudget& budget,
                                     const std::string& pointer, Findings& findings);

} // namespace gnomon
