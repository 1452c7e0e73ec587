#include "renderer/reference/reference.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <new>

#include "protocol/base/elapsed.h"
#include "renderer/rays/trace.h"
#include "renderer/reference/environment_reference.h"

namespace gnomon {
namespace {

/// Progress is reported every this many pixels.
std::size_t pixelsAtOnce(std::size_t lights, int samples) {
  constexpr std::size_t kRays = std::size_t{1} << 20; // some tens of milliseconds
  return std::clamp<std::size_t>(kRays / (1 + lights * static_cast<std::size_t>(std::max(samples, 1))), 2048, 65536);
}

std::vector<glm::vec2> centresOf(int width, std::size_t first, std::size_t last) {
  std::vector<glm::vec2> places;
  places.reserve(last - first);
  const auto columns = static_cast<std::size_t>(width);
  for (std::size_t i = first; i < last; ++i) {
    places.emplace_back(static_cast<float>(i % columns) + 0.5f, static_cast<float>(i / columns) + 0.5f);
  }
  return places;
}

/// Metres from one pixel to the next, up the picture, at the depth of a point.
float pixelWidth(const TraceInput& input, const SurfacePoint& point) {
  if (point.instance == kNoSurface) return 0;
  const double atOneMetre = 2 * input.camera.halfSize.y / input.height;
  if (!input.camera.perspective) return static_cast<float>(atOneMetre);
  const glm::dvec3 eye = input.camera.eye - anchorOf(input.traced.view());
  return static_cast<float>(atOneMetre * glm::dot(point.position - eye, input.camera.forward));
}

/// Adds the next pixels to what is known of a light.
void traceLight(const TraceInput& input, std::span<const SurfacePoint> points, std::span<const float> widths,
                int samples, LightReference& light) {
  const Light& of = input.lights[static_cast<std::size_t>(light.light)];
  const std::vector<float> visibility = lightVisibility(input, light.light, points, samples);
  std::vector<std::uint8_t> receiver = facesLight(input, light.light, points);
  std::vector<SurfacePoint> hidden(points.begin(), points.end());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (receiver[i] != 0 && !receivesFrom(input, of, points[i].instance)) receiver[i] = 0;
    if (visibility[i] >= 0.5f) hidden[i] = {};
  }
  std::vector<float> distance = blockerDistances(input, light.light, hidden);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (widths[i] > 0) distance[i] /= widths[i];
  }
  light.visibility.insert(light.visibility.end(), visibility.begin(), visibility.end());
  light.receiver.insert(light.receiver.end(), receiver.begin(), receiver.end());
  light.blockerDistance.insert(light.blockerDistance.end(), distance.begin(), distance.end());
}

/// `trace(points, widths, light)` adds the next pixels to what is known of a light.
template <class Trace>
Result<Reference> tracedReference(const TraceInput& input, std::span<const int> lights, int samples,
                                  const Progress& progress, const Trace& trace) {
  const auto start = std::chrono::steady_clock::now();
  Reference reference;
  reference.width = input.width;
  reference.height = input.height;
  reference.samples = samples;
  for (const int light : lights) reference.lights.push_back({light, {}, {}, {}});
  const std::size_t count = static_cast<std::size_t>(input.width) * static_cast<std::size_t>(input.height);
  const std::size_t step = pixelsAtOnce(lights.size(), samples);
  reference.surface.reserve(count);
  reference.pixelWidth.reserve(count);
  for (std::size_t first = 0; first < count; first += step) {
    if (progress && !progress(static_cast<double>(first) / static_cast<double>(count))) {
      return Problem{ProblemCode::unavailable, "", "The exact shadows were cancelled before they were traced."};
    }
    const std::vector<SurfacePoint> points =
        firstHits(input, centresOf(input.width, first, std::min(count, first + step)));
    std::vector<float> widths(points.size());
    std::transform(points.begin(), points.end(), widths.begin(),
                   [&](const SurfacePoint& point) { return pixelWidth(input, point); });
    for (LightReference& light : reference.lights) trace(points, widths, light);
    reference.surface.insert(reference.surface.end(), points.begin(), points.end());
    reference.pixelWidth.insert(reference.pixelWidth.end(), widths.begin(), widths.end());
  }
  if (progress) progress(1);
  reference.milliseconds = millisecondsSince(start);
  return reference;
}

} // namespace

Result<Reference> traceReference(const TraceInput& input, std::span<const int> lights, int samples,
                                 const Progress& progress) {
  return tracedReference(input, lights, samples, progress,
                         [&](std::span<const SurfacePoint> points, std::span<const float> widths,
                             LightReference& light) { traceLight(input, points, widths, samples, light); });
}

Result<Reference> traceReference(const TraceInput& input, const SkyLight& environment, int samples,
                                 const Progress& progress) {
  const TracedSky traced(input);
  const int only[] = {kEnvironmentLight};
  return tracedReference(input, only, samples, progress,
                         [&](std::span<const SurfacePoint> points, std::span<const float> /*widths*/,
                             LightReference& light) { traceEnvironment(traced, environment, points, samples, light); });
}

} // namespace gnomon
