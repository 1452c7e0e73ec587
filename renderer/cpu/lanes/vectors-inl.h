// Vectors of sixteen lanes, with the names that GLSL has for them.
#if defined(GNOMON_CPU_VECTORS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_VECTORS_INL_H
#undef GNOMON_CPU_VECTORS_INL_H
#else
#define GNOMON_CPU_VECTORS_INL_H
#endif

#include <glm/glm.hpp>

#include "renderer/cpu/lanes/functions-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

struct Float2 {
  Float x, y;

  Float2() = default;
  HWY_INLINE Float2(const Float& x_, const Float& y_) : x(x_), y(y_) {}
  HWY_INLINE explicit Float2(const Float& all) : x(all), y(all) {}
  HWY_INLINE explicit Float2(const glm::vec2& v) : x(v.x), y(v.y) {}
};

struct Float3 {
  Float x, y, z;

  Float3() = default;
  HWY_INLINE Float3(const Float& x_, const Float& y_, const Float& z_) : x(x_), y(y_), z(z_) {}
  HWY_INLINE explicit Float3(const Float& all) : x(all), y(all), z(all) {}
  HWY_INLINE explicit Float3(const glm::vec3& v) : x(v.x), y(v.y), z(v.z) {}
  HWY_INLINE explicit Float3(const glm::vec4& v) : x(v.x), y(v.y), z(v.z) {}
};

struct Float4 {
  Float x, y, z, w;

  Float4() = default;
  HWY_INLINE Float4(const Float& x_, const Float& y_, const Float& z_, const Float& w_) : x(x_), y(y_), z(z_), w(w_) {}
};

/// Sixteen vectors that follow each other.
HWY_INLINE Float3 loadVectors(const float* from) {
  Float3 v;
  for (std::size_t i = 0; i < kParts; ++i) {
    hn::LoadInterleaved3(kFloats, from + 3 * i * kPerPart, v.x.part[i], v.y.part[i], v.z.part[i]);
  }
  return v;
}

#define GNOMON_VECTOR_OPERATOR(op)                                  \
  HWY_INLINE Float2 operator op(const Float2& a, const Float2& b) { \
    return {a.x op b.x, a.y op b.y};                                \
  }                                                                 \
  HWY_INLINE Float2 operator op(const Float2& a, const Float& b) {  \
    return {a.x op b, a.y op b};                                    \
  }                                                                 \
  HWY_INLINE Float2 operator op(const Float& a, const Float2& b) {  \
    return {a op b.x, a op b.y};                                    \
  }                                                                 \
  HWY_INLINE Float3 operator op(const Float3& a, const Float3& b) { \
    return {a.x op b.x, a.y op b.y, a.z op b.z};                    \
  }                                                                 \
  HWY_INLINE Float3 operator op(const Float3& a, const Float& b) {  \
    return {a.x op b, a.y op b, a.z op b};                          \
  }                                                                 \
  HWY_INLINE Float3 operator op(const Float& a, const Float3& b) {  \
    return {a op b.x, a op b.y, a op b.z};                          \
  }
GNOMON_VECTOR_OPERATOR(+)
GNOMON_VECTOR_OPERATOR(-)
GNOMON_VECTOR_OPERATOR(*)
GNOMON_VECTOR_OPERATOR(/)
#undef GNOMON_VECTOR_OPERATOR

HWY_INLINE Float2 operator-(const Float2& a) {
  return {-a.x, -a.y};
}
HWY_INLINE Float3 operator-(const Float3& a) {
  return {-a.x, -a.y, -a.z};
}
HWY_INLINE Float3& operator+=(Float3& a, const Float3& b) {
  return a = a + b;
}
HWY_INLINE Float3& operator*=(Float3& a, const Float& b) {
  return a = a * b;
}

HWY_INLINE Float dot(const Float2& a, const Float2& b) {
  return mulAdd(a.x, b.x, a.y * b.y);
}
HWY_INLINE Float dot(const Float3& a, const Float3& b) {
  return mulAdd(a.x, b.x, mulAdd(a.y, b.y, a.z * b.z));
}
/// Of one vector, to the bit as of each of sixteen.
HWY_INLINE float dot(const glm::vec3& a, const glm::vec3& b) {
  return mulAdd(a.x, b.x, mulAdd(a.y, b.y, a.z * b.z));
}
HWY_INLINE Float3 cross(const Float3& a, const Float3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
HWY_INLINE Float length(const Float2& a) {
  return sqrt(dot(a, a));
}
HWY_INLINE Float length(const Float3& a) {
  return sqrt(dot(a, a));
}
HWY_INLINE Float3 normalize(const Float3& a) {
  return a * inversesqrt(dot(a, a));
}
HWY_INLINE Float3 reflect(const Float3& a, const Float3& normal) {
  return a - normal * (2.0f * dot(normal, a));
}
HWY_INLINE Float3 mix(const Float3& a, const Float3& b, const Float& share) {
  return {mix(a.x, b.x, share), mix(a.y, b.y, share), mix(a.z, b.z, share)};
}
HWY_INLINE Float3 clamp(const Float3& a, const Float& low, const Float& high) {
  return {clamp(a.x, low, high), clamp(a.y, low, high), clamp(a.z, low, high)};
}
HWY_INLINE Float2 select(const Mask& where, const Float2& yes, const Float2& no) {
  return {select(where, yes.x, no.x), select(where, yes.y, no.y)};
}
HWY_INLINE Float3 select(const Mask& where, const Float3& yes, const Float3& no) {
  return {select(where, yes.x, no.x), select(where, yes.y, no.y), select(where, yes.z, no.z)};
}

/// As directionOf, where squares may be no floats.
inline HWY_NOINLINE Float3 directionOfAnySize(const Float3& v, const Float3& otherwise) {
  const Float largest = max(max(abs(v.x), abs(v.y)), abs(v.z));
  const Mask directed = (largest > 1e-37f) & (largest < 1e37f);
  // By the power of two that brings the largest to 1..2.
  const Float3 scaled = v * floatOf(Int(0x7f000000) - (bitsOf(largest) & Int(0x7f800000)));
  return select(directed, scaled * inversesqrt(select(directed, dot(scaled, scaled), 1.0f)), otherwise);
}

inline constexpr float kLeastSquare = 1e-20f, kMostSquare = 1e20f; ///< of lengths, between which floats lose nothing

/// Unit length; `otherwise` where it has no direction. Of any size: squares of triangles a million kilometres wide are
/// no floats. Where they are, powers of two change no bit.
HWY_INLINE Float3 directionOf(const Float3& v, const Float3& otherwise) {
  const Float squared = dot(v, v);
  if (all((squared > kLeastSquare) & (squared < kMostSquare))) return v * inversesqrt(squared);
  return directionOfAnySize(v, otherwise);
}
/// Of one vector that all lanes have.
HWY_INLINE Float3 directionOf(const glm::vec3& v, const Float3& otherwise) {
  const float squared = dot(v, v);
  if (squared > kLeastSquare && squared < kMostSquare) return Float3(v * inversesqrt(squared));
  return directionOfAnySize(Float3(v), otherwise);
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
