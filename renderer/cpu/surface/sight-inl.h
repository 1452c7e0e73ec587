// Lines of sight through places of the picture, and where they meet the planes of triangles.
#if defined(GNOMON_CPU_SIGHT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_SIGHT_INL_H
#undef GNOMON_CPU_SIGHT_INL_H
#else
#define GNOMON_CPU_SIGHT_INL_H
#endif

#include "renderer/cpu/lanes/vectors-inl.h"
#include "renderer/shaders/shared/frame_types.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// The points origin + depth * way; as the place moves by a pixel, either way or origin moves by a step.
struct Sight {
  Float3 origin; ///< relative to the eye, metres
  Float3 way;
  glm::vec3 stepX{0}, stepY{0};
  bool spreads = true; ///< from one origin: perspective
};

/// `depth` along it is view depth.
HWY_INLINE Sight sightThrough(const shared::FrameData& frame, const Float2& place) {
  Sight sight;
  const glm::vec3 right(frame.right), up(frame.up), middle(frame.middle);
  sight.spreads = frame.perspective != 0u;
  sight.stepX = right * frame.pixelStep.x;
  sight.stepY = up * frame.pixelStep.y;
  const Float3 across =
      Float3(right) * (place.x * frame.pixelStep.x - 1.0f) + Float3(up) * (place.y * frame.pixelStep.y - 1.0f);
  sight.origin = sight.spreads ? Float3(0.0f) : across;
  sight.way = sight.spreads ? Float3(middle) + across : Float3(middle);
  return sight;
}

/// From what is seen to the eye, unit length.
HWY_INLINE Float3 towardsEye(const Sight& sight, const shared::FrameData& frame) {
  return sight.spreads ? normalize(-sight.way) : Float3(-frame.forward);
}

/// The view depth of what the survey saw. Its corners lie on a grid, so that a line of sight may miss a triangle seen
/// edge-on, and meet its plane far off; but what is shown lies in the range that tiles are fitted to.
HWY_INLINE Float asSurveyed(const shared::FrameData& frame, const Float& viewDepth) {
  return frame.nearest < frame.farthest ? clamp(viewDepth, frame.nearest, frame.farthest) : viewDepth;
}

/// A triangle: a corner, and from there to the other two. `V`: Float3, or glm::vec3 of one that all lanes have.
template <class V>
struct TriangleOf {
  V corner; ///< as Sight::origin
  V edge1, edge2;
};
using Triangle = TriangleOf<Float3>;

/// A triangle, and what says of any line of sight from one origin where it meets the triangle's plane.
template <class V>
struct SeenTriangleOf {
  TriangleOf<V> triangle;
  V normal;               ///< of the plane, cross(edge1, edge2)
  V ofU, ofV;             ///< a way's product with these over that with the normal: the weights
  decltype(V::x) towards; ///< over a way's product with the normal: the depth
};
using SeenTriangle = SeenTriangleOf<Float3>;

/// `start`: where lines of sight begin, from the triangle's corner.
template <class V>
HWY_INLINE SeenTriangleOf<V> seenFrom(const V& start, const TriangleOf<V>& triangle) {
  const V normal = cross(triangle.edge1, triangle.edge2);
  return {triangle, normal, cross(start, triangle.edge2), cross(triangle.edge1, start), -dot(start, normal)};
}

HWY_INLINE Triangle inAllLanes(const TriangleOf<glm::vec3>& one) {
  return {Float3(one.corner), Float3(one.edge1), Float3(one.edge2)};
}
HWY_INLINE SeenTriangle inAllLanes(const SeenTriangleOf<glm::vec3>& one) {
  return {inAllLanes(one.triangle), Float3(one.normal), Float3(one.ofU), Float3(one.ofV), Float(one.towards)};
}

/// Where a line of sight meets a triangle's plane: corner + u * edge1 + v * edge2.
struct Meeting {
  Float u, v;
  Float depth;
};

/// Always finite: of a triangle that is seen edge-on, some point near it.
HWY_INLINE Meeting meetingOf(const Sight& sight, const SeenTriangle& seen) {
  const Float steepness = dot(sight.way, seen.normal);
  const Float over = 1.0f / steepness;
  Meeting m;
  m.u = dot(sight.way, seen.ofU) * over;
  m.v = dot(sight.way, seen.ofV) * over;
  m.depth = seen.towards * over;
  // Comparisons with what is not a number are false.
  const Mask sound = (abs(m.u) < 1e4f) & (abs(m.v) < 1e4f) & (abs(m.depth) < 1e30f) & (steepness != Float(0.0f));
  if (all(sound)) return m;
  const Triangle& triangle = seen.triangle;
  const Float3 middle = triangle.corner + (triangle.edge1 + triangle.edge2) * (1.0f / 3.0f);
  m.u = select(sound, m.u, 1.0f / 3.0f);
  m.v = select(sound, m.v, 1.0f / 3.0f);
  m.depth = select(sound, m.depth, dot(middle - sight.origin, sight.way) / dot(sight.way, sight.way));
  return m;
}

/// The view depth of a meeting, no farther and no nearer than the triangle's corners: a triangle is met outside of them
/// where it is seen edge-on, as asSurveyed says.
HWY_INLINE Float withinCorners(const Triangle& triangle, const Float3& forward, const Float& viewDepth) {
  const Float first = dot(triangle.corner, forward);
  const Float second = first + dot(triangle.edge1, forward);
  const Float third = first + dot(triangle.edge2, forward);
  return clamp(viewDepth, min(first, min(second, third)), max(first, max(second, third)));
}

/// How u and v of a meeting change as the place moves by a pixel to the right and up.
struct MeetingSteps {
  Float2 right, up;
};

HWY_INLINE MeetingSteps stepsOf(const Sight& sight, const SeenTriangle& seen, const Meeting& m) {
  const Float steepness = dot(sight.way, seen.normal);
  const Float over = 1.0f / select(steepness == Float(0.0f), 1e-30f, steepness);
  const Float3 ofU = sight.spreads ? seen.ofU - seen.normal * m.u : cross(seen.triangle.edge2, sight.way);
  const Float3 ofV = sight.spreads ? seen.ofV - seen.normal * m.v : cross(sight.way, seen.triangle.edge1);
  const Float3 x(sight.stepX), y(sight.stepY);
  return {Float2(dot(x, ofU), dot(x, ofV)) * over, Float2(dot(y, ofU), dot(y, ofV)) * over};
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
