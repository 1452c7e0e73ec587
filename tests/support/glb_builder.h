#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/scene_bundle.h"

namespace gnomon::testing {

using Point = std::array<float, 3>;

/// A GLB of these two parts, whatever they hold; no BIN chunk if `binary` is empty.
Bytes makeGlb(std::string_view json, const Bytes& binary = {});

/// A glTF under construction. Everything in `json` may be changed by hand before glb() is called, so that a test
/// can tell any lie; buffer 0 and its byteLength are added by glb() unless `json` already has buffers, as are
/// extensionsUsed and the min and max of positions.
struct GlbBuilder {
  nlohmann::json json = {{"asset", {{"version", "2.0"}}}};
  Bytes binary;

  /// Appends to an array of the root; returns the index of the new element.
  int add(const char* array, nlohmann::json element);

  /// Appends bytes at the next multiple of 4 as a buffer view.
  int addView(const void* data, std::size_t bytes, int stride = 0);

  template <class T>
  int addView(const std::vector<T>& values, int stride = 0) {
    return addView(values.data(), values.size() * sizeof(T), stride);
  }

  /// An accessor over a buffer view of its own. `type` and `componentType` as in glTF ("VEC3", 5126).
  template <class T>
  int addAccessor(const std::vector<T>& values, const char* type, int componentType, std::size_t count,
                  bool normalized = false) {
    nlohmann::json accessor = {
        {"bufferView", addView(values)}, {"componentType", componentType}, {"count", count}, {"type", type}};
    if (normalized) accessor["normalized"] = true;
    return add("accessors", std::move(accessor));
  }

  int addPoints(const std::vector<Point>& points);                ///< VEC3 float
  int addIndices(const std::vector<std::uint32_t>& indices);      ///< SCALAR unsigned int
  int addShortIndices(const std::vector<std::uint16_t>& indices); ///< SCALAR unsigned short

  /// A mesh of one primitive; `primitive` is its JSON.
  int addMesh(nlohmann::json primitive);

  /// A node with a mesh, at the root of scene 0, which is made if need be.
  int addMeshNode(int mesh);

  /// A node of any content at the root of scene 0.
  int addRoot(nlohmann::json node);

  Bytes glb() const;
  SceneBundle bundle() const;
};

/// A cube from -1 to 1 with normals and 12 triangles, drawn at the origin: mesh 0, node 0.
GlbBuilder cube();

/// A square in the plane y = 0 from -1 to 1, facing up, with normals and texture coordinates: mesh 0, node 0.
GlbBuilder plane();

/// One triangle without indices or normals: mesh 0, node 0.
GlbBuilder triangle();

} // namespace gnomon::testing
