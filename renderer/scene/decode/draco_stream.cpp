#include <algorithm>
#include <array>
#include <draco/compression/attributes/prediction_schemes/mesh_prediction_scheme_data.h>
#include <draco/compression/attributes/prediction_schemes/mesh_prediction_scheme_tex_coords_decoder.h>
#include <draco/compression/attributes/prediction_schemes/mesh_prediction_scheme_tex_coords_portable_decoder.h>
#include <draco/compression/attributes/prediction_schemes/prediction_scheme_wrap_decoding_transform.h>
#include <draco/compression/config/decoder_options.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/mesh/mesh.h>
#include <draco/mesh/mesh_attribute_corner_table.h>
#include <type_traits>

#include "renderer/scene/decode/draco_primitives.h"

// Draco 1.5 takes memory and many seconds for as many orientations as a stream states, up to 2^31, though each belongs
// to a corner of a triangle (bitstream specification 2.2, "Prediction Texture Coordinates Portable"). These definitions
// stand in for the library's, which calls its own by symbol; test: Draco.OrientationsAreNoMoreThanCorners.
namespace draco {

using Wrapping = PredictionSchemeWrapDecodingTransform<int, int>;
using OfCorners = MeshPredictionSchemeData<CornerTable>;
using OfAttribute = MeshPredictionSchemeData<MeshAttributeCornerTable>;
template <class MeshData>
using Portable = MeshPredictionSchemeTexCoordsPortableDecoder<int, Wrapping, MeshData>;
template <class MeshData>
using Deprecated = MeshPredictionSchemeTexCoordsDecoder<int, Wrapping, MeshData>;

namespace {

/// Where each of them is kept: `resize` and then `set`. A bit 0 turns the orientation over.
template <class Resize, class Set>
bool decodeOrientations(DecoderBuffer& buffer, int corners, Resize resize, Set set) {
  std::uint32_t count = 0;
  RAnsBitDecoder bits;
  if (!buffer.Decode(&count) || count > static_cast<std::uint32_t>(corners) || !bits.StartDecoding(&buffer)) {
    return false;
  }
  resize(static_cast<int>(count));
  bool orientation = true;
  for (int i = 0; i < static_cast<int>(count); ++i) {
    orientation = orientation == bits.DecodeNextBit();
    set(i, orientation);
  }
  bits.EndDecoding();
  return true;
}

} // namespace

template <>
bool Portable<OfCorners>::DecodePredictionData(DecoderBuffer* buffer) {
  return decodeOrientations(
             *buffer, mesh_data().corner_table()->num_corners(), [&](int n) { predictor_.ResizeOrientations(n); },
             [&](int i, bool v) { predictor_.set_orientation(i, v); }) &&
         MeshPredictionSchemeDecoder::DecodePredictionData(buffer);
}

template <>
bool Portable<OfAttribute>::DecodePredictionData(DecoderBuffer* buffer) {
  return decodeOrientations(
             *buffer, mesh_data().corner_table()->num_corners(), [&](int n) { predictor_.ResizeOrientations(n); },
             [&](int i, bool v) { predictor_.set_orientation(i, v); }) &&
         MeshPredictionSchemeDecoder::DecodePredictionData(buffer);
}

// No encoder of the version that glTF has writes these.
template <>
bool Deprecated<OfCorners>::DecodePredictionData(DecoderBuffer*) {
  return false;
}
template <>
bool Deprecated<OfAttribute>::DecodePredictionData(DecoderBuffer*) {
  return false;
}

} // namespace draco

namespace gnomon {

namespace {

/// The checks of a stream while it is decoded, and where they report.
struct StreamCheck {
  const DracoClaims& claims;
  const Limits& limits;
  DecodeBudget& budget;
  const std::string& pointer;
  Findings& findings;

  bool withinLimit(const char* of, std::uint64_t limit, std::uint64_t stated) const {
    if (stated <= limit) return true;
    findings.tooLarge(pointer, std::string("The Draco data has too many ") + of + ".", std::to_string(limit),
                      std::to_string(stated));
    return false;
  }

  bool triangles(std::uint64_t stated) const {
    if (claims.triangles && *claims.triangles != stated) {
      findings.repair(
          {"Draco data has another number of triangles than its accessor states", "those that it has are drawn"},
          pointer, std::to_string(*claims.triangles), std::to_string(stated));
    }
    return withinLimit("triangles", limits.maxTriangles, stated) &&
           budget.take(3 * sizeof(std::uint32_t) * stated, pointer, findings);
  }
  bool points(std::uint64_t stated, std::uint64_t triangles) const {
    if (stated > 3 * triangles) {
      findings.invalid(pointer, "The Draco data has more vertices than its triangles have corners.",
                       std::to_string(3 * triangles), std::to_string(stated));
      return false;
    }
    return withinLimit("vertices", limits.maxVertices, stated);
  }
  /// All of a stream's attributes are decoded, wanted or not.
  bool attributes(const draco::PointCloud& cloud) const {
    std::uint64_t bytes = 0; // of one point: there are at most as many attributes as bytes in the stream
    for (int i = 0; i < cloud.num_attributes(); ++i) {
      const draco::PointAttribute& attribute = *cloud.attribute(i);
      bytes += static_cast<std::uint64_t>(attribute.num_components()) *
               static_cast<std::uint64_t>(draco::DataTypeLength(attribute.data_type()));
    }
    return budget.take(bytes * cloud.num_points(), pointer, findings);
  }
};

/// One of Draco's decoders that stops at each number before it is acted on.
template <class Decoder>
class CheckedDecoder : public Decoder {
 public:
  explicit CheckedDecoder(const StreamCheck& check) : check_(check) {}

