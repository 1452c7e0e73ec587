#include "tests/support/same_frames.h"

#include <algorithm>
#include <cmath>

#include "protocol/spec/enum_rows.h"
#include "protocol/spec/traits.h"

namespace gnomon::testing {
namespace {

bool near(double a, double b, double allowed) {
  return a == b || std::abs(a - b) <= allowed * std::max(std::abs(a), std::abs(b));
}

/// Eight-bit values as they are; of numbers each in levels of 255 of what is usual in this view.
std::vector<float> levelsOf(const Image& image, double usual) {
  if (const auto* bytes = std::get_if<std::vector<std::uint8_t>>(&image.pixels)) return {bytes->begin(), bytes->end()};
  std::vector<float> levels;
  for (const float value : std::get<std::vector<float>>(image.pixels)) {
    const double size = std::abs(static_cast<double>(value));
    const double share = std::isinf(size) ? 1 : size / (size + usual);
    levels.push_back(static_cast<float>(std::copysign(255 * share, static_cast<double>(value))));
  }
  return levels;
}

/// Of a view whose numbers depend on the scene's size or light the median of what is neither 0 nor infinite, without
/// its sign; of others, shares and directions, 1.
double usualOf(View view, const Image& image) {
  const bool scaled = traitsOf(view).source == ViewSource::picture || view == View::depth || view == View::bias ||
                      view == View::texelDensity;
  if (!scaled) return 1;
  const auto* numbers = std::get_if<std::vector<float>>(&image.pixels);
  std::vector<float> sizes;
  for (const float value : numbers ? *numbers : std::vector<float>{}) {
    if (value != 0 && std::isfinite(value)) sizes.push_back(std::abs(value));
  }
  if (sizes.empty()) return 1;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return static_cast<double>(*middle);
}

struct Levels {
  int width = 0, height = 0, channels = 0;
  std::vector<float> values;

  float at(int x, int y, int channel) const {
    return values[static_cast<std::size_t>((y * width + x) * channels + channel)];
  }
};

/// Pixels of `a` whose value lies outside what the 3 x 3 pixels of `b` around it span, by more than `allowed`.
int strangers(const Levels& a, const Levels& b, double allowed) {
  int found = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      bool strange = false;
      for (int channel = 0; channel < a.channels; ++channel) {
        float least = b.at(x, y, channel);
        float most = least;
        for (int dy = std::max(0, y - 1); dy <= std::min(a.height - 1, y + 1); ++dy) {
          for (int dx = std::max(0, x - 1); dx <= std::min(a.width - 1, x + 1); ++dx) {
            least = std::min(least, b.at(dx, dy, channel));
            most = std::max(most, b.at(dx, dy, channel));
          }
        }
        const double value = static_cast<double>(a.at(x, y, channel));
        strange =
            strange || !(value >= static_cast<double>(least) - allowed && value <= static_cast<double>(most) + allowed);
      }
      found += strange ? 1 : 0;
    }
  }
  return found;
}

std::string pictureDifference(const ViewImage& cpu, const ViewImage& gl, bool antialiased) {
  const std::string name(spell(gl.view));
  if (cpu.image.width != gl.image.width || cpu.image.height != gl.image.height) return "the size of view " + name;
  if (cpu.image.channels != gl.image.channels) return "the channels of view " + name;
  const auto levels = [&, usual = usualOf(gl.view, gl.image)](const Image& image) {
    return Levels{image.width, image.height, static_cast<int>(image.channels.size()), levelsOf(image, usual)};
  };
  const Levels left = levels(cpu.image);
  const Levels right = levels(gl.image);
  const double allowed = antialiased && traitsOf(gl.view).source == ViewSource::picture ? 32 : 16;
  const int different = std::max(strangers(left, right, allowed), strangers(right, left, allowed));
  const int pixels = left.width * left.height;
  const int atSplit = traitsOf(gl.view).tiles ? left.width : 0;
  if (different <= 4 + pixels / 100 + atSplit) return "";
  return std::to_string(different) + " of " + std::to_string(pixels) + " pixels of view " + name;
}

bool sameMatrices(const LightReport& cpu, const LightReport& gl) {
  for (std::size_t i = 0; i < cpu.tiles.size(); ++i) {
    const auto& a = cpu.tiles[i].matrix;
    const auto& b = gl.tiles[i].matrix;
    if (a.has_value() != b.has_value()) return false;
    if (!a) continue;
    double most = 0;
    double apart = 0;
    for (std::size_t k = 0; k < a->size(); ++k) {
      if (k >= 12) continue; // where the origin of the world falls is the rest's rounding
      most = std::max(most, std::abs((*b)[k]));
      apart = std::max(apart, std::abs((*a)[k] - (*b)[k]));
    }
    if (apart > 1e-3 * most) return false;
  }
  return true;
}

