#pragma once

#include <optional>
#include <vector>

#include "renderer/device/device.h"
#include "renderer/frame/frame.h"
#include "renderer/frame/measured_shadow.h"

namespace gnomon {

/// The pictures that a frame's views take: one for each view that a device can show, and, where a view compares a
/// shadow with rays or edges are predicted, that shadow at full strength and a picture to paint on.
class FrameViews {
 public:
  /// `spec`: effective; it outlives this.
  explicit FrameViews(const FrameSpec& spec);

  const std::vector<ViewRequest>& requests() const { return requests_; }
  /// Some view compares a shadow with rays.
  bool needReference() const;

  /// The debug light's shadow at full strength, a value a pixel, first row on top. REQUIRES: needReference, or
  /// debug.predictEdges.
  std::vector<float> fullShadow(FrameDrawing& drawing) const;
  /// The pictures of the spec's views, in their order. `measured`: null where no view compares a shadow with rays.
  std::vector<ViewImage> images(FrameDrawing& drawing, const MeasuredShadow* measured) const;

 private:
  Image errorImage(FrameDrawing& drawing, View view, const MeasuredShadow& measured) const;

  const FrameSpec& spec_;
  std::vector<ViewRequest> requests_;
  std::vector<std::size_t> requestOf_;    ///< one a view of the spec; of no meaning for views of source rays
  std::optional<std::size_t> fullShadow_; ///< index of its request
  std::optional<std::size_t> backdrop_;
};

} // namespace gnomon
