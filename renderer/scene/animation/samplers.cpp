#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "renderer/scene/animation/motion.h"

namespace gnomon {

namespace {

bool isOfType(const AccessorView& view, const SamplerUse& use) {
  if (static_cast<std::size_t>(view.components) != use.components) return false;
  if (use.kind == ValueKind::boolean) return view.componentType == ComponentType::uint8 && !view.normalized;
  if (view.componentType == ComponentType::float32) return true;
  return use.kind != ValueKind::vector && view.normalized && view.componentType != ComponentType::uint32;
}

bool readTimes(const AccessorView& view, const std::string& pointer, Sampler& sampler, Findings& findings) {
  sampler.times.reserve(view.count);
  for (std::size_t i = 0; i < view.count; ++i) {
    const auto time = static_cast<float>(view.read(i).x);
    if (!std::isfinite(time) || time < 0) {
      findings.invalid(pointer, "A keyframe's time is negative or not finite.", {}, "of keyframe " + std::to_string(i));
      return false;
    }
    if (i > 0 && !(time > sampler.times.back())) {
      findings.invalid(pointer, "The keyframe times are not strictly increasing.", {},
                       "at keyframe " + std::to_string(i));
      return false;
    }
    sampler.times.push_back(time);
  }
  return true;
}

bool readValues(const AccessorView& view, const std::string& pointer, Sampler& sampler, Findings& findings) {
  sampler.values.reserve(view.count * static_cast<std::size_t>(view.components));
  for (std::size_t i = 0; i < view.count; ++i) {
    const glm::dvec4 element = view.read(i);
    for (int component = 0; component < view.components; ++component) {
      const auto value = static_cast<float>(element[component]);
      if (!std::isfinite(value)) {
        findings.invalid(pointer, "A keyframe's value is not finite.", {}, "of element " + std::to_string(i));
        return false;
      }
      sampler.values.push_back(value);
    }
  }
  return true;
}

/// Brings rotations to length 1; tangents stay as they are.
bool makeRotationsUnit(const std::string& pointer, Sampler& sampler, Findings& findings) {
  const std::size_t rows = sampler.interpolation == Interpolation::cubicSpline ? 3 : 1;
  for (std::size_t keyframe = 0; keyframe < sampler.times.size(); ++keyframe) {
    float* q = sampler.values.data() + (keyframe * rows + rows / 2) * 4;
    const double length = std::hypot(std::hypot(double{q[0]}, double{q[1]}), std::hypot(double{q[2]}, double{q[3]}));
    if (!(length > 0) || !std::isfinite(length)) {
      findings.invalid(pointer, "A rotation is not a quaternion of length 1.", {},
                       "of keyframe " + std::to_string(keyframe));
      return false;
    }
    for (int i = 0; i < 4; ++i) q[i] = static_cast<float>(double{q[i]} / length);
  }
  return true;
}

void copyKeyframe(const Sampler& sampler, std::size_t keyframe, std::span<double> value) {
  std::copy_n(valueOf(sampler, keyframe), sampler.components, value.begin());
}

/// The shorter way around (glTF 2.0, C.4).
void slerp(const float* from, const float* to, double share, std::span<double> value) {
  const auto rotation = [](const float* q) { return glm::dquat(q[3], q[0], q[1], q[2]); };
  const glm::dquat between = glm::slerp(rotation(from), rotation(to), share);
  for (int i = 0; i < 4; ++i) value[static_cast<std::size_t>(i)] = between[i];
}

/// Hermite's spline, tangents per second (glTF 2.0, C.5).
void spline(const Sampler& sampler, std::size_t keyframe, double share, double seconds, std::span<double> value) {
  const double t = share;
  const double t2 = t * t;
  const double t3 = t2 * t;
  const std::size_t count = sampler.components;
  const float* from = valueOf(sampler, keyframe);
  const float* to = valueOf(sampler, keyframe + 1);
  const float* outTangent = from + count;
  const float* inTangent = to - count;
  for (std::size_t i = 0; i < count; ++i) {
    value[i] = (2 * t3 - 3 * t2 + 1) * double{from[i]} + seconds * (t3 - 2 * t2 + t) * double{outTangent[i]} +
               (3 * t2 - 2 * t3) * double{to[i]} + seconds * (t3 - t2) * double{inTangent[i]};
  }
}

/// A spline may cross zero between two rotations: then there is no direction to keep, and the nearer keyframe counts.
void makeUnit(const float* nearest, std::span<double> value) {
  const double length = std::hypot(std::hypot(value[0], value[1]), std::hypot(value[2], value[3]));
  const bool usable = length > 1e-12 && std::isfinite(length);
  for (std::size_t i = 0; i < 4; ++i) value[i] = usable ? value[i] / length : double{nearest[i]};
}

} // namespace

Sampler buildSampler(const gltf::AnimationSampler& source, const std::string& pointer,
                     const std::vector<AccessorView>& accessors, const SamplerUse& use, std::size_t mostNumbers,
                     Findings& findings) {
  const AccessorView& input = accessors[source.input];
  const AccessorView& output = accessors[source.output];
  if (input.components != 1 || input.componentType != ComponentType::float32) {
    findings.invalid(pointer + "/input", "Keyframe times need a SCALAR accessor of floats.");
    return {};
  }
  if (!isOfType(output, use)) {
    findings.invalid(pointer + "/output", "The accessor's type does not fit the animated property.");
    return {};
  }
  Sampler sampler;
  sampler.interpolation = source.interpolation;
  sampler.components = use.components * use.elements;
  sampler.isRotation = use.kind == ValueKind::rotation;
  const bool isSpline = sampler.interpolation == Interpolation::cubicSpline;
  if (use.kind == ValueKind::boolean && sampler.interpolation != Interpolation::step) {
    findings.invalid(pointer + "/interpolation", "Boolean values need STEP interpolation.", "STEP");
    return {};
  }
  if (isSpline && input.count < 2) {
    findings.invalid(pointer + "/input", "A cubic spline needs at least two keyframes.", ">= 2",
                     std::to_string(input.count));
    return {};
  }
  const std::size_t numbers = input.count + output.count * static_cast<std::size_t>(output.components);
  if (input.count > mostNumbers || numbers > mostNumbers) {
    findings.tooLarge(pointer, "The animations have too many keyframes.", std::to_string(mostNumbers) + " more numbers",
                      std::to_string(numbers));
    return {};
  }
  const std::size_t wanted = input.count * (isSpline ? 3 : 1) * use.elements;
  if (output.count != wanted) {
    findings.invalid(pointer + "/output", "The accessor's count does not match the number of keyframes.",
                     std::to_string(wanted), std::to_string(output.count));
    return {};
  }
  if (!readTimes(input, pointer + "/input", sampler, findings)) return {};
  if (!readValues(output, pointer + "/output", sampler, findings)) return {};
  if (sampler.isRotation && !makeRotationsUnit(pointer + "/output", sampler, findings)) return {};
  return sampler;
}

const float* valueOf(const Sampler& sampler, std::size_t keyframe) {
  const std::size_t rows = sampler.interpolation == Interpolation::cubicSpline ? 3 : 1;
  return sampler.values.data() + (keyframe * rows + rows / 2) * sampler.components;
}

void sample(const Sampler& sampler, double timeSeconds, std::span<double> value) {
  const std::vector<float>& times = sampler.times;
  const auto after = std::upper_bound(times.begin(), times.end(), timeSeconds,
                                      [](double time, float keyframe) { return time < double{keyframe}; });
  if (after == times.begin()) return copyKeyframe(sampler, 0, value);
  const auto keyframe = static_cast<std::size_t>(after - times.begin()) - 1;
  if (after == times.end() || sampler.interpolation == Interpolation::step) {
    return copyKeyframe(sampler, keyframe, value);
  }
  const double seconds = double{*after} - double{times[keyframe]};
  const double share = (timeSeconds - double{times[keyframe]}) / seconds;
  const float* from = valueOf(sampler, keyframe);
  const float* to = valueOf(sampler, keyframe + 1);
  if (sampler.interpolation == Interpolation::cubicSpline) {
    spline(sampler, keyframe, share, seconds, value);
    if (sampler.isRotation) makeUnit(share < 0.5 ? from : to, value);
  } else if (sampler.isRotation) {
    slerp(from, to, share, value);
  } else {
    for (std::size_t i = 0; i < sampler.components; ++i) value[i] = std::lerp(double{from[i]}, double{to[i]}, share);
  }
}

} // namespace gnomon
