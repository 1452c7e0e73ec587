// The corners of sixteen triangles of one instance, fetched, placed and interpolated.
#if defined(GNOMON_CPU_VERTICES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_VERTICES_INL_H
#undef GNOMON_CPU_VERTICES_INL_H
#else
#define GNOMON_CPU_VERTICES_INL_H
#endif

#include <cstddef>

#include "renderer/cpu/frame_scene.h"
#include "renderer/cpu/surface/sight-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// A vector of the primitive's own space, by the rows of a matrix. `V`: as in TriangleOf.
template <class V>
HWY_INLINE V turned(const glm::vec4 (&rows)[3], const V& v) {
  return {dot(V(glm::vec3(rows[0])), v), dot(V(glm::vec3(rows[1])), v), dot(V(glm::vec3(rows[2])), v)};
}

/// A triangle of the primitive's own space, by the rows of an affine matrix.
template <class V>
HWY_INLINE TriangleOf<V> placed(const glm::vec4 (&rows)[3], const TriangleOf<V>& local) {
  return {turned(rows, local.corner) + V(glm::vec3(rows[0].w, rows[1].w, rows[2].w)), turned(rows, local.edge1),
          turned(rows, local.edge2)};
}

/// Vertices of triangles. Where all lanes have one triangle, its numbers are read once.
class Corners {
 public:
  /// `triangle`: of the instance's primitive.
  HWY_INLINE Corners(const FrameScene& scene, const Slot& first, const Int& triangle) : scene_(scene) {
    same_ = all(triangle == Int(firstLane(triangle)));
    const std::uint32_t* indices = scene.scene.indices.data() + first.firstIndex;
    for (int c = 0; c < 3; ++c) {
      if (same_) {
        one_[c] =
            indices[3 * static_cast<std::size_t>(firstLane(triangle)) + static_cast<std::size_t>(c)] + first.baseVertex;
      } else {
        each_[c] = gather(indices + c, triangle * 3) + Int(static_cast<std::int32_t>(first.baseVertex));
      }
    }
  }

  /// As lines of sight meet them. `rows`: from the primitive's own space to the sight's.
  HWY_INLINE SeenTriangle seen(const glm::vec4 (&rows)[3], const Sight& sight) const {
    if (!same_) {
      const Triangle each = placed(rows, eachTriangle());
      return seenFrom(sight.origin - each.corner, each);
    }
    const TriangleOf<glm::vec3> one = placed(rows, oneTriangle());
    if (sight.spreads) return inAllLanes(seenFrom(0.0f - one.corner, one));
    return seenFrom(sight.origin - Float3(one.corner), inAllLanes(one));
  }

  /// Fields of VertexAttributes, a float each, by their offset; interpolated at a meeting.
  HWY_INLINE Float number(std::size_t offset, const Meeting& m) const {
    if (!same_) return blend(attribute(offset, 0), attribute(offset, 1), attribute(offset, 2), m);
    const float first = oneNumber(offset, 0);
    return mulAdd(Float(oneNumber(offset, 1) - first), m.u, mulAdd(Float(oneNumber(offset, 2) - first), m.v, first));
  }
  HWY_INLINE Float2 pair(std::size_t offset, const Meeting& m) const {
    return {number(offset, m), number(offset + sizeof(float), m)};
  }
  HWY_INLINE Float3 triple(std::size_t offset, const Meeting& m) const {
    return {number(offset, m), number(offset + sizeof(float), m), number(offset + 2 * sizeof(float), m)};
  }

  /// A triple, turned by the rows of a matrix and of unit length; `otherwise` where it has no direction. Of one flat
  /// triangle it is the same everywhere.
  HWY_INLINE Float3 direction(const glm::vec4 (&rows)[3], std::size_t offset, const Meeting& m,
                              const Float3& otherwise) const {
    if (same_) {
      const glm::vec3 first = oneTriple(offset, 0);
      if (first == oneTriple(offset, 1) && first == oneTriple(offset, 2)) {
        return directionOf(turned(rows, first), otherwise);
      }
    }
    return directionOf(turned(rows, triple(offset, m)), otherwise);
  }

