// Calls of the functions that shaders share with C++: one text, compiled for one number at a time and for lanes. Each
// takes numbers from -1 to 1 and gives three.

/// -1..1 to 0..1.
template <class Number>
Number share(const Number& number) {
  return number * 0.5f + 0.5f;
}

template <class Columns>
SurfacePoint pointOf(const Columns& in) {
  const vec3 color = in.three(0) * 0.5f + vec3(0.5f);
  // Smoother than this, rounding shows in the highlight.
  return surfacePoint(color, share(in.one(3)), 0.2f + 0.8f * share(in.one(4)), normalize(in.three(5)),
                      normalize(in.three(8)));
}

struct Reflected {
  template <class Columns>
  static vec3 of(const Columns& in) {
    return reflectedRadiance(pointOf(in), normalize(in.three(11)));
  }
};

struct Ambient {
  template <class Columns>
  static vec3 of(const Columns& in) {
    return evenStudioReflected(pointOf(in), vec4(1.0f, 0.5f, 0.25f, 0.75f));
  }
};

struct Lamps {
  template <class Columns>
  static vec3 of(const Columns& in) {
    const vec3 color = in.three(0) * 0.5f + vec3(0.5f);
    return studioReflected(vec2(Real(0.6f), Real(0.8f)), 1, pointOf(in), color, share(in.one(3)), share(in.one(4)),
                           normalize(in.three(11)), vec4(share(in.one(14)), Real(0.5f), Real(1.0f), share(in.one(15))));
  }
};

template <int type>
struct Arriving {
  template <class Columns>
  static vec3 of(const Columns& in) {
    LightData light{};
    light.type = type;
    light.direction = {0.6f, 0.0f, 0.8f};
    light.position = {0.5f, -0.25f, 3.0f};
    light.range = 4.0f;
    light.radiance = {3.0f, 2.0f, 1.0f};
    light.coneScale = 4.0f;
    light.coneOffset = -1.0f;
    vec3 toLight;
    const vec3 arriving = irradiance(light, in.three(0), toLight);
    return arriving + toLight;
  }
};

struct Tone {
  template <class Columns>
  static vec3 of(const Columns& in) {
    const vec3 radiance = in.three(0) * 4.0f + vec3(4.0f);
    const SeenLight seen = seenBehind(seenLight(radiance, vec3(0.5f), 0.5f), radiance, 0.25f);
    return shownColor(seen, 0.5f, GNOMON_TONE_ACES) + toneMapped(radiance, GNOMON_TONE_CLIP) + vec3(seen.alpha);
  }
};

struct Caught {
  template <class Columns>
  static vec3 of(const Columns& in) {
    const CaughtLight sun = caughtFrom(normalize(in.three(0)), normalize(in.three(3)), vec3(2.0f, 1.0f, 3.0f),
                                       vec3(share(in.one(6)), share(in.one(7)), share(in.one(8))));
    const CaughtLight sky = caughtAround(vec3(0.5f), vec3(share(in.one(9))));
    const SeenLight behind = seenLight(vec3(2.0f), vec3(0.5f), share(in.one(10)));
    const SeenLight seen = seenThroughCatcher(behind, caughtLight(sun.all + sky.all, sun.lost + sky.lost));
    return seen.radiance + seen.color + vec3(seen.alpha);
  }
};

template <int tone>
struct Mapped {
  template <class Columns>
  static vec3 of(const Columns& in) {
    const Real brightness = exp2(in.one(3) * 10.0f);
    return toneMapped((in.three(0) * 0.5f + vec3(0.5f)) * brightness, tone);
  }
};

struct Heat {
  template <class Columns>
  static vec3 of(const Columns& in) {
    return heat(in.one(0) * 1.5f);
  }
};

struct Glossy {
  template <class Columns>
  static vec3 of(const Columns& in) {
    const vec3 diffuse = in.three(0) * 0.5f + vec3(0.5f);
    const vec3 specular = in.three(3) * 0.5f + vec3(0.5f);
    return baseColorOf(diffuse, specular, metallicOf(diffuse, specular));
  }
};

struct Octahedral {
  template <class Columns>
  static vec3 of(const Columns& in) {
    return fromOctahedral(octahedral(in.three(0)));
  }
};

struct Environment {
  template <class Columns>
  static vec3 of(const Columns& in) {
    const vec3 color = in.three(0) * 0.5f + vec3(0.5f);
    return environmentReflected(cpu::wavyEnvironment(), vec2(Real(0.6f), Real(0.8f)), pointOf(in), color,
                                share(in.one(3)), share(in.one(4)), normalize(in.three(11)),
                                vec4(share(in.one(14)), Real(0.5f), Real(1.0f), share(in.one(15))));
  }
};

struct ByTangent {
  template <class Columns>
  static vec3 of(const Columns& in) {
    return bentByTangent(normalize(in.three(0)), in.three(3), select(in.one(6) < 0.0f, Real(-1.0f), Real(1.0f)),
                         in.three(7));
  }
};

struct BySteps {
  template <class Columns>
  static vec3 of(const Columns& in) {
    return bentBySteps(normalize(in.three(0)), in.three(3), in.three(6), vec2(in.one(9), in.one(10)),
                       vec2(in.one(11), in.one(12)), in.three(13));
  }
};
