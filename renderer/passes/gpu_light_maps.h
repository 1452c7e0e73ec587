#pragma once

#include <list>
#include <memory>

#include "renderer/bake/baked_light.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/texture.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// The triangles of all of a scene's instances, over vertices that each know where they lie in light maps of one
/// layout.
struct GpuMappedScene {
  std::shared_ptr<const LightMapLayout> layout;
  gl::Buffer positions;  ///< vec3
  gl::Buffer attributes; ///< VertexAttributes
  gl::Buffer places;     ///< vec2, 0..1 across the map
  gl::Buffer indices;    ///< parallel to the layout's corners
};

/// A light map on the device.
struct GpuLightMap {
  gl::Texture shares; ///< R16
  std::shared_ptr<const GpuMappedScene> scene;
};

/// Uploaded light maps: each as long as something else holds it.
class GpuLightMaps {
 public:
  /// Made now if need be; valid until the next call that the map is not alive for. `scene`, `view`: whose surfaces the
  /// map is of.
  const GpuLightMap& get(const std::shared_ptr<const BakedLight>& baked, const Scene& scene, const SceneView& view);

 private:
  struct Entry {
    std::weak_ptr<const BakedLight> baked;
    GpuLightMap gpu;
  };
  std::list<Entry> entries_;
};

} // namespace gnomon