  /// The normal of their planes, unit length, on the eye's side.
  HWY_INLINE Float3 face(const SeenTriangle& seen, const Float3& toEye) const {
    const Float3& n = seen.normal;
    const Float3 face =
        same_ ? directionOf(glm::vec3(firstLane(n.x), firstLane(n.y), firstLane(n.z)), toEye) : directionOf(n, toEye);
    return select(dot(face, toEye) < 0.0f, -face, face);
  }

  /// How a pair changes by a step of u and v.
  HWY_INLINE Float2 moved(std::size_t offset, const Float2& step) const {
    Float2 result;
    Float* out[] = {&result.x, &result.y};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const std::size_t field = offset + axis * sizeof(float);
      const Float first = attribute(field, 0);
      *out[axis] = (attribute(field, 1) - first) * step.x + (attribute(field, 2) - first) * step.y;
    }
    return result;
  }

  struct Color {
    Float3 rgb;
    Float a;
  };
  HWY_INLINE Color color(const Meeting& m) const {
    Float channels[4];
    for (std::size_t two = 0; two < 2; ++two) {
      Int bits[3];
      for (int c = 0; c < 3; ++c) {
        bits[c] = bitsOf(attribute(offsetof(VertexAttributes, color) + two * sizeof(float), c));
      }
      const auto half = [&](int c, bool upper) HWY_ATTR {
        return toFloat(upper ? shiftRightUnsigned<16>(bits[c]) : bits[c] & Int(0xffff)) * (1.0f / 65535.0f);
      };
      channels[2 * two] = blend(half(0, false), half(1, false), half(2, false), m);
      channels[2 * two + 1] = blend(half(0, true), half(1, true), half(2, true), m);
    }
    return {{channels[0], channels[1], channels[2]}, channels[3]};
  }

 private:
  HWY_INLINE Triangle eachTriangle() const {
    const float* positions = &scene_.scene.positions.data()->x;
    Float3 p[3];
    for (int c = 0; c < 3; ++c) p[c] = {at(positions, 3, c), at(positions + 1, 3, c), at(positions + 2, 3, c)};
    return {p[0], p[1] - p[0], p[2] - p[0]};
  }
  HWY_INLINE TriangleOf<glm::vec3> oneTriangle() const {
    const glm::vec3* positions = scene_.scene.positions.data();
    const glm::vec3 corner = positions[one_[0]];
    return {corner, positions[one_[1]] - corner, positions[one_[2]] - corner};
  }
  HWY_INLINE float oneNumber(std::size_t offset, int corner) const {
    return oneAttributes(corner)[offset / sizeof(float)];
  }
  HWY_INLINE glm::vec3 oneTriple(std::size_t offset, int corner) const {
    const float* numbers = oneAttributes(corner) + offset / sizeof(float);
    return {numbers[0], numbers[1], numbers[2]};
  }
  HWY_INLINE const float* oneAttributes(int corner) const {
    return reinterpret_cast<const float*>(&scene_.scene.attributes.data()[one_[corner]]);
  }
  static HWY_INLINE Float blend(const Float& a, const Float& b, const Float& c, const Meeting& m) {
    return mulAdd(b - a, m.u, mulAdd(c - a, m.v, a));
  }
  HWY_INLINE Float at(const float* base, int stride, int corner) const {
    return same_ ? Float(base[static_cast<std::size_t>(one_[corner]) * static_cast<std::size_t>(stride)])
                 : gather(base, each_[corner] * stride);
  }
  HWY_INLINE Float attribute(std::size_t offset, int corner) const {
    static_assert(sizeof(VertexAttributes) % sizeof(float) == 0);
    const auto* attributes = reinterpret_cast<const float*>(scene_.scene.attributes.data());
    return at(attributes + offset / sizeof(float), sizeof(VertexAttributes) / sizeof(float), corner);
  }

  const FrameScene& scene_;
  bool same_ = false;
  std::uint32_t one_[3] = {}; ///< of all lanes, where they have the same triangle
  Int each_[3];
};

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
