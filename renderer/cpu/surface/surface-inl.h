// What sixteen places of the picture show: the surface's place, its normals and its material.
#if defined(GNOMON_CPU_SURFACE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_SURFACE_INL_H
#undef GNOMON_CPU_SURFACE_INL_H
#else
#define GNOMON_CPU_SURFACE_INL_H
#endif

#include "renderer/cpu/lanes/shared_functions-inl.h"
#include "renderer/cpu/surface/fragments-inl.h"
#include "renderer/cpu/surface/smooth_place-inl.h"
#include "renderer/cpu/surface/surroundings-inl.h"
#include "renderer/cpu/surface/texture_spots-inl.h"
#include "renderer/cpu/surface/textures.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// Finite in all lanes; of those that show nothing it means nothing.
struct Surface {
  Receiver receiver;
  Float3 toEye;     ///< unit length
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
  s.receiver.triangle = no.receiver.triangle;
  s.receiver.weights = select(where, yes.receiver.weights, no.receiver.weights);
  s.receiver.smooth = no.receiver.smooth;
  put(where, yes.receiver.smooth, s.receiver.smooth);
  s.toEye = select(where, yes.toEye, no.toEye);
  s.normal = select(where, yes.normal, no.normal);
  s.baseColor = select(where, yes.baseColor, no.baseColor);
  s.metallic = select(where, yes.metallic, no.metallic);
  s.roughness = select(where, yes.roughness, no.roughness);
  s.occlusion = select(where, yes.occlusion, no.occlusion);
  s.emission = select(where, yes.emission, no.emission);
  s.unlit = (where & yes.unlit) | andNot(where, no.unlit);
  return s;
}

/// What triangles of one instance show: their material at pixels' centres, as OpenGL interpolates it, which is written
/// once a pixel; light is asked for where the samples are that show it.
class InstanceSurface {
 public:
  HWY_INLINE InstanceSurface(const FrameScene& scene, const Textures& textures, const OfInstance& own,
                             const Fragments& fragments)
      : scene_(scene),
        frame_(scene.frame),
        textures_(textures),
        own_(own.lanes),
        slot_(scene.slots[scene.geometry.firstSlot[own.instance]]),
        placed_(scene.instances[own.instance]),
        material_(scene.scene.materials[static_cast<std::size_t>(slot_.material)]),
        data_(scene.materials[static_cast<std::size_t>(slot_.material)]),
        tangents_(
            scene.scene.primitives[static_cast<std::size_t>(scene.view.instances[own.instance].primitive)].hasTangents),
        corners_(scene, slot_, own.triangle),
        sight_(sightThrough(scene.frame, fragments.center)) {
    seen_ = corners_.seen(placed_.relativeFromLocal, sight_);
    meeting_ = meetingOf(sight_, seen_);
    findTextureSpots();
  }

  /// Calls each(texture, use, spot) for the textures that the material reads.
  template <class Each>
  HWY_INLINE void forEachTexture(const Each& each) const {
    static_assert(GNOMON_BASE_COLOR_UNIT == 0 && GNOMON_METALLIC_ROUGHNESS_UNIT == 1 && GNOMON_NORMAL_UNIT == 2 &&
                  GNOMON_OCCLUSION_UNIT == 3 && GNOMON_EMISSIVE_UNIT == 4);
    std::size_t unit = 0;
    for (const auto& [use, srgb] : texturesAsRead(material_)) {
      if (*use && (*use)->image >= 0) each(TextureImage{(*use)->image, srgb}, **use, spotOfUse(**use, unit));
      ++unit;
    }
  }

