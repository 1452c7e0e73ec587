#include "server/handlers/drake_form.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <string>

#include "protocol/base/bytes.h"
#include "protocol/base/text.h"
#include "protocol/json/json_codec.h"
#include "protocol/spec/limits.h"
#include "server/system/numbers.h"

namespace gnomon {
namespace {

/// The numbers of a form as they are sent.
struct Numbers {
  double width = 0, height = 0, near = 0, far = 0, focalX = 0, focalY = 0, fovX = 0, fovY = 0, centerX = 0, centerY = 0;
  double minDepth = 0, maxDepth = 0;
};

struct NumberRow {
  std::string_view name;
  double Numbers::*value;
  double min; ///< excluded unless `mayBeMin`
  double max;
  bool mayBeMin = false;
  bool whole = false;
  bool ofDepth = false; ///< sent with depth alone
};

constexpr double kGreatest = 1e9; ///< of lengths in metres and in pixels
constexpr double kSide = kLimits.maxFrameSide;
constexpr double kHalfTurn = 3.1415927;

constexpr std::array kNumbers{
    NumberRow{"width", &Numbers::width, 1, kSide, true, true},
    NumberRow{"height", &Numbers::height, 1, kSide, true, true},
    NumberRow{"near", &Numbers::near, 0, kGreatest},
    NumberRow{"far", &Numbers::far, 0, kGreatest},
    NumberRow{"focal_x", &Numbers::focalX, 0, kGreatest},
    NumberRow{"focal_y", &Numbers::focalY, 0, kGreatest},
    NumberRow{"fov_x", &Numbers::fovX, 0, kHalfTurn},
    NumberRow{"fov_y", &Numbers::fovY, 0, kHalfTurn},
    NumberRow{"center_x", &Numbers::centerX, -0.5, kSide},
    NumberRow{"center_y", &Numbers::centerY, -0.5, kSide},
    NumberRow{"min_depth", &Numbers::minDepth, 0, kGreatest, true, false, true},
    NumberRow{"max_depth", &Numbers::maxDepth, 0, kGreatest, false, false, true},
};

constexpr std::array<std::string_view, 4> kTexts{"scene", "scene_sha256", "image_type", "submit"};
constexpr std::array<std::string_view, 3> kImages{"color", "depth", "label"}; ///< in the order of DrakeImage

using Fields = std::map<std::string_view, std::string_view>;

Problem wrong(std::string_view field, std::string detail, std::string limit = {}, std::string actual = {}) {
  return {ProblemCode::invalidValue, std::string(field), std::move(detail), std::move(limit), std::move(actual)};
}

bool isKnown(std::string_view name) {
  return std::find(kTexts.begin(), kTexts.end(), name) != kTexts.end() ||
         std::any_of(kNumbers.begin(), kNumbers.end(), [&](const NumberRow& row) { return row.name == name; });
}

Fields fieldsOf(const std::vector<FormPart>& parts, Problems& problems) {
  Fields fields;
  for (const FormPart& part : parts) {
    if (!isKnown(part.name)) {
      problems.push_back(wrong(asciiExcerpt(part.name), "The form has no field of this name."));
    } else if (!fields.emplace(part.name, part.content).second) {
      problems.push_back(wrong(part.name, "The form has two fields of this name."));
    }
  }
  return fields;
}

/// Nothing, and a problem, where the form lacks it.
std::optional<std::string_view> text(const Fields& fields, std::string_view name, Problems& problems) {
  const auto found = fields.find(name);
  if (found != fields.end()) return found->second;
  problems.push_back(wrong(name, "The form lacks this field."));
  return std::nullopt;
}

std::string shortest(double number) {
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  return {digits.data(), end};
}

std::string boundsOf(const NumberRow& row) {
  return std::string(row.whole ? "a whole number " : "") + (row.mayBeMin ? ">= " : "> ") + shortest(row.min) +
         " and <= " + shortest(row.max);
}

void readNumber(const Fields& fields, const NumberRow& row, Numbers& numbers, Problems& problems) {
  const auto sent = text(fields, row.name, problems);
  if (!sent) return;
  const auto number = numberIn<double>(*sent);
  const bool isGood = number && *number <= row.max && (row.mayBeMin ? *number >= row.min : *number > row.min) &&
                      (!row.whole || *number == std::floor(*number));
  if (isGood) {
    numbers.*row.value = *number;
  } else {
    problems.push_back(wrong(row.name, "The field is no such number.", boundsOf(row), asciiExcerpt(*sent)));
  }
}

/// Drake sends six digits after the point.
constexpr double kAgreement = 1e-4; // radians

void checkAngle(std::string_view name, double angle, double focal, double side, Problems& problems) {
  const double expected = 2 * std::atan(side / (2 * focal));
  if (std::abs(angle - expected) <= kAgreement) return;
  problems.push_back(wrong(name, "The angle is not the one of this size and focal length.",
                           shortest(expected) + " +- " + shortest(kAgreement), shortest(angle)));
}

/// What fields say of each other. REQUIRES: each is good by itself.
void checkTogether(const Numbers& n, bool isDepth, Problems& problems) {
  const auto mustBeBelow = [&](std::string_view name, double value, std::string_view other, double limit) {
    if (value < limit) return;
    problems.push_back(wrong(name, "The field must be less than " + std::string(other) + ".", "< " + shortest(limit),
                             shortest(value)));
  };
  mustBeBelow("near", n.near, "far", n.far);
  mustBeBelow("center_x", n.centerX, "width - 0.5", n.width - 0.5);
  mustBeBelow("center_y", n.centerY, "height - 0.5", n.height - 0.5);
  checkAngle("fov_x", n.fovX, n.focalX, n.width, problems);
  checkAngle("fov_y", n.fovY, n.focalY, n.height, problems);
  if (isDepth) mustBeBelow("min_depth", n.minDepth, "max_depth", n.maxDepth);
  if (n.width * n.height > static_cast<double>(kLimits.maxFramePixels)) {
    problems.push_back({ProblemCode::tooLarge, "width", "The picture has too many pixels.",
                        std::to_string(kLimits.maxFramePixels), shortest(n.width * n.height)});
  }
}

void checkHash(std::string_view scene, std::string_view claimed, Problems& problems) {
  Sha256 hash;
  hash.add(scene);
  if (const std::string actual = hash.hex(); lowerCase(claimed) != actual) {
    problems.push_back({ProblemCode::hashMismatch, "scene_sha256", "This is not the SHA-256 of the scene that came.",
                        actual, asciiExcerpt(claimed)});
  }
}

} // namespace

Result<DrakeForm> readDrakeForm(const std::vector<FormPart>& parts) {
  Problems problems;
  const Fields fields = fieldsOf(parts, problems);
  DrakeForm form;
  const auto kind = text(fields, "image_type", problems);
  const auto image = std::find(kImages.begin(), kImages.end(), kind.value_or("color"));
  if (image == kImages.end()) {
    problems.push_back(
        wrong("image_type", "There are no images of this type.", "color, depth or label", asciiExcerpt(*kind)));
  }
  form.image = static_cast<DrakeImage>(image - kImages.begin());
  const bool isDepth = form.image == DrakeImage::depth;
  Numbers numbers;
  for (const NumberRow& row : kNumbers) {
    if (!row.ofDepth || isDepth) {
      readNumber(fields, row, numbers, problems);
    } else if (kind && image != kImages.end() && fields.contains(row.name)) {
      problems.push_back(wrong(row.name, "The field belongs to images of type depth alone."));
    }
  }
  const auto scene = text(fields, "scene", problems);
  const auto claimed = text(fields, "scene_sha256", problems);
  if (!problems.empty()) return problems;
  checkTogether(numbers, isDepth, problems);
  checkHash(*scene, *claimed, problems);
  if (!problems.empty()) return problems;
  form.scene = *scene;
  form.width = static_cast<int>(numbers.width);
  form.height = static_cast<int>(numbers.height);
  form.lens = {numbers.focalX, numbers.focalY, numbers.centerX, numbers.centerY, numbers.near, numbers.far};
  if (isDepth) form.range = SensorRange{numbers.minDepth, numbers.maxDepth};
  return form;
}

FrameSpec drakeDefaults() {
  FrameSpec spec;
  Light sun;
  sun.direction = Vec3{-0.4, 0.3, -1};
  spec.lights = std::vector<Light>{sun};
  spec.background.color = {0.604, 0.783, 1}; // that of Drake's own pictures: 204 229 255
  spec.toneMapping = ToneMapping::none;
  spec.ambient.intensity = 0.3;
  spec.environment.studio = Studio::even;
  return spec;
}

FrameSpec drakeFrame(const DrakeForm& form, const FrameSpec& colors) {
  FrameSpec spec;
  if (form.image == DrakeImage::color) {
    spec = colors;
  } else {
    spec.lights = std::vector<Light>{};
    spec.antialiasing = Antialiasing::none;
    spec.output.format = ImageFormat::exr; // numbers
    spec.views = {form.image == DrakeImage::depth ? View::depth : View::materials};
  }
  spec.width = form.width;
  spec.height = form.height;
  spec.camera.node = "Camera Node";
  spec.camera.intrinsics = form.lens;
  return spec;
}

SceneCounts likelyCounts(std::size_t sceneBytes) {
  // Of a closed mesh: three indices, and half a vertex of position and normal, 24 bytes, in base64.
  constexpr std::size_t kTriangleBytes = 32;
  return {.triangles = std::min(sceneBytes / kTriangleBytes, kLimits.maxTriangles)};
}

Result<FrameSpec> readDrakeSpec(std::string_view json) {
  auto spec = decodeFrameSpec(json);
  if (!spec) return spec;
  const FrameSpec plain;
  Problems problems;
  const auto mustBePlain = [&](bool isPlain, const char* pointer) {
    if (!isPlain) problems.push_back(wrong(pointer, "Each form of Drake's brings its own; leave it out."));
  };
  mustBePlain(spec->width == plain.width && spec->height == plain.height, "/width");
  mustBePlain(spec->camera == plain.camera, "/camera");
  mustBePlain(spec->views == plain.views, "/views");
  mustBePlain(spec->output == plain.output, "/output");
  if (spec->background.alpha != 1) {
    problems.push_back(
        wrong("/background/alpha", "Drake's pictures are opaque.", "1", shortest(spec->background.alpha)));
  }
  if (!problems.empty()) return problems;
  return spec;
}

} // namespace gnomon
