#include "renderer/frame/read_views.h"

#include <algorithm>

#include "renderer/frame/error_views.h"
#include "renderer/passes/views/read_back.h"

namespace gnomon {
namespace {

/// The color view as a picture, for what is drawn over it.
Image readBackdrop(const PictureSources& sources) {
  const std::vector<View>& views = sources.spec.views;
  const auto shown = std::find(views.begin(), views.end(), View::color);
  const DrawnView& color = shown == views.end() ? sources.drawn.besides.at(View::color)
                                                : sources.drawn.views[static_cast<std::size_t>(shown - views.begin())];
  return readView(color, View::color, true, true);
}

Image readErrorView(const PictureSources& sources, View view) {
  if (sources.spec.output.format == ImageFormat::exr) return errorNumbers(*sources.measured, view);
  return hasBackdrop(view) ? errorPicture(*sources.measured, view, readBackdrop(sources))
                           : referencePicture(*sources.measured);
}

Image readImage(const PictureSources& sources, std::size_t index) {
  const View view = sources.spec.views[index];
  if (isErrorView(view)) return readErrorView(sources, view);
  const bool encoded = sources.spec.output.format == ImageFormat::png;
  const gl::Texture& depths =
      sources.drawn.flatAtlas.id() != 0 ? sources.drawn.flatAtlas : sources.atlas.textures->depth;
  if (view == View::atlas) return readAtlas(depths, sources.plan, encoded);
  if (view == View::tile) return readTile(depths, *sources.tile, encoded);
  return readView(sources.drawn.views[index], view, encoded, sources.spec.background.alpha >= 1);
}

} // namespace

std::vector<ViewImage> readViews(const PictureSources& sources) {
  std::vector<ViewImage> images;
  for (std::size_t i = 0; i < sources.spec.views.size(); ++i) {
    images.push_back({sources.spec.views[i], readImage(sources, i)});
  }
  return images;
}

std::vector<float> readFullShadow(const DrawnViews& drawn) {
  return std::get<std::vector<float>>(readView(drawn.besides.at(View::shadow), View::shadow, false, true).pixels);
}

} // namespace gnomon