  HWY_INLINE Surface surface(const Fragments& fragments) {
    Surface s;
    s.receiver.shown = fragments.shown;
    const bool central = all((fragments.place.x == fragments.center.x) & (fragments.place.y == fragments.center.y));
    const Sight sight = central ? sight_ : sightThrough(frame_, fragments.place);
    const Meeting meeting = central ? meeting_ : meetingOf(sight, seenAlong(sight));
    s.receiver.relative = sight.origin + sight.way * meeting.depth;
    s.receiver.viewDepth = asSurveyed(frame_, meeting.depth);
    s.receiver.weights = {meeting.u, meeting.v};
    s.receiver.groupBit = Int(1 << static_cast<int>(placed_.receiverGroup()));
    s.receiver.place = fragments.place;
    s.receiver.triangle = fragments.triangle;
    s.toEye = towardsEye(sight, frame_);
    s.receiver.normal = corners_.face(seen_, s.toEye);
    s.receiver.smooth = mayStandOff(scene_, s.receiver, own_)
                            ? smoothPlace(corners_, placed_.normalFromLocal, seen_.triangle, meeting, s.receiver.normal)
                            : noSmoothPlace();
    s.normal = shadingNormal(s.receiver.normal);
    addMaterial(s);
    return s;
  }

 private:
  /// Along another line of sight.
  HWY_INLINE SeenTriangle seenAlong(const Sight& sight) const {
    return sight.spreads ? seen_ : seenFrom(sight.origin - seen_.triangle.corner, seen_.triangle);
  }

  HWY_INLINE void findTextureSpots() {
    const bool used = material_.baseColor || material_.metallicRoughness || material_.normal || material_.occlusion ||
                      material_.emissive;
    if (used) spots_ = spotsOf(corners_, meeting_, steps_ = stepsOf(sight_, seen_, meeting_));
  }

  HWY_INLINE TextureSpot spotOfUse(const TextureUse& use, std::size_t unit) const {
    const TextureSpot& spot = spots_.of[use.texCoord == 0 ? 0 : 1];
    return use.transform ? moved(data_, unit, spot) : spot;
  }
  /// Materials mostly read all their textures in the same way.
  HWY_INLINE const Taps& tapsOf(const Texture& texture, const TextureUse& use, std::size_t unit) {
    const bool same = tapped_ != nullptr && readAlike(*tappedUse_, use) && tapped_->width() == texture.width() &&
                      tapped_->height() == texture.height();
    if (!same) {
      findTaps(texture, use, spotOfUse(use, unit), own_, taps_);
      tapped_ = &texture;
      tappedUse_ = &use;
    }
    return taps_;
  }

  template <unsigned channels>
  HWY_INLINE Texel texel(const TextureUse& use, std::size_t unit, bool srgb) {
    if (use.image < 0) return {Float3(0.0f), Float(1.0f)};
    const Texture& texture = textures_.of(use.image, srgb);
    return sampled<channels>(texture, tapsOf(texture, use, unit));
  }

  HWY_INLINE Float3 shadingNormal(const Float3& face) {
    const Float3 own = corners_.direction(placed_.normalFromLocal, offsetof(VertexAttributes, normal), meeting_, face);
    const Float3 n = material_.doubleSided ? select(dot(own, face) < 0.0f, -own, own) : own;
    return material_.normal ? directionOf(bent(n, *material_.normal), n) : n;
  }

  HWY_INLINE Float3 bent(const Float3& n, const TextureUse& use) {
    Float3 direction = texel<kColor>(use, GNOMON_NORMAL_UNIT, false).rgb * 2.0f - Float3(1.0f);
    direction.x *= data_.normalScale;
    direction.y *= data_.normalScale;
    if (tangents_) {
      const Corners::Fields tangent = corners_.fields(offsetof(VertexAttributes, tangent));
      return bentByTangent(n, turned(placed_.relativeFromLocal, tangent.triple(meeting_)), tangent.of[3].at(meeting_),
                           direction);
    }
    const TextureSpot spot = spotOfUse(use, GNOMON_NORMAL_UNIT);
    const auto movedPlace = [&](const Float2& step)
                                HWY_ATTR { return seen_.triangle.edge1 * step.x + seen_.triangle.edge2 * step.y; };
    return bentBySteps(n, movedPlace(steps_.right), movedPlace(steps_.up), spot.right, spot.up, direction);
  }

  HWY_INLINE Float3 ownColor() {
    Float3 color{glm::vec3(data_.baseColorFactor)};
    if (material_.baseColor) color = color * texel<kColor>(*material_.baseColor, GNOMON_BASE_COLOR_UNIT, true).rgb;
    if (material_.hasVertexColors) color = color * corners_.color(meeting_).rgb;
    return color;
  }

