#include "renderer/frame/sun_hours_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>

#include "protocol/spec/sun_steps.h"
#include "renderer/core/light.h"
#include "renderer/device/view_image.h"
#include "renderer/image/digits.h"
#include "renderer/rays/light_source.h"
#include "renderer/shaders/shared/functions.h"

namespace gnomon {
namespace {

/// The pixels that show a surface, and what they show.
struct ShownPoints {
  std::vector<std::size_t> pixels{};
  std::vector<SurfacePoint> points{};
};

ShownPoints shownSurfaces(const ShownGeometry& shown, const TraceInput& rays) {
  const std::vector<SurfacePoint> all = shownPoints(shown, rays);
  ShownPoints surfaces;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].instance == kNoSurface) continue;
    surfaces.pixels.push_back(i);
    surfaces.points.push_back(all[i]);
  }
  return surfaces;
}

/// The middle of the sun, with shadows that end where triangles do.
Light sunAt(const Sun& sun) {
  Light light{.sun = sun, .angularDiameterDegrees = 0.0};
  light.shadow.emplace();
  light.shadow->terminator = Terminator::flat;
  return light;
}

std::vector<double> hoursOf(const std::vector<SurfacePoint>& points, const TraceInput& rays,
                            const std::vector<SunStep>& steps) {
  std::vector<double> hours(points.size(), 0.0);
  for (const SunStep& step : steps) {
    const std::array<Light, 1> lights{sunAt(step.sun)};
    const TraceInput toSun{rays.traced, rays.camera, rays.width, rays.height, lights, rays.nodes};
    const WayToLight way{towardsSun(step.sun), HUGE_VAL};
    const std::vector<float> shares = lightVisibility(toSun, 0, points, 1);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (faces(points[i].normal, way)) hours[i] += double{shares[i]} * step.hours;
    }
  }
  return hours;
}

SunHoursReport reportOf(const std::vector<SunStep>& steps, const std::vector<double>& hours) {
  SunHoursReport report{.steps = static_cast<int>(steps.size())};
  for (const SunStep& step : steps) report.daylightHours += step.hours;
  if (hours.empty()) return report;
  const auto [least, most] = std::minmax_element(hours.begin(), hours.end());
  report.minHours = *least;
  report.maxHours = *most;
  for (const double each : hours) report.meanHours += each;
  report.meanHours /= static_cast<double>(hours.size());
  return report;
}

/// At most one digit behind the dot.
std::string hoursText(double hours) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", hours);
  const std::string shown(text);
  return shown.ends_with(".0") ? shown.substr(0, shown.size() - 2) : shown;
}

Rgb bytesOf(const glm::vec3& color) {
  Rgb bytes{};
  for (int i = 0; i < 3; ++i) bytes[static_cast<std::size_t>(i)] = unorm<std::uint8_t>(color[i]);
  return bytes;
}

/// A bar of all colors, and below it the hours at its ends and quarters.
void drawScale(Image& picture, double daylightHours) {
  constexpr int kQuarter = 40, kMargin = 6, kBar = 8;
  const int scale = std::max(1, picture.height / 480);
  const int quarter = kQuarter * scale, margin = kMargin * scale, bar = kBar * scale;
  const int width = 4 * quarter + 4 * margin;
  const int height = bar + kDigitHeight * scale + 3 * margin;
  if (width > picture.width || 3 * height > picture.height) return;
  const int top = picture.height - height;
  fillRect(picture, 0, top, width, height, {0, 0, 0});
  const int left = 2 * margin;
  for (int x = 0; x < 4 * quarter; ++x) {
    const float at = (static_cast<float>(x) + 0.5f) / static_cast<float>(4 * quarter);
    fillRect(picture, left + x, top + margin, 1, bar, bytesOf(shared::heat(at)));
  }
  for (int i = 0; i <= 4; ++i) {
    const std::string text = hoursText(daylightHours * i / 4);
    const int x = std::clamp(left + i * quarter - digitsWidth(text, scale) / 2, 0, width - digitsWidth(text, scale));
    drawDigits(picture, text, {x, top + 2 * margin + bar, scale}, {255, 255, 255});
  }
}

template <class Number>
std::vector<Number> heatOf(const ShownSunHours& found) {
  const float most = static_cast<float>(found.report.daylightHours);
  std::vector<Number> pixels(found.hours.size() * 3);
  for (std::size_t i = 0; i < found.hours.size(); ++i) {
    if (found.hours[i] < 0) continue;
    const glm::vec3 color = shared::heat(most > 0 ? found.hours[i] / most : 0.0f);
    for (int c = 0; c < 3; ++c) pixels[i * 3 + static_cast<std::size_t>(c)] = unorm<Number>(color[c]);
  }
  return pixels;
}

} // namespace

ShownSunHours sunHoursOf(const ShownGeometry& shown, const TraceInput& rays, const SunHours& asked) {
  const std::vector<SunStep> steps = sunSteps(asked);
  const ShownPoints surfaces = shownSurfaces(shown, rays);
  const std::vector<double> hours = hoursOf(surfaces.points, rays, steps);
  ShownSunHours found{std::vector<float>(shown.triangles.size(), -1.0f), reportOf(steps, hours)};
  for (std::size_t i = 0; i < hours.size(); ++i) found.hours[surfaces.pixels[i]] = static_cast<float>(hours[i]);
  return found;
}

Image sunHoursView(const ShownGeometry& shown, const ShownSunHours& found, PixelType pixels) {
  Image image{shown.width, shown.height, channelsOf(View::sunHours, pixels != PixelType::numbers, true), {}};
  if (pixels == PixelType::numbers) {
    image.pixels = found.hours;
    return image;
  }
  if (pixels == PixelType::words) {
    image.pixels = heatOf<std::uint16_t>(found);
  } else {
    image.pixels = heatOf<std::uint8_t>(found);
  }
  drawScale(image, found.report.daylightHours);
  return image;
}

} // namespace gnomon
