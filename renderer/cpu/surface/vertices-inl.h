// The corners of sixteen triangles of one instance, fetched, placed and interpolated.
#if defined(GNOMON_CPU_VERTICES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_VERTICES_INL_H
#undef GNOMON_CPU_VERTICES_INL_H
#else
#define GNOMON_CPU_VERTICES_INL_H
#endif

#include <cstddef>

#include "renderer/cpu/frame_scene.h"
#include "renderer/cpu/lanes/gather-inl.h"
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

/// A number that a triangle's vertices have, from corner to corner.
struct Field {
  Float first, toSecond, toThird;

  HWY_INLINE Float at(const Meeting& m) const { return mulAdd(toSecond, m.u, mulAdd(toThird, m.v, first)); }
  /// How it changes by a step of u and v.
  HWY_INLINE Float moved(const Float2& step) const { return toSecond * step.x + toThird * step.y; }
};

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

  /// Four of the vertices' numbers, whose first lies at this offset of VertexAttributes.
  struct Fields {
    Field of[4];

    HWY_INLINE Float3 triple(const Meeting& m) const { return {of[0].at(m), of[1].at(m), of[2].at(m)}; }
  };
  HWY_INLINE Fields fields(std::size_t offset) const {
    Fields fields;
    if (same_) {
      for (std::size_t k = 0; k < 4; ++k) {
        const float first = oneNumber(offset, 0, k);
        fields.of[k] = {first, oneNumber(offset, 1, k) - first, oneNumber(offset, 2, k) - first};
      }
      return fields;
    }
    Float corner[3][4];
    for (int c = 0; c < 3; ++c) readFours(offset, c, corner[c]);
    for (std::size_t k = 0; k < 4; ++k) {
      fields.of[k] = {corner[0][k], corner[1][k] - corner[0][k], corner[2][k] - corner[0][k]};
    }
    return fields;
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
    return directionOf(turned(rows, fields(offset).triple(m)), otherwise);
  }

  /// Normals of the vertices, by the rows of a matrix, unit length. False where they are one in each lane's triangle.
  HWY_INLINE bool normals(const glm::vec4 (&rows)[3], Float3 (&found)[3]) const {
    constexpr std::size_t offset = offsetof(VertexAttributes, normal);
    const Float3 nowhere(Float(0.0f));
    if (same_) {
      const glm::vec3 first = oneTriple(offset, 0);
      if (first == oneTriple(offset, 1) && first == oneTriple(offset, 2)) return false;
      for (int c = 0; c < 3; ++c) found[c] = Float3(directionOf(turned(rows, oneTriple(offset, c)), nowhere));
      return true;
    }
    for (int c = 0; c < 3; ++c) {
      Float own[4];
      readFours(offset, c, own);
      found[c] = directionOf(turned(rows, Float3(own[0], own[1], own[2])), nowhere);
    }
    return true;
  }

  /// The normal of their planes, unit length, on the eye's side.
  HWY_INLINE Float3 face(const SeenTriangle& seen, const Float3& toEye) const {
    const Float3& n = seen.normal;
    const Float3 face =
        same_ ? directionOf(glm::vec3(firstLane(n.x), firstLane(n.y), firstLane(n.z)), toEye) : directionOf(n, toEye);
    return select(dot(face, toEye) < 0.0f, -face, face);
  }

  struct Color {
    Float3 rgb;
    Float a;
  };
  HWY_INLINE Color color(const Meeting& m) const {
    constexpr std::size_t kBefore = 2; // numbers: the last four end with the color
    static_assert(offsetof(VertexAttributes, color) + 2 * sizeof(float) == sizeof(VertexAttributes));
    Float corner[3][4];
    for (int c = 0; c < 3; ++c) readFours(offsetof(VertexAttributes, color) - kBefore * sizeof(float), c, corner[c]);
    Float channels[4];
    for (std::size_t two = 0; two < 2; ++two) {
      const auto half = [&](int c, bool upper) HWY_ATTR {
        const Int bits = bitsOf(corner[c][kBefore + two]);
        return toFloat(upper ? shiftRightUnsigned<16>(bits) : bits & Int(0xffff)) * (1.0f / 65535.0f);
      };
      channels[2 * two] = blend(half(0, false), half(1, false), half(2, false), m);
      channels[2 * two + 1] = blend(half(0, true), half(1, true), half(2, true), m);
    }
    return {{channels[0], channels[1], channels[2]}, channels[3]};
  }

 private:
  HWY_INLINE Triangle eachTriangle() const {
    const float* positions = &scene_.scene.positions.data()->x;
    const Int last(static_cast<std::int32_t>(scene_.scene.positions.size() - 1)); // behind which nothing lies
    Float3 p[3];
    for (int c = 0; c < 3; ++c) {
      const Int at = each_[c] * 3;
      if (any(each_[c] == last)) {
        p[c] = {gather(positions, at), gather(positions + 1, at), gather(positions + 2, at)};
      } else {
        Float numbers[4];
        gatherFours(positions, at, numbers);
        p[c] = {numbers[0], numbers[1], numbers[2]};
      }
    }
    return {p[0], p[1] - p[0], p[2] - p[0]};
  }
  HWY_INLINE TriangleOf<glm::vec3> oneTriangle() const {
    const glm::vec3* positions = scene_.scene.positions.data();
    const glm::vec3 corner = positions[one_[0]];
    return {corner, positions[one_[1]] - corner, positions[one_[2]] - corner};
  }
  HWY_INLINE float oneNumber(std::size_t offset, int corner, std::size_t behind) const {
    return oneAttributes(corner)[offset / sizeof(float) + behind];
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
  HWY_INLINE void readFours(std::size_t offset, int corner, Float (&numbers)[4]) const {
    static_assert(sizeof(VertexAttributes) % sizeof(float) == 0);
    constexpr std::size_t kNumbers = sizeof(VertexAttributes) / sizeof(float);
    if (same_) {
      for (std::size_t k = 0; k < 4; ++k) numbers[k] = oneNumber(offset, corner, k);
    } else {
      const auto* attributes = reinterpret_cast<const float*>(scene_.scene.attributes.data());
      gatherFours(attributes + offset / sizeof(float), each_[corner] * static_cast<int>(kNumbers), numbers);
    }
  }

  const FrameScene& scene_;
  bool same_ = false;
  std::uint32_t one_[3] = {}; ///< of all lanes, where they have the same triangle
  Int each_[3];
};

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
