// Points of tests as sixteen lanes.
#if defined(GNOMON_TESTS_ASKED_POINTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_TESTS_ASKED_POINTS_INL_H
#undef GNOMON_TESTS_ASKED_POINTS_INL_H
#else
#define GNOMON_TESTS_ASKED_POINTS_INL_H
#endif

#include <algorithm>

#include "renderer/cpu/surface/fragments-inl.h"
#include "tests/renderer/cpu/shadow/shadow_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

struct PointPacket {
  Receiver receiver;
  Float3 toLight;
  std::size_t count = 0; ///< lanes that hold points
};

inline Float3 loadPoints(const float (&columns)[3][kLanes]) {
  return {load(columns[0]), load(columns[1]), load(columns[2])};
}

inline void storePoints(const Float3& values, glm::vec3* out, std::size_t count) {
  float columns[3][kLanes];
  store(values.x, columns[0]);
  store(values.y, columns[1]);
  store(values.z, columns[2]);
  for (std::size_t i = 0; i < count; ++i) out[i] = glm::vec3(columns[0][i], columns[1][i], columns[2][i]);
}

inline PointPacket pointPacket(std::span<const AskedPoint> points, std::size_t first) {
  float relative[3][kLanes] = {};
  float normal[3][kLanes] = {};
  float toLight[3][kLanes] = {};
  float depth[kLanes] = {};
  float x[kLanes] = {};
  float y[kLanes] = {};
  std::uint32_t group[kLanes] = {};
  std::uint32_t samples[kLanes] = {};
  std::uint32_t triangle[kLanes] = {};
  float weights[2][kLanes] = {};
  PointPacket packet;
  packet.count = std::min(points.size() - first, kLanes);
  for (std::size_t i = 0; i < packet.count; ++i) {
    const AskedPoint& point = points[first + i];
    for (int axis = 0; axis < 3; ++axis) {
      relative[axis][i] = point.relative[axis];
      normal[axis][i] = point.normal[axis];
      toLight[axis][i] = point.toLight[axis];
    }
    depth[i] = point.viewDepth;
    x[i] = point.place.x;
    y[i] = point.place.y;
    group[i] = point.groupBit;
    samples[i] = point.samples;
    triangle[i] = point.triangle;
    for (int axis = 0; axis < 2; ++axis) weights[axis][i] = point.weights[axis];
  }
  packet.receiver = {firstLanes(packet.count),
                     loadPoints(relative),
                     loadPoints(normal),
                     load(depth),
                     load(group),
                     {load(x), load(y)},
                     load(samples),
                     load(triangle),
                     {load(weights[0]), load(weights[1])},
                     noSmoothPlace()};
  packet.toLight = loadPoints(toLight);
  return packet;
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