  /// Turns the diffuse color into a base color.
  HWY_INLINE void addGlossiness(Float3& color, Float& metallic, Float& roughness) {
    Float3 specular{data_.specularFactor};
    Float glossiness(data_.glossinessFactor);
    if (material_.metallicRoughness) {
      const Texel factor = texel<kAllChannels>(*material_.metallicRoughness, GNOMON_METALLIC_ROUGHNESS_UNIT, true);
      specular = specular * factor.rgb;
      glossiness *= factor.a;
    }
    metallic = metallicOf(color, specular);
    color = baseColorOf(color, specular, metallic);
    roughness = 1.0f - glossiness;
  }

  HWY_INLINE void addMaterial(Surface& s) {
    Float3 color = ownColor();
    Float metallic(data_.metallicFactor), roughness(data_.roughnessFactor);
    if (material_.specularGlossiness) {
      addGlossiness(color, metallic, roughness);
    } else if (material_.metallicRoughness) {
      const Texel factor = texel<kGreen | kBlue>(*material_.metallicRoughness, GNOMON_METALLIC_ROUGHNESS_UNIT, false);
      metallic *= factor.rgb.z;
      roughness *= factor.rgb.y;
    }
    s.emission = Float3(data_.emissiveFactor);
    if (material_.emissive)
      s.emission = s.emission * texel<kColor>(*material_.emissive, GNOMON_EMISSIVE_UNIT, true).rgb;
    s.unlit = maskOf(material_.unlit ? 0xffffu : 0u);
    if (material_.unlit) {
      s.emission = color;
    } else if (material_.transmission > 0) {
      // The diffuse part gives way to the surroundings behind, unshadowed and unbent.
      const Float passing = data_.transmission * (1.0f - metallic);
      const Float3 behind = radianceOfSurroundings(scene_, -s.toEye, roughness);
      s.emission += color * passing * behind;
      color *= mix(Float(1.0f), metallic, passing);
    }
    s.baseColor = clamp(color, 0.0f, 1.0f);
    s.metallic = clamp(metallic, 0.0f, 1.0f);
    s.roughness = clamp(roughness, 0.0f, 1.0f);
    s.occlusion = 1.0f;
    if (material_.occlusion) {
      const Float open = texel<kRed>(*material_.occlusion, GNOMON_OCCLUSION_UNIT, false).rgb.x;
      s.occlusion = clamp(mix(Float(1.0f), open, data_.occlusionStrength), 0.0f, 1.0f);
    }
  }

  const FrameScene& scene_;
  const shared::FrameData& frame_;
  const Textures& textures_;
  const Mask own_;
  const Slot& slot_; ///< the instance's first
  const shared::InstanceData& placed_;
  const Material& material_;
  const shared::MaterialData& data_;
  const bool tangents_; ///< vertices bring their own
  Corners corners_;
  Sight sight_;
  SeenTriangle seen_; ///< relative to the eye, along sight_
  Meeting meeting_;
  MeetingSteps steps_; ///< where textures are used
  SpotsOfSets spots_;  ///< there, too
  const Texture* tapped_ = nullptr;
  const TextureUse* tappedUse_ = nullptr;
  Taps taps_; ///< of a texture of that size, used so
};

/// Lanes that show something else hold anything.
inline HWY_NOINLINE Surface instanceSurface(const FrameScene& scene, const Textures& textures, const OfInstance& own,
                                            const Fragments& fragments) {
  return InstanceSurface(scene, textures, own, fragments).surface(fragments);
}

/// Lanes that show one instance are worked on together; a packet mostly shows one. REQUIRES: some lane shows one.
HWY_INLINE Surface surfaceOf(const FrameScene& scene, const Textures& textures, const Fragments& fragments) {
  unsigned left = bitsOf(fragments.shown);
  OfInstance own = instanceShown(scene, fragments, left);
  Surface surface = instanceSurface(scene, textures, own, fragments);
  while ((left &= ~bitsOf(own.lanes)) != 0) {
    own = instanceShown(scene, fragments, left);
    surface = select(own.lanes, instanceSurface(scene, textures, own, fragments), surface);
  }
  return surface;
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
