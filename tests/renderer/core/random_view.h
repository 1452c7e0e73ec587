#pragma once

#include <cmath>
#include <limits>
#include <ostream>
#include <rapidcheck.h>

#include "renderer/core/camera_view.h"

namespace gnomon {

/// A number in 0..1, both ends included.
struct RandomUnit {
  double value = 0;
};

/// A camera: any orientation, fov 1 to 170 degrees, orthographic too, finite and infinite far. Of those with
/// perspective half are off centre, many wholly beside their axis.
struct RandomView {
  CameraView view;
};

inline std::ostream& operator<<(std::ostream& out, const RandomUnit& unit) {
  return out << unit.value;
}

inline std::ostream& operator<<(std::ostream& out, const RandomView& random) {
  const CameraView& v = random.view;
  return out << (v.perspective ? "perspective" : "orthographic") << " half " << v.halfSize.x << ' ' << v.halfSize.y
             << " center " << v.center.x << ' ' << v.center.y << " near " << v.near << " far " << v.far << " forward "
             << v.forward.x << ' ' << v.forward.y << ' ' << v.forward.z << " eye " << v.eye.x << ' ' << v.eye.y << ' '
             << v.eye.z;
}

/// Turned by `yaw` and then `pitch`, radians.
inline void turn(CameraView& view, double yaw, double pitch) {
  view.right = {std::cos(yaw), 0, -std::sin(yaw)};
  view.forward = {-std::sin(yaw) * std::cos(pitch), std::sin(pitch), -std::cos(yaw) * std::cos(pitch)};
  view.up = glm::cross(view.right, view.forward);
}

} // namespace gnomon

namespace rc {

template <>
struct Arbitrary<gnomon::RandomUnit> {
  static Gen<gnomon::RandomUnit> arbitrary() {
    return gen::map(gen::inRange(0, 1000001), [](int n) { return gnomon::RandomUnit{n / 1e6}; });
  }
};

template <>
struct Arbitrary<gnomon::RandomView> {
  static Gen<gnomon::RandomView> arbitrary() {
    return gen::exec([] {
      const auto between = [](double low, double high) {
        return low + (high - low) * (*gen::arbitrary<gnomon::RandomUnit>()).value;
      };
      gnomon::CameraView view;
      gnomon::turn(view, between(-3.2, 3.2), between(-1.5707963, 1.5707963));
      view.eye = {between(-1e4, 1e4), between(-100, 100), between(-1e4, 1e4)};
      view.perspective = *gen::inRange(0, 4) != 0;
      if (view.perspective) {
        const double tangent = std::tan(between(1, 170) / 2 * 3.141592653589793 / 180);
        view.halfSize = {tangent * between(0.3, 3), tangent};
        if (*gen::inRange(0, 2) == 0) view.center = {between(-8, 8), between(-8, 8)};
        view.near = between(0.01, 2);
        view.far = *gen::inRange(0, 2) == 0 ? std::numeric_limits<double>::infinity() : view.near + between(1, 5000);
      } else {
        view.halfSize = {between(0.1, 100), between(0.1, 100)};
        view.near = between(-100, 100);
        view.far = view.near + between(1, 5000);
      }
      return gnomon::RandomView{view};
    });
  }
};

} // namespace rc