 protected:
  /// The connectivity begins with two numbers (Draco bitstream specification 2.2, sections 2.3 and 2.4).
  bool DecodeConnectivity() override {
    constexpr bool kEdgebreaker = std::is_same_v<Decoder, draco::MeshEdgebreakerDecoder>;
    draco::DecoderBuffer ahead = *this->buffer();
    std::uint32_t first = 0;
    std::uint32_t second = 0;
    if (!draco::DecodeVarint(&first, &ahead) || !draco::DecodeVarint(&second, &ahead)) return false;
    const std::uint64_t triangles = kEdgebreaker ? second : first;
    const std::uint64_t vertices = kEdgebreaker ? first : second;
    if (!check_.triangles(triangles)) return false;
    if (!check_.points(vertices, triangles)) return false;
    return Decoder::DecodeConnectivity() && check_.points(this->point_cloud()->num_points(), triangles);
  }

  bool DecodeAllAttributes() override {
    return check_.attributes(*this->point_cloud()) && Decoder::DecodeAllAttributes();
  }

 private:
  StreamCheck check_;
};

/// The method of the stream's header; nothing, and a problem, where it is none that is decoded.
std::optional<int> methodOf(std::span<const std::uint8_t> stream, const std::string& pointer, Findings& findings) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(stream.data()), stream.size());
  draco::DracoHeader header{};
  if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok() || header.encoder_type != draco::TRIANGULAR_MESH ||
      header.encoder_method > draco::MESH_EDGEBREAKER_ENCODING) {
    findings.invalid(pointer, "The buffer view does not hold a Draco mesh.");
    return std::nullopt;
  }
  if (header.version_major != 2 || header.version_minor != 2) {
    findings.unsupported(pointer, "The Draco data is of version " + std::to_string(header.version_major) + "." +
                                      std::to_string(header.version_minor) + "; glTF has 2.2.");
    return std::nullopt;
  }
  if ((header.flags & METADATA_FLAG_MASK) != 0) {
    findings.unsupported(pointer, "The Draco data carries metadata, which is not supported.");
    return std::nullopt;
  }
  return header.encoder_method;
}

bool run(draco::MeshDecoder&& decoder, std::span<const std::uint8_t> stream, draco::Mesh& mesh) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(stream.data()), stream.size());
  return decoder.Decode(draco::DecoderOptions(), &buffer, &mesh).ok();
}

using DracoType = std::pair<draco::DataType, ComponentType>;
constexpr std::array<DracoType, 6> kTypes{{{draco::DT_INT8, ComponentType::int8},
                                           {draco::DT_UINT8, ComponentType::uint8},
                                           {draco::DT_INT16, ComponentType::int16},
                                           {draco::DT_UINT16, ComponentType::uint16},
                                           {draco::DT_UINT32, ComponentType::uint32},
                                           {draco::DT_FLOAT32, ComponentType::float32}}};

/// One value a point; nothing where the attribute is none that a glTF may have.
std::optional<DracoAttribute> attributeOf(const draco::PointAttribute& source, std::uint32_t points) {
  const auto* type = std::ranges::find(kTypes, source.data_type(), &DracoType::first);
  if (type == kTypes.end() || source.num_components() < 1 || source.num_components() > 4) return std::nullopt;
  DracoAttribute attribute{type->second, source.num_components(), {}};
  const std::size_t bytes = bytesOf(type->second) * static_cast<std::size_t>(attribute.components);
  if (source.byte_stride() != static_cast<std::int64_t>(bytes)) return std::nullopt;
  attribute.bytes.resize(bytes * points);
  for (std::uint32_t point = 0; point < points; ++point) {
    const draco::AttributeValueIndex value = source.mapped_index(draco::PointIndex(point));
    if (value.value() >= source.size()) return std::nullopt;
    source.GetValue(value, attribute.bytes.data() + bytes * point);
  }
  return attribute;
}

/// Triangles and the attributes `wanted` of a decoded mesh, without those of other types than glTF's; nothing, and a
/// problem, where an index lies outside of it.
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
      findings.repair(
          {"Draco data lacks an attribute, or has it in a type that a glTF does not have", "it is left out"}, pointer,
          {}, "attribute " + std::to_string(id));
      continue;
    }
    kept.attributes.emplace(id, *std::move(attribute));
  }
  return kept;
}

} // namespace

std::optional<DracoMesh> decodeDraco(std::span<const std::uint8_t> stream, const DracoClaims& claims,
                                     const std::set<std::uint32_t>& wanted, const Limits& limits, DecodeBudget& budget,
                                     const std::string& pointer, Findings& findings) {
  const auto method = methodOf(stream, pointer, findings);
  if (!method) return std::nullopt;
  const bool toldBefore = findings.refused();
  const StreamCheck check{claims, limits, budget, pointer, findings};
  draco::Mesh mesh;
  const bool decoded = *method == draco::MESH_EDGEBREAKER_ENCODING
                           ? run(CheckedDecoder<draco::MeshEdgebreakerDecoder>(check), stream, mesh)
                           : run(CheckedDecoder<draco::MeshSequentialDecoder>(check), stream, mesh);
  if (!decoded) {
    if (toldBefore || !findings.refused()) findings.invalid(pointer, "The Draco data is damaged.");
    return std::nullopt;
  }
  if (mesh.num_points() != claims.points) {
    findings.repair(
        {"Draco data has another number of vertices than its accessors state", "those that it has are drawn"}, pointer,
        std::to_string(claims.points), std::to_string(mesh.num_points()));
  }
  return keptMesh(mesh, wanted, pointer, findings);
}

} // namespace gnomon
