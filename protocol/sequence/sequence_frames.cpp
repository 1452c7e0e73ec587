#include <algorithm>
#include <string>
#include <utility>

#include "protocol/sequence/sequence.h"

namespace gnomon {
namespace {

/// Moved inwards by powers of two to the surfaces of the first frame.
constexpr PreviousRange kWidest{1e-3, 1e6};

bool says(const Json& shadow, const char* field) {
  return shadow.is_object() && shadow.contains(field);
}

void steady(Shadow& shadow, const Json& written, const PreviousRange& range) {
  if (!says(written, "stabilization")) shadow.stabilization = Stabilization::projectionSnapping;
  if (!says(written, "depthRange")) shadow.depthRange.previous = range;
}

Json memberOf(const Json& object, const char* key) {
  return says(object, key) ? object[key] : Json();
}

} // namespace

Carried carriedOf(const FrameReport& report) {
  Carried carried;
  for (const LightReport& light : report.lights) {
    if (light.depthRange) carried.depthRanges.push_back({light.light, light.depthRange->near, light.depthRange->far});
  }
  return carried;
}

Carried carriedAfter(const Carried& before, Carried own) {
  for (const CarriedRange& range : before.depthRanges) {
    const bool isNew = std::none_of(own.depthRanges.begin(), own.depthRanges.end(),
                                    [&](const CarriedRange& known) { return known.light == range.light; });
    if (isNew) own.depthRanges.push_back(range);
  }
  std::sort(own.depthRanges.begin(), own.depthRanges.end(),
            [](const CarriedRange& a, const CarriedRange& b) { return a.light < b.light; });
  return own;
}

void makeStable(FrameSpec& spec, const Json& written, const Carried& before) {
  const auto own = [&](int light) -> Shadow* {
    if (!spec.lights || static_cast<std::size_t>(light) >= spec.lights->size()) return nullptr;
    auto& shadow = (*spec.lights)[static_cast<std::size_t>(light)].shadow;
    return shadow ? &*shadow : nullptr;
  };
  // Lights that share one shadow see the same surfaces, and so have one range.
  PreviousRange shared = kWidest;
  for (auto range = before.depthRanges.rbegin(); range != before.depthRanges.rend(); ++range) {
    if (!own(range->light)) shared = {range->near, range->far};
  }
  steady(spec.shadow, memberOf(written, "shadow"), shared);
  const Json lights = memberOf(written, "lights");
  for (std::size_t i = 0; spec.lights && i < spec.lights->size(); ++i) {
    Shadow* shadow = own(static_cast<int>(i));
    if (shadow == nullptr) continue;
    PreviousRange range = kWidest;
    for (const CarriedRange& each : before.depthRanges) {
      if (static_cast<std::size_t>(each.light) == i) range = {each.near, each.far};
    }
    steady(*shadow, memberOf(lights[i], "shadow"), range);
  }
}

namespace {

std::string sizeText(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

} // namespace

FrameSpec videoFrame(FrameSpec spec) {
  spec.views.resize(1);
  spec.output.format = ImageFormat::png; // whose pixels are those of a picture that is seen
  spec.output.pngBits = 8;
  return spec;
}

void FrameSizes::see(const FrameSpec& spec) {
  if (seen_ == 0) {
    width_ = spec.width;
    height_ = spec.height;
  }
  const bool isOther = spec.width != width_ || spec.height != height_;
  if (isOther && !other_) other_ = {seen_, spec.width, spec.height};
  ++seen_;
}

std::optional<Problem> FrameSizes::problem(const Sequence& sequence) const {
  if (!other_) return std::nullopt;
  return invalidValue(
      framePlace(sequence, sequence.first + other_->number) + (other_->width != width_ ? "/width" : "/height"),
      "All frames of a video have the size of its first.", sizeText(width_, height_),
      sizeText(other_->width, other_->height));
}

} // namespace gnomon
