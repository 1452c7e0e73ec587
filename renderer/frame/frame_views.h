#pragma once

#include <optional>
#include <span>
#include <vector>

#include "protocol/base/result.h"
#include "protocol/report/frame_report.h"
#include "protocol/spec/traits.h"
#include "renderer/device/device.h"
#include "renderer/frame/frame.h"
#include "renderer/frame/geometry_views.h"
#include "renderer/frame/sun_hours_view.h"
#include "renderer/image/image.h"
#include "renderer/reference/reference.h"
#include "renderer/resolve/resolve_frame.h"

/// The pictures of a frame: what a device shows, and the shadow of debug.light compared with rays.
namespace gnomon {

/// One light's shadow, compared with rays.
struct MeasuredShadow {
  Reference truth;          ///< of that light alone; of none where there is none, or it gives off nothing
  std::vector<float> shown; ///< S: the share of it that the technique lets through, full strength; a value a pixel
  ErrorMetrics errors;      ///< without shimmer and predicted
};

/// Where a frame's light from everywhere comes from, and the volumes that dim it.
struct FrameSurroundings {
  const FrameEnvironment& environment;
  std::span<const Medium* const> media;
};

/// Traces light `light` of a frame (-1 = it has none; kEnvironmentLight) and holds `shown` against it. `around`: the
/// frame's; its media count for the environment alone.
Result<MeasuredShadow> measureShadow(const ResolvedFrame& frame, const TracedScene& traced, int light,
                                     const FrameSurroundings& around, std::vector<float> shown);

/// The pictures that a frame's views take: one for each view that a device can show, and, where a view compares a
/// shadow with rays or edges are predicted, that shadow at full strength and a picture to paint on.
class FrameViews {
 public:
  /// `spec`: effective; it outlives this. `castersByRays`: view casterIds is not the device's, as no map decides the
  /// shadow of debug.light.
  FrameViews(const FrameSpec& spec, bool castersByRays);

  const std::vector<ViewRequest>& requests() const { return requests_; }
  /// Some view compares a shadow with rays.
  bool needReference() const;
  /// Some view adds up hours of sun.
  bool needSunHours() const;
  /// Some view shows the triangles that are seen.
  bool needGeometry() const;
  /// Some view shows the caster of debug.light's shadow, found by rays.
  bool needCasters() const;

  /// The debug light's shadow at full strength, a value a pixel, first row on top. REQUIRES: needReference, or
  /// debug.predictEdges.
  std::vector<float> fullShadow(FrameDrawing& drawing) const;
  /// The pictures of the spec's views, in their order. `measured`: null where no view compares a shadow with rays;
  /// `geometry`: null where none shows triangles; `casters`: casterNodes, of no meaning unless needCasters;
  /// `sunHours`: null unless needSunHours.
  std::vector<ViewImage> images(FrameDrawing& drawing, const MeasuredShadow* measured, const ShownGeometry* geometry,
                                const std::vector<int>& casters, const ShownSunHours* sunHours) const;

 private:
  bool isTraced(View view) const; ///< view casterIds where rays make it
  bool isDrawn(View view) const;  ///< by the device
  /// What the view is made as; words that are numbers come from numbers.
  PixelType madePixels(View view) const;
  /// As numbers: V of view reference; S - V of view error, 0 where no receiver; pixels of view edgeDistance, -1 = no
  /// edge, infinity where V has none. As a picture: V as grey; error's false shadow red, false light blue;
  /// edgeDistance's edge pixels of S as a heat map from 0 to 16 pixels; both over the color view in dim grey.
  Image errorImage(FrameDrawing& drawing, View view, const MeasuredShadow& measured) const;

  const FrameSpec& spec_;
  bool castersByRays_;
  std::vector<ViewRequest> requests_;
  std::vector<std::size_t>
      requestOf_; ///< one a view of the spec; of no meaning for those that the device does not draw
  std::optional<std::size_t> fullShadow_; ///< index of its request
  std::optional<std::size_t> backdrop_;
};

} // namespace gnomon
