// What sixteen places of the picture show: the surface's place, its normals and its material.
#if defined(GNOMON_CPU_SURFACE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_SURFACE_INL_H
#undef GNOMON_CPU_SURFACE_INL_H
#else
#define GNOMON_CPU_SURFACE_INL_H
#endif

#include "renderer/cpu/fragments-inl.h"
#include "renderer/cpu/shared_functions-inl.h"
#include "renderer/cpu/vertices-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// Finite in all lanes; of those that show nothing it means nothing.
struct Surface {
  Receiver receiver;
  Float3 normal;    ///< for shading; unit length
  Float3 baseColor; ///< linear, 0..1
  Float metallic;
  Float roughness; ///< perceptual
  Float occlusion; ///< of the surroundings, 1 = open
  Float3 emission; ///< radiance; of what is unlit all that it shows
  Mask unlit;
};

HWY_INLINE Surface select(const Mask& where, const Surface& yes, const Surface& no) {
  Surface s;
  s.receiver.shown = no.receiver.shown;
  s.receiver.relative = select(where, yes.receiver.relative, no.receiver.relative);
  s.receiver.normal = select(where, yes.receiver.normal, no.receiver.normal);
  s.receiver.viewDepth = select(where, yes.receiver.viewDepth, no.receiver.viewDepth);
  s.receiver.groupBit = select(where, yes.receiver.groupBit, no.receiver.groupBit);
  s.receiver.place = no.receiver.place;
  s.normal = select(where, yes.normal, no.normal);
  s.baseColor = select(where, yes.baseColor, no.baseColor);
  s.metallic = select(where, yes.metallic, no.metallic);
  s.roughness = select(where, yes.roughness, no.roughness);
  s.occlusion = select(where, yes.occlusion, no.occlusion);
  s.emission = select(where, yes.emission, no.emission);
  s.unlit = (where & yes.unlit) | andNot(where, no.unlit);
  return s;
}

/// Unit length; `otherwise` where it has no direction.
HWY_INLINE Float3 directionOf(const Float3& v, const Float3& otherwise) {
  const Float squared = dot(v, v);
  const Mask directed = (squared > 1e-36f) & (squared < 1e36f);
  return select(directed, v * inversesqrt(select(directed, squared, 1.0f)), otherwise);
}

/// A vector of the primitive's own space, by the rows of a matrix.
HWY_INLINE Float3 turned(const glm::vec4 (&rows)[3], const Float3& v) {
  return {dot(Float3(glm::vec3(rows[0])), v), dot(Float3(glm::vec3(rows[1])), v), dot(Float3(glm::vec3(rows[2])), v)};
}

/// What triangles of one instance show.
class InstanceSurface {
 public:
  /// `triangle`: of the instance's primitive.
  HWY_INLINE InstanceSurface(const FrameScene& scene, std::uint32_t instance, const Int& triangle,
                             const Fragments& fragments)
      : frame_(scene.frame),
        slot_(scene.slots[scene.geometry.firstSlot[instance]]),
        placed_(scene.instances[instance]),
        material_(scene.scene.materials[static_cast<std::size_t>(slot_.material)]),
        data_(scene.materials[static_cast<std::size_t>(slot_.material)]),
        corners_(scene, slot_, triangle),
        sight_(sightThrough(scene.frame, fragments.place)) {
    const Triangle local = corners_.triangle();
    const auto& rows = placed_.relativeFromLocal;
    triangle_.corner = turned(rows, local.corner) + Float3(glm::vec3(rows[0].w, rows[1].w, rows[2].w));
    triangle_.edge1 = turned(rows, local.edge1);
    triangle_.edge2 = turned(rows, local.edge2);
    meeting_ = meetingOf(sight_, triangle_);
  }

