#pragma once

#include "renderer/render.h"

namespace gnomon::bench {

/// The bare depth-only draw of the triangles in view (those of clusters that meet the view's frustum), in one call,
/// without textures: what any rasterizer has to do at least for the picture. Ratios are taken to it.
class DepthFloor {
 public:
  /// Prepares buffers, target and program, so that `draw` does nothing but draw. Uses the current context.
  DepthFloor(const Scene& scene, const FrameSpec& spec, int samples);
  ~DepthFloor();

  /// Clears and draws, and waits for the GPU; milliseconds.
  double draw();
  std::uint64_t triangles() const;

 private:
  struct Prepared;
  std::unique_ptr<Prepared> prepared_;
};

} // namespace gnomon::bench
