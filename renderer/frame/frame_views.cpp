#include "renderer/frame/frame_views.h"

#include <algorithm>

#include "protocol/spec/traits.h"
#include "renderer/frame/measured_shadow.h"

namespace gnomon {
namespace {

bool comparesWithRays(View view) {
  return traitsOf(view).source == ViewSource::rays;
}

} // namespace

FrameViews::FrameViews(const FrameSpec& spec) : spec_(spec) {
  const bool encoded = spec.output.format == ImageFormat::png;
  for (const View view : spec.views) {
    requestOf_.push_back(requests_.size());
    if (comparesWithRays(view)) continue;
    if (view == View::color) backdrop_ = requests_.size();
    requests_.push_back({view, encoded, spec.background.alpha >= 1});
  }
  if (!needReference() && !spec.debug.predictEdges) return;
  fullShadow_ = requests_.size();
  requests_.push_back({.view = View::shadow, .encoded = false, .fullStrength = true});
  const auto isPainted = [](View view) { return traitsOf(view).backdrop; };
  if (backdrop_ || !encoded || std::none_of(spec.views.begin(), spec.views.end(), isPainted)) return;
  backdrop_ = requests_.size();
  requests_.push_back({.view = View::color, .antialiased = false});
}

bool FrameViews::needReference() const {
  return std::any_of(spec_.views.begin(), spec_.views.end(), comparesWithRays);
}

std::vector<float> FrameViews::fullShadow(FrameDrawing& drawing) const {
  return std::get<std::vector<float>>(drawing.picture(*fullShadow_).pixels);
}

Image FrameViews::errorImage(FrameDrawing& drawing, View view, const MeasuredShadow& measured) const {
  if (spec_.output.format == ImageFormat::exr) return errorNumbers(measured, view);
  return traitsOf(view).backdrop ? errorPicture(measured, view, drawing.picture(*backdrop_))
                                 : referencePicture(measured);
}

std::vector<ViewImage> FrameViews::images(FrameDrawing& drawing, const MeasuredShadow* measured) const {
  std::vector<ViewImage> images;
  for (std::size_t i = 0; i < spec_.views.size(); ++i) {
    const View view = spec_.views[i];
    images.push_back(
        {view, comparesWithRays(view) ? errorImage(drawing, view, *measured) : drawing.picture(requestOf_[i])});
  }
  return images;
}

} // namespace gnomon