/// True where the shadow of a light is what its map says, so that every device plans the same tiles.
bool onlyMapped(const FrameSpec& effective, std::size_t light) {
  const TechniqueTraits& traits = traitsOf((*effective.lights)[light].shadow->technique);
  return !traits.layered;
}

bool sameDepthRange(const FrameReport& cpu, const FrameReport& gl) {
  return near(cpu.depthRange[0], gl.depthRange[0], 1e-3) && near(cpu.depthRange[1], gl.depthRange[1], 1e-3);
}

/// What is planned from the spec and the scene alone.
std::string planDifference(const FrameReport& cpu, const FrameReport& gl) {
  if (cpu.warnings != gl.warnings) return "warnings";
  if (cpu.counts.sceneTriangles != gl.counts.sceneTriangles) return "sceneTriangles";
  if (cpu.lights.size() != gl.lights.size()) return "the number of lights";
  const bool sameRange = sameDepthRange(cpu, gl);
  for (std::size_t i = 0; i < cpu.lights.size(); ++i) {
    const LightReport& a = cpu.lights[i];
    const LightReport& b = gl.lights[i];
    const std::string light = "light " + std::to_string(i);
    const bool map = sameRange && onlyMapped(cpu.spec, i);
    if (map && a.tiles.size() != b.tiles.size()) return "the number of tiles of " + light;
    if (sameRange && a.shadowed != b.shadowed) return "whether " + light + " is shadowed";
    if (a.tracedPixels.has_value() != b.tracedPixels.has_value()) return "whether rays decided " + light;
  }
  return "";
}

/// True where both surveys gave what makes the same plan.
bool samePlan(const FrameReport& cpu, const FrameReport& gl) {
  if (cpu.atlasSize != gl.atlasSize || !sameDepthRange(cpu, gl)) return false;
  for (std::size_t i = 0; i < cpu.lights.size(); ++i) {
    const bool same = cpu.lights[i].tiles.size() == gl.lights[i].tiles.size() &&
                      cpu.lights[i].grantedTileSize == gl.lights[i].grantedTileSize &&
                      cpu.lights[i].note == gl.lights[i].note && sameMatrices(cpu.lights[i], gl.lights[i]);
    if (!same) return false;
  }
  return true;
}

/// What every tile is filled from.
std::string tileDifference(const FrameReport& cpu, const FrameReport& gl) {
  for (std::size_t i = 0; i < cpu.lights.size(); ++i) {
    for (std::size_t t = 0; t < cpu.lights[i].tiles.size(); ++t) {
      const TileReport& a = cpu.lights[i].tiles[t];
      const TileReport& b = gl.lights[i].tiles[t];
      const std::string tile = " of tile " + std::to_string(t) + " of light " + std::to_string(i);
      if (a.tile != b.tile) return "the place" + tile;
      if (a.border != b.border) return "the border" + tile;
      if (!near(a.normalOffset, b.normalOffset, 1e-2)) return "the normalOffset" + tile;
    }
  }
  return "";
}

} // namespace

FrameDifference differenceOf(const Frame& cpu, const Frame& gl) {
  if (cpu.images.size() != gl.images.size()) return {"the number of pictures"};
  if (std::string plan = planDifference(cpu.report, gl.report); !plan.empty()) return {plan};
  const bool otherPlans = !samePlan(cpu.report, gl.report);
  if (!otherPlans) {
    if (std::string tiles = tileDifference(cpu.report, gl.report); !tiles.empty()) return {tiles};
  }
  bool mapped = false;
  for (std::size_t i = 0; i < gl.report.lights.size(); ++i) mapped = mapped || onlyMapped(gl.report.spec, i);
  const bool antialiased = gl.report.spec.antialiasing != Antialiasing::none;
  for (std::size_t i = 0; i < gl.images.size(); ++i) {
    const ViewTraits& traits = traitsOf(gl.images[i].view);
    const bool showsMaps = traits.tiles || traits.source == ViewSource::atlas || (traits.shadowed && mapped);
    if (otherPlans && showsMaps) continue;
    const std::string difference = pictureDifference(cpu.images[i], gl.images[i], antialiased);
    if (!difference.empty()) return {difference, otherPlans};
  }
  return {{}, otherPlans};
}

} // namespace gnomon::testing