  HWY_INLINE Surface surface(const Fragments& fragments) const {
    Surface s;
    s.receiver.shown = fragments.shown;
    s.receiver.relative = sight_.origin + sight_.way * meeting_.depth;
    s.receiver.viewDepth = meeting_.depth;
    s.receiver.groupBit = Int(1 << static_cast<int>(placed_.normalFromLocal[0].w));
    s.receiver.place = fragments.place;
    const Float3 toEye =
        frame_.forward.w > 0.0f ? directionOf(-s.receiver.relative, -sight_.way) : Float3(-glm::vec3(frame_.forward));
    const Float3 face = directionOf(meeting_.normal, toEye);
    s.receiver.normal = select(dot(face, toEye) < 0.0f, -face, face);
    s.normal = shadingNormal(s.receiver.normal);
    addMaterial(toEye, s);
    return s;
  }

 private:
  HWY_INLINE Float3 shadingNormal(const Float3& face) const {
    const Float3 own = turned(placed_.normalFromLocal, corners_.triple(offsetof(VertexAttributes, normal), meeting_));
    const Float3 n = material_.doubleSided ? select(dot(own, face) < 0.0f, -own, own) : own;
    return directionOf(n, face);
  }

  HWY_INLINE void addMaterial(const Float3& toEye, Surface& s) const {
    Float3 color{glm::vec3(data_.baseColorFactor)};
    if (material_.hasVertexColors) color = color * corners_.color(meeting_).rgb;
    Float metallic(data_.surface.x), roughness(data_.surface.y);
    if (material_.specularGlossiness) {
      const Float3 specular{glm::vec3(data_.specularGlossiness)};
      metallic = metallicOf(color, specular);
      color = baseColorOf(color, specular, metallic);
      roughness = 1.0f - data_.specularGlossiness.w;
    }
    s.emission = Float3(glm::vec3(data_.emissiveFactor));
    s.unlit = maskOf(material_.unlit ? 0xffffu : 0u);
    if (material_.unlit) {
      s.emission = color;
    } else if (material_.transmission > 0) {
      // The diffuse part gives way to the surroundings behind, unshadowed and unbent.
      const Float passing = data_.passing.x * (1.0f - metallic);
      const Float3 behind = Float3(glm::vec3(frame_.ambient)) * radianceAround(-toEye.y, roughness);
      s.emission += color * passing * behind;
      color *= mix(Float(1.0f), metallic, passing);
    }
    s.baseColor = clamp(color, 0.0f, 1.0f);
    s.metallic = clamp(metallic, 0.0f, 1.0f);
    s.roughness = clamp(roughness, 0.0f, 1.0f);
    s.occlusion = 1.0f;
  }

  const shared::FrameData& frame_;
  const Slot& slot_; ///< the instance's first
  const shared::InstanceData& placed_;
  const Material& material_;
  const shared::MaterialData& data_;
  Corners corners_;
  Sight sight_;
  Triangle triangle_; ///< relative to the eye
  Meeting meeting_;
};

/// Lanes that show one instance are worked on together; a packet mostly shows one.
HWY_INLINE Surface surfaceOf(const FrameScene& scene, const Fragments& fragments) {
  static_assert(kClusterTriangles == 1 << 10);
  alignas(64) std::int32_t slots[kLanes];
  const Int slot = shiftRightUnsigned<10>(fragments.triangle);
  store(slot, slots);
  alignas(64) std::int32_t triangles[kLanes];
  store(fragments.triangle, triangles);
  Surface surface{};
  surface.receiver.shown = fragments.shown;
  surface.receiver.place = fragments.place;
  unsigned left = bitsOf(fragments.shown);
  for (bool first = true; left != 0; first = false) {
    const auto lane = static_cast<std::size_t>(__builtin_ctz(left));
    const std::uint32_t instance = scene.slots[static_cast<std::size_t>(slots[lane])].instance;
    const auto begin = static_cast<std::int32_t>(scene.geometry.firstSlot[instance]);
    const auto end = static_cast<std::int32_t>(scene.geometry.firstSlot[instance + 1]);
    const Mask own = fragments.shown & (slot >= Int(begin)) & (slot < Int(end));
    // What the other lanes show is no triangle of this instance.
    const Int triangle = select(own, fragments.triangle, Int(triangles[lane])) - shiftLeft<10>(Int(begin));
    const Surface found = InstanceSurface(scene, instance, triangle, fragments).surface(fragments);
    surface = first ? found : select(own, found, surface);
    left &= ~bitsOf(own);
  }
  return surface;
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
