#include "renderer/scene/decode/draco_kept.h"

#include <algorithm>
#include <draco/mesh/mesh.h>

namespace gnomon {

namespace {

std::optional<ComponentType> typeOf(draco::DataType type) {
  switch (type) {
    case draco::DT_INT8:
      return ComponentType::int8;
    case draco::DT_UINT8:
      return ComponentType::uint8;
    case draco::DT_INT16:
      return ComponentType::int16;
    case draco::DT_UINT16:
      return ComponentType::uint16;
    case draco::DT_UINT32:
      return ComponentType::uint32;
    case draco::DT_FLOAT32:
      return ComponentType::float32;
    default:
      return std::nullopt;
  }
}

/// One value a point; nothing where the attribute is none that a glTF may have.
std::optional<DracoAttribute> attributeOf(const draco::PointAttribute& source, std::uint32_t points) {
  const auto type = typeOf(source.data_type());
  if (!type || source.num_components() < 1 || source.num_components() > 4) return std::nullopt;
  DracoAttribute attribute{*type, source.num_components(), {}};
  const std::size_t bytes = bytesOf(*type) * static_cast<std::size_t>(attribute.components);
  if (source.byte_stride() != static_cast<std::int64_t>(bytes)) return std::nullopt;
  attribute.bytes.resize(bytes * points);
  for (std::uint32_t point = 0; point < points; ++point) {
    const draco::AttributeValueIndex value = source.mapped_index(draco::PointIndex(point));
    if (value.value() >= source.size()) return std::nullopt;
    source.GetValue(value, attribute.bytes.data() + bytes * point);
  }
  return attribute;
}

} // namespace

std::optional<DracoMesh> keptMesh(const draco::Mesh& mesh, const std::set<std::uint32_t>& wanted,
                                  const std::string& pointer, Findings& findings) {
  DracoMesh kept;
  kept.points = mesh.num_points();
  kept.corners.reserve(std::size_t{3} * mesh.num_faces());
  for (std::uint32_t face = 0; face < mesh.num_faces(); ++face) {
    for (const auto& corner : mesh.face(draco::FaceIndex(face))) kept.corners.push_back(corner.value());
  }
  const auto outside = [&](std::uint32_t corner) { return corner >= mesh.num_points(); };
  if (std::any_of(kept.corners.begin(), kept.corners.end(), outside)) {
    findings.invalid(pointer, "The Draco data is damaged.");
    return std::nullopt;
  }
  for (const std::uint32_t id : wanted) {
    const draco::PointAttribute* source = mesh.GetAttributeByUniqueId(id);
    auto attribute = source ? attributeOf(*source, mesh.num_points()) : std::nullopt;
    if (!attribute) {
      findings.invalid(pointer, "The Draco data has no attribute " + std::to_string(id) + " that a glTF may have.");
      return std::nullopt;
    }
    kept.attributes.emplace(id, *std::move(attribute));
  }
  return kept;
}

} // namespace gnomon
