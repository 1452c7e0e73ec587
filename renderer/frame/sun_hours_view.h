#pragma once

#include <vector>

#include "protocol/report/frame_report.h"
#include "renderer/frame/geometry_views.h"
#include "renderer/image/image.h"
#include "renderer/resolve/resolve_frame.h"

/// View sunHours: for how long the sun shines on what each pixel's centre shows. Rays decide, whatever draws the frame
/// and whatever its lights are.
namespace gnomon {

struct ShownSunHours {
  std::vector<float> hours{}; ///< one a pixel, first row on top; -1 = no surface
  SunHoursReport report{};
};

/// A step counts where the surface faces the sun's centre and no caster stands before it; a blended caster lets through
/// 1 - alpha of it. Nodes that receive no shadow count all steps in which they face the sun. Surfaces are the
/// triangles themselves, whatever their normals say. `rays`: of the frame that `shown` is of.
ShownSunHours sunHoursOf(const ShownGeometry& shown, const TraceInput& rays, const SunHours& asked);

/// The hours as numbers; or as a heat map from 0 to all hours of daylight, black where no surface is, with a scale in
/// the lower left corner of pictures that have room for it.
Image sunHoursView(const ShownGeometry& shown, const ShownSunHours& found, PixelType pixels);

} // namespace gnomon
