#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "protocol/fields/field_checks.h"
#include "protocol/spec/enum_rows.h"
#include "protocol/spec/traits.h"
#include "protocol/spec/validate.h"

namespace gnomon {
namespace {

constexpr double kShortest = 1e-9; ///< metres; anything shorter has no direction
constexpr double kParallel = 1e-6; ///< sine of the least angle between two directions

double length(const Vec3& v) {
  return std::hypot(v[0], v[1], v[2]);
}

Vec3 minus(const Vec3& a, const Vec3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vec3 unit(const Vec3& v) {
  const double by = length(v);
  return {v[0] / by, v[1] / by, v[2] / by};
}

std::string vecText(const Vec3& v) {
  return numberText(v[0]) + " " + numberText(v[1]) + " " + numberText(v[2]);
}

/// Of each group of alternatives at most one is given.
template <class T>
void appendAlternatives(const T& value, const std::string& pointer, std::vector<BrokenRule>& broken) {
  const StructType& type = *typeOf<T>().object;
  for (const Alternatives& group : type.alternatives) {
    std::string names;
    std::vector<std::string> given;
    for (const FieldType& field : type.fields) {
      if (std::find(group.begin(), group.end(), field.name) == group.end()) continue;
      const std::string shown = field.inlined ? "eye, target and up" : std::string(field.name);
      names += names.empty() ? shown : " | " + shown;
      if (field.type->size(field.member(&value)) > 0) given.emplace_back(field.inlined ? "" : field.name);
    }
    for (std::size_t i = 1; i < given.size(); ++i) {
      broken.push_back({invalidValue(pointer + "/" + given[i], "Only one of these may be given.", names), {}});
    }
  }
}

void appendLookAtRules(const EyeTarget& lookAt, const std::string& camera, std::vector<BrokenRule>& broken) {
  const Vec3 view = minus(lookAt.target, lookAt.eye);
  if (length(view) < kShortest) {
    broken.push_back(
        {invalidValue(camera + "/target", "The target is where the eye is, so there is no direction to look in.",
                      "any place but the eye", vecText(lookAt.target)),
         {camera + "/eye", camera + "/target"}});
    return;
  }
  if (length(lookAt.up) < kShortest) {
    broken.push_back(
        {invalidValue(camera + "/up", "This direction is zero.", "any direction but the view's", vecText(lookAt.up)),
         {camera + "/up"}});
  } else if (length(cross(unit(view), unit(lookAt.up))) < kParallel) {
    broken.push_back({invalidValue(camera + "/up", "The direction up is parallel to the direction of view.",
                                   "any direction but the view's", vecText(lookAt.up)),
                      {camera + "/eye", camera + "/target", camera + "/up"}});
  }
}

/// The rotation of a pose: its axes have length 1, are perpendicular and are not mirrored, within what numbers of a
/// calibration are rounded to.
bool isRotation(const Rows4& rows) {
  constexpr double kRounding = 1e-3;
  const auto axis = [&](std::size_t i) { return Vec3{rows[0][i], rows[1][i], rows[2][i]}; };
  const auto dot = [](const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i; j < 3; ++j) {
      if (!(std::abs(dot(axis(i), axis(j)) - (i == j ? 1 : 0)) <= kRounding)) return false;
    }
  }
  return dot(cross(axis(0), axis(1)), axis(2)) > 0;
}

void appendPoseRules(const CameraPose& pose, const std::string& camera, std::vector<BrokenRule>& broken) {
  const std::string matrix = camera + "/pose/worldFromCamera";
  const Rows4& rows = pose.worldFromCamera;
  if (rows[3] != std::array<double, 4>{0, 0, 0, 1}) {
    broken.push_back(
        {invalidValue(matrix + "/3",
                      "The last row of a pose is 0 0 0 1. A matrix that lists columns has to be transposed.", "0 0 0 1",
                      numberText(rows[3][0]) + " " + numberText(rows[3][1]) + " " + numberText(rows[3][2]) + " " +
                          numberText(rows[3][3])),
         {matrix}});
  }
  if (!isRotation(rows)) {
    broken.push_back({invalidValue(matrix,
                                   "The upper left of a pose is a rotation: axes of length 1, perpendicular to each "
                                   "other, not mirrored.",
                                   "a rotation within 0.001", "no rotation"),
                      {matrix}});
  }
}

void appendNearFar(double near, double far, const std::string& lens, std::vector<BrokenRule>& broken) {
  if (near < far) return;
  broken.push_back({invalidValue(lens + "/far", "The value of far must be more than near.",
                                 "more than " + numberText(near), numberText(far)),
                    {lens + "/near", lens + "/far"}});
}

} // namespace

void appendAnimationRules(const AnimationMoment& moment, const std::string& pointer, std::vector<BrokenRule>& broken) {
  appendAlternatives(moment, pointer, broken);
  if (moment.index || moment.name || moment.timeSeconds == 0) return;
  broken.push_back(
      {invalidValue(pointer, "A time needs the index or the name of an animation.", "index | name", "neither"),
       {pointer + "/index", pointer + "/name"}});
}

void appendPlaceRules(const NodeOptions& node, const std::string& pointer, std::vector<BrokenRule>& broken) {
  if (node.matrix) {
    if (node.translation || node.rotation || node.scale) {
      broken.push_back({invalidValue(pointer + "/matrix", "A node has a matrix, or a translation, rotation and scale.",
                                     "matrix | translation, rotation, scale", "both"),
                        {pointer + "/matrix", pointer + "/translation", pointer + "/rotation", pointer + "/scale"}});
    }
    const auto& m = *node.matrix;
    if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1) {
      broken.push_back(
          {invalidValue(pointer + "/matrix", "The matrix is not affine: its last row, every fourth number, is 0 0 0 1.",
                        "0 0 0 1",
                        numberText(m[3]) + " " + numberText(m[7]) + " " + numberText(m[11]) + " " + numberText(m[15])),
           {pointer + "/matrix"}});
    }
  }
  if (node.rotation) {
    const auto& q = *node.rotation;
    if (std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3])) < kShortest) {
      broken.push_back(
          {invalidValue(pointer + "/rotation", "This quaternion is zero.", "any length but zero", "0 0 0 0"),
           {pointer + "/rotation"}});
    }
  }
}

