#include "renderer/frame/frame_views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "protocol/spec/traits.h"
#include "renderer/core/light.h"
#include "renderer/device/view_image.h"
#include "renderer/frame/geometry_views.h"
#include "renderer/reference/error_measures.h"
#include "renderer/reference/shadow_edges.h"
#include "renderer/shaders/shared/functions.h"

namespace gnomon {

namespace {

using Rgb = std::array<std::uint8_t, 3>;

constexpr int kReferenceSamples = 256; ///< rays a pixel towards a light that has a size, at least
constexpr Rgb kFalseShadow{255, 30, 30};
constexpr Rgb kFalseLight{40, 110, 255};
constexpr float kFarthest = 16; ///< pixels at the end of the heat map

std::vector<float> visibilityOf(const MeasuredShadow& measured) {
  return measured.truth.lights.empty() ? std::vector<float>(measured.shown.size(), 1.0f)
                                       : measured.truth.lights[0].visibility;
}

std::vector<float> differenceOf(const MeasuredShadow& measured) {
  std::vector<float> difference(measured.shown.size(), 0.0f);
  if (measured.truth.lights.empty()) return difference;
  const LightReference& light = measured.truth.lights[0];
  for (std::size_t i = 0; i < difference.size(); ++i) {
    if (light.receiver[i] != 0) difference[i] = measured.shown[i] - light.visibility[i];
  }
  return difference;
}

std::vector<float> distancesOf(const MeasuredShadow& measured) {
  return measured.truth.lights.empty() ? std::vector<float>(measured.shown.size(), -1.0f)
                                       : edgeDistances(measured.truth, 0, measured.shown);
}

/// What is seen in the picture, as grey from `darkest` to `lightest`, so that no color is lost on it.
template <class Number>
std::vector<Number> dimmed(const std::vector<Number>& color, std::size_t step, float darkest, float lightest) {
  constexpr float kHighest = std::numeric_limits<Number>::max();
  std::vector<Number> grey;
  grey.reserve(color.size() / step * 3);
  for (std::size_t i = 0; i < color.size(); i += step) {
    const float luma = (0.2126f * color[i] + 0.7152f * color[i + 1] + 0.0722f * color[i + 2]) / kHighest;
    grey.insert(grey.end(), 3, unorm<Number>(darkest + (lightest - darkest) * luma));
  }
  return grey;
}

/// `color`: of 8 bits.
template <class Number>
void paint(std::vector<Number>& pixels, std::size_t at, const Rgb& color) {
  constexpr int kScale = std::numeric_limits<Number>::max() / 255;
  for (std::size_t c = 0; c < 3; ++c) pixels[at * 3 + c] = static_cast<Number>(color[c] * kScale);
}

template <class Number>
void paintErrors(const MeasuredShadow& measured, std::vector<Number>& pixels) {
  if (measured.truth.lights.empty()) return;
  const LightReference& light = measured.truth.lights[0];
  for (std::size_t i = 0; i < measured.shown.size(); ++i) {
    const bool lit = isLit(measured.shown[i]);
    if (light.receiver[i] == 0 || lit == isLit(light.visibility[i])) continue;
    paint(pixels, i, lit ? kFalseLight : kFalseShadow);
  }
}

template <class Number>
void paintDistances(const MeasuredShadow& measured, std::vector<Number>& pixels) {
  const std::vector<float> distances = distancesOf(measured);
  for (std::size_t i = 0; i < distances.size(); ++i) {
    if (distances[i] < 0) continue;
    const glm::vec3 color = shared::heat(distances[i] / kFarthest);
    for (int c = 0; c < 3; ++c) pixels[i * 3 + static_cast<std::size_t>(c)] = unorm<Number>(color[c]);
  }
}

/// Edges in the right place are black, and have to be visible.
template <class Number>
std::vector<Number> paintedOver(const std::vector<Number>& color, std::size_t step, const MeasuredShadow& measured,
                                View view) {
  const bool errors = view == View::error;
  auto pixels = errors ? dimmed(color, step, 0.1f, 0.55f) : dimmed(color, step, 0.25f, 0.7f);
  errors ? paintErrors(measured, pixels) : paintDistances(measured, pixels);
  return pixels;
}

template <class Number>
std::vector<Number> greyOf(const std::vector<float>& shares) {
  std::vector<Number> grey(shares.size());
  std::transform(shares.begin(), shares.end(), grey.begin(), unorm<Number>);
  return grey;
}

bool comparesWithRays(View view) {
  return traitsOf(view).source == ViewSource::rays;
}

bool showsTriangles(View view) {
  return traitsOf(view).source == ViewSource::geometry;
}

} // namespace

Result<MeasuredShadow> measureShadow(const ResolvedFrame& frame, const TracedScene& traced, int light,
                                     const FrameSurroundings& around, std::vector<float> shown) {
  const FrameSpec& spec = frame.spec;
  std::vector<int> lights;
  int samples = kReferenceSamples;
  if (light >= 0 && shines((*spec.lights)[static_cast<std::size_t>(light)])) {
    lights.push_back(light);
    samples = std::max(samples, (*spec.lights)[static_cast<std::size_t>(light)].shadow->raySamples);
  }
  const TraceInput input{traced, frame.view, spec.width, spec.height, *spec.lights, frame.nodes, around.media};
  auto truth = light == kEnvironmentLight
                   ? traceReference(input, skyLightOf(&around.environment),
                                    std::max(kEnvironmentReferenceSamples, spec.environment.samples))
                   : traceReference(input, lights, samples);
  if (!truth) return truth.problems();
  const auto errors = measureErrors(*truth, std::span(&shown, truth->lights.size()));
  return MeasuredShadow{std::move(*truth), std::move(shown), errors};
}

bool FrameViews::isTraced(View view) const {
  return view == View::casterIds && castersByRays_;
}

bool FrameViews::isDrawn(View view) const {
  return !comparesWithRays(view) && !showsTriangles(view) && !isTraced(view);
}

FrameViews::FrameViews(const FrameSpec& spec, bool castersByRays) : spec_(spec), castersByRays_(castersByRays) {
  for (const View view : spec.views) {
    requestOf_.push_back(requests_.size());
    if (!isDrawn(view)) continue;
    if (view == View::color) backdrop_ = requests_.size();
    const PixelType pixels = madePixels(view);
    requests_.push_back({.view = view,
                         .encoded = pixels != PixelType::numbers,
                         .opaque = spec.background.alpha >= 1,
                         .fine = pixels == PixelType::words});
  }
  if (!needReference() && !spec.debug.predictEdges) return;
  fullShadow_ = requests_.size();
  requests_.push_back({.view = View::shadow, .encoded = false, .fullStrength = true});
  const auto isPainted = [this](View view) {
    return traitsOf(view).backdrop && madePixels(view) != PixelType::numbers;
  };
  if (backdrop_ || std::none_of(spec.views.begin(), spec.views.end(), isPainted)) return;
  backdrop_ = requests_.size();
  requests_.push_back({.view = View::color, .antialiased = false, .fine = madePixels(View::color) == PixelType::words});
}

PixelType FrameViews::madePixels(View view) const {
  const PixelType pixels = pixelTypeOf(view, spec_.output);
  return pixels == PixelType::words && wordsAreNumbers(view) ? PixelType::numbers : pixels;
}

bool FrameViews::needReference() const {
  return std::any_of(spec_.views.begin(), spec_.views.end(), comparesWithRays);
}

bool FrameViews::needSunHours() const {
  return std::find(spec_.views.begin(), spec_.views.end(), View::sunHours) != spec_.views.end();
}

bool FrameViews::needGeometry() const {
  return needCasters() || std::any_of(spec_.views.begin(), spec_.views.end(), showsTriangles);
}

bool FrameViews::needCasters() const {
  return std::any_of(spec_.views.begin(), spec_.views.end(), [this](View view) { return isTraced(view); });
}

std::vector<float> FrameViews::fullShadow(FrameDrawing& drawing) const {
  return std::get<std::vector<float>>(drawing.picture(*fullShadow_).pixels);
}

Image FrameViews::errorImage(FrameDrawing& drawing, View view, const MeasuredShadow& measured) const {
  const PixelType type = madePixels(view);
  const bool isPainted = type != PixelType::numbers && traitsOf(view).backdrop;
  Image image{measured.truth.width, measured.truth.height, {"Y"}, {}};
  if (type == PixelType::numbers) {
    image.pixels = view == View::reference ? visibilityOf(measured)
                   : view == View::error   ? differenceOf(measured)
                                           : distancesOf(measured);
    return image;
  }
  if (isPainted) image.channels = {"R", "G", "B"};
  const Image color = isPainted ? drawing.picture(*backdrop_) : Image{};
  const auto make = [&]<class Number>(Number) {
    image.pixels = isPainted
                       ? paintedOver(std::get<std::vector<Number>>(color.pixels), color.channels.size(), measured, view)
                       : greyOf<Number>(visibilityOf(measured));
  };
  const bool ofWords =
      isPainted ? std::holds_alternative<std::vector<std::uint16_t>>(color.pixels) : type == PixelType::words;
  ofWords ? make(std::uint16_t()) : make(std::uint8_t());
  return image;
}

std::vector<ViewImage> FrameViews::images(FrameDrawing& drawing, const MeasuredShadow* measured,
                                          const ShownGeometry* geometry, const std::vector<int>& casters,
                                          const ShownSunHours* sunHours) const {
  std::vector<ViewImage> images;
  for (const View view : spec_.views) {
    images.push_back({view, comparesWithRays(view)   ? errorImage(drawing, view, *measured)
                            : view == View::sunHours ? sunHoursView(*geometry, *sunHours, madePixels(view))
                            : showsTriangles(view)   ? geometryView(*geometry, view, madePixels(view))
                            : isTraced(view)         ? casterView(*geometry, casters, madePixels(view))
                                                     : Image{}});
  }
  // After the errors, which are painted over one of them.
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (isDrawn(images[i].view)) images[i].image = drawing.takePicture(requestOf_[i]);
    if (pixelTypeOf(images[i].view, spec_.output) != madePixels(images[i].view)) {
      images[i].image = wordsOf(images[i].image, images[i].view);
    }
  }
  return images;
}

} // namespace gnomon
