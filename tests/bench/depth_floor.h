#pragma once

#include "renderer/render.h"

namespace gnomon::bench {

/// The bare depth-only draw of the triangles that a frame's survey found visible: the least that any renderer has to do
/// for the picture. Ratios are taken to it.
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