void appendCameraRules(const Camera& camera, const std::string& pointer, std::vector<BrokenRule>& broken) {
  appendAlternatives(camera, pointer, broken);
  if (camera.lookAt) appendLookAtRules(*camera.lookAt, pointer, broken);
  if (camera.pose) appendPoseRules(*camera.pose, pointer, broken);
  if (camera.perspective && camera.perspective->near && camera.perspective->far) {
    appendNearFar(*camera.perspective->near, *camera.perspective->far, pointer + "/perspective", broken);
  }
  if (camera.intrinsics && camera.intrinsics->near && camera.intrinsics->far) {
    appendNearFar(*camera.intrinsics->near, *camera.intrinsics->far, pointer + "/intrinsics", broken);
  }
  if (camera.orthographic) {
    appendNearFar(camera.orthographic->near, camera.orthographic->far, pointer + "/orthographic", broken);
  }
}

void appendLightRules(const Light& light, std::size_t index, std::vector<BrokenRule>& broken) {
  const std::string pointer = "/lights/" + std::to_string(index);
  const std::string type = std::string(spell(light.type));
  const LightTraits& kind = traitsOf(light.type);

  const auto require = [&](bool given, const char* name, std::vector<std::string> reads, const std::string& detail) {
    reads.push_back(pointer + "/type");
    if (!given) broken.push_back({invalidValue(pointer + "/" + name, detail, "", "absent"), std::move(reads)});
  };
  const auto forbid = [&](bool given, const char* name) {
    if (!given) return;
    broken.push_back(
        {invalidValue(pointer + "/" + name, "A light of type " + type + " has no " + name + "."), {pointer + "/type"}});
  };

  appendAlternatives(light, pointer, broken);
  if (light.sun) appendSunRules(*light.sun, pointer + "/sun", broken);
  if (kind.parallel) {
    require(light.direction || light.sun, "direction", {pointer + "/direction", pointer + "/sun"},
            "A light of type " + type + " needs direction or sun.");
    forbid(light.position.has_value(), "position");
    forbid(light.range.has_value(), "range");
    forbid(light.radius.has_value(), "radius");
  } else if (kind.directed) {
    require(light.direction.has_value(), "direction", {pointer + "/direction"},
            "A light of type " + type + " needs a direction.");
  } else {
    forbid(light.direction.has_value(), "direction");
  }
  if (!kind.hasCone) { // what is not asked for is echoed with its value, and may come back
    forbid(light.innerConeDegrees != Light().innerConeDegrees, "innerConeDegrees");
    forbid(light.outerConeDegrees != Light().outerConeDegrees, "outerConeDegrees");
  }
  if (!kind.parallel) {
    require(light.position.has_value(), "position", {pointer + "/position"},
            "A light of type " + type + " needs a position.");
    forbid(light.sun.has_value(), "sun");
    forbid(light.angularDiameterDegrees.has_value(), "angularDiameterDegrees");
  }
  if (light.direction && length(*light.direction) < kShortest) {
    broken.push_back({invalidValue(pointer + "/direction", "This direction is zero.", "any direction of some length",
                                   vecText(*light.direction)),
                      {pointer + "/direction"}});
  }
  if (light.innerConeDegrees >= light.outerConeDegrees) {
    broken.push_back(
        {invalidValue(pointer + "/innerConeDegrees", "The inner cone must be narrower than the outer.",
                      "less than " + numberText(light.outerConeDegrees), numberText(light.innerConeDegrees)),
         {pointer + "/innerConeDegrees", pointer + "/outerConeDegrees"}});
  }
}

} // namespace gnomon
