#include "renderer/scene/animation/sampler_build.h"

#include <cmath>

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
      findings.invalid(pointer, "A keyframe's time is not a finite number from 0 on.", {},
                       "of keyframe " + std::to_string(i));
      return false;
    }
    if (i > 0 && !(time > sampler.times.back())) {
      findings.invalid(pointer, "The times of the keyframes do not increase.", {}, "at keyframe " + std::to_string(i));
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

} // namespace

Sampler buildSampler(const gltf::AnimationSampler& source, const std::string& pointer,
                     const std::vector<AccessorView>& accessors, const SamplerUse& use, std::size_t mostNumbers,
                     Findings& findings) {
  const AccessorView& input = accessors[source.input];
  const AccessorView& output = accessors[source.output];
  if (input.components != 1 || input.componentType != ComponentType::float32) {
    findings.invalid(pointer + "/input", "The times of keyframes need an accessor of SCALAR and floats.");
    return {};
  }
  if (!isOfType(output, use)) {
    findings.invalid(pointer + "/output", "The accessor is not of a type that what is animated may have.");
    return {};
  }
  Sampler sampler;
  sampler.interpolation = source.interpolation;
  sampler.components = use.components * use.elements;
  sampler.isRotation = use.kind == ValueKind::rotation;
  const bool isSpline = sampler.interpolation == Interpolation::cubicSpline;
  if (use.kind == ValueKind::boolean && sampler.interpolation != Interpolation::step) {
    findings.invalid(pointer + "/interpolation", "What is true or false changes in steps.", "STEP");
    return {};
  }
  if (isSpline && input.count < 2) {
    findings.invalid(pointer + "/input", "A cubic spline needs two keyframes.", ">= 2", std::to_string(input.count));
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
    findings.invalid(pointer + "/output", "The accessor does not have a value for each keyframe.",
                     std::to_string(wanted), std::to_string(output.count));
    return {};
  }
  if (!readTimes(input, pointer + "/input", sampler, findings)) return {};
  if (!readValues(output, pointer + "/output", sampler, findings)) return {};
  if (sampler.isRotation && !makeRotationsUnit(pointer + "/output", sampler, findings)) return {};
  return sampler;
}

} // namespace gnomon
