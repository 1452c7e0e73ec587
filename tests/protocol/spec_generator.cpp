#include "tests/protocol/spec_generator.h"

#include <cmath>
#include <cstdint>

#include "protocol/spec/debug_light.h"
#include "protocol/spec/field_rows.h"
#include "protocol/spec/validate.h"
#include "protocol/sun/moment.h"

namespace gnomon {
namespace {

bool flip() {
  return *rc::gen::arbitrary<bool>();
}

int pick(int first, int last) {
  return *rc::gen::inRange(first, last + 1);
}

/// A number of the range: its ends, whole numbers, and any bits between.
double pickIn(const Range& range) {
  constexpr std::int64_t kSteps = std::int64_t{1} << 53;
  const double share = static_cast<double>(*rc::gen::inRange<std::int64_t>(0, kSteps + 1)) / double(kSteps);
  const double between = range.min + (range.max - range.min) * share;
  const double value = pick(0, 9) == 0 ? (flip() ? range.min : range.max) : flip() ? std::round(between) : between;
  return range.contains(value) ? value : (range.min + range.max) / 2;
}

template <class T>
struct Any;

template <class T>
T any(const Notes& notes) {
  return Any<T>::make(notes);
}

template <>
struct Any<bool> {
  static bool make(const Notes& notes) { return notes.onlyTrue || flip(); }
};
template <>
struct Any<int> {
  static int make(const Notes& notes) {
    if (notes.choices.count > 0) return notes.choices.values[pick(0, static_cast<int>(notes.choices.count) - 1)];
    return pick(static_cast<int>(notes.range.min), static_cast<int>(notes.range.max));
  }
};
template <>
struct Any<double> {
  static double make(const Notes& notes) { return pickIn(notes.range); }
};
template <>
struct Any<std::string> {
  static std::string make(const Notes&) {
    const std::vector<std::string> words = {"a",        "Camera 1", "\"quoted\" \\ / ~", "\u00e9\u4e2d\U0001F600",
                                            "\n\t\x01", "0"};
    return *rc::gen::elementOf(words);
  }
};
template <Spelled T>
struct Any<T> {
  static T make(const Notes&) { return static_cast<T>(pick(0, static_cast<int>(kSpellings<T>.size()) - 1)); }
};
template <class T>
struct Any<std::optional<T>> {
  static std::optional<T> make(const Notes& notes) { return flip() ? std::optional<T>(any<T>(notes)) : std::nullopt; }
};
template <>
struct Any<std::variant<int, std::string>> {
  static std::variant<int, std::string> make(const Notes& notes) {
    if (flip()) return any<int>(notes);
    return any<std::string>(notes);
  }
};
template <class T, std::size_t kSize>
struct Any<std::array<T, kSize>> {
  static std::array<T, kSize> make(const Notes& notes) {
    std::array<T, kSize> elements;
    for (T& element : elements) element = any<T>(notes);
    return elements;
  }
};
template <class T>
struct Any<std::vector<T>> {
  static std::vector<T> make(const Notes& notes) {
    std::vector<T> list;
    const int count =
        pick(static_cast<int>(notes.minCount), static_cast<int>(std::min<std::size_t>(notes.maxCount, 5)));
    while (list.size() < static_cast<std::size_t>(count)) {
      T element = any<T>(Notes{.says = "", .range = notes.range});
      if (notes.distinct && std::find(list.begin(), list.end(), element) != list.end()) continue;
      list.push_back(std::move(element));
    }
    return list;
  }
};
template <Described T>
struct Any<T> {
  static T make(const Notes&) {
    T value;
    forEachField<T>([&]<class F>(const F& field) { value.*field.member = any<typename F::Member>(field.notes); });
    return value;
  }
};

// What follows makes rules across fields hold, by changing as little as they need.

double lengthOf(const Vec3& v) {
  return std::hypot(v[0], v[1], v[2]);
}

void keepOnly(int kept, auto&... alternatives) {
  int index = 0;
  (..., (index++ == kept ? void() : alternatives.reset()));
}

void order(double& lower, double& higher) {
  if (lower > higher) std::swap(lower, higher);
  if (lower == higher) (lower > 0 ? lower : higher) += lower > 0 ? -lower / 2 : 1;
}

void mend(Camera& camera) {
  keepOnly(pick(0, 5), camera.lookAt, camera.orbit, camera.node, camera.fit, camera.pose);
  keepOnly(pick(0, 3), camera.perspective, camera.intrinsics, camera.orthographic);
  if (camera.pose) {
    Rows4 rows{{{0, 0, 1, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}}};
    for (std::size_t i = 0; i < 3; ++i) rows[i][3] = camera.pose->worldFromCamera[i][3];
    camera.pose->worldFromCamera = rows;
  }
  if (camera.lookAt) {
    EyeTarget& look = *camera.lookAt;
    look.target = {look.eye[0] + (look.eye[0] > 0 ? -7.5 : 7.5), look.eye[1], look.eye[2]};
    look.up[0] = 0;
    if (lengthOf(look.up) < 1e-3) look.up = {0, 1, 0};
  }
  if (camera.perspective && camera.perspective->near && camera.perspective->far) {
    order(*camera.perspective->near, *camera.perspective->far);
  }
  if (camera.intrinsics && camera.intrinsics->near && camera.intrinsics->far) {
    order(*camera.intrinsics->near, *camera.intrinsics->far);
  }
  if (camera.orthographic) order(camera.orthographic->near, camera.orthographic->far);
}

void mend(NodeOptions& node) {
  node.node = node.node.value_or(7);
  if (node.matrix) {
    auto& m = *node.matrix;
    m[3] = m[7] = m[11] = 0;
    m[15] = 1;
    node.translation.reset();
    node.rotation.reset();
    node.scale.reset();
  }
  if (node.rotation) (*node.rotation)[3] = 1;
}

void mend(SunHours& hours) {
  hours.latitudeDegrees = hours.latitudeDegrees.value_or(48.1);
  hours.longitudeDegrees = hours.longitudeDegrees.value_or(11.6);
  hours.begin = "2026-06-21T00:00+02:00";
  hours.end = "2026-06-22T00:00+02:00";
  hours.stepMinutes = std::max(hours.stepMinutes, 1.0);
}

void mend(AnimationMoment& moment) {
  keepOnly(pick(0, 2), moment.index, moment.name);
  if (!moment.index && !moment.name) moment.timeSeconds = 0;
}

void mend(MotionFrom& from) {
  if (from.camera) mend(*from.camera);
  if (from.animation) mend(*from.animation);
  if (!from.nodes) return;
  for (NodeOptions& node : *from.nodes) {
    node.visible.reset();
    node.castShadow.reset();
    node.receiveShadow.reset();
    node.layers.reset();
    mend(node);
  }
}

void mend(VolumeOptions& volume) {
  keepOnly(pick(0, 1), volume.box, volume.matrix);
  if (!volume.box && !volume.matrix) volume.box.emplace();
  for (std::size_t axis = 0; volume.box && axis < 3; ++axis) order(volume.box->min[axis], volume.box->max[axis]);
  double value = -5;
  for (TransferStop& stop : volume.transferFunction) stop.value = value += 1.5;
}

void mend(Shadow& shadow, const Atlas& atlas) {
  shadow.partition.splits.clear();
  if (shadow.partition.mode == PartitionMode::manual) {
    for (int i = 1; i <= shadow.cascadeCount; ++i) {
      shadow.partition.splits.push_back((i - 0.5 * pickIn({0, 1})) / shadow.cascadeCount);
    }
  }
  DepthRange& range = shadow.depthRange;
  if (range.mode == DepthRangeMode::manual) {
    range.min = range.min.value_or(0.25);
    range.max = range.max.value_or(99);
    if (*range.min >= *range.max) range.min = *range.max / 2;
  } else {
    range.min.reset();
    range.max.reset();
  }
  if (range.mode == DepthRangeMode::manual) range.previous.reset();
  if (!range.previous) range.guardDistance.reset();
  if (range.previous) order(range.previous->near, range.previous->far);
  const FilterType filter = shadow.filter.type;
  if (filter == FilterType::hard || filter == FilterType::pcss) shadow.filter.radius.reset();
  if (shadow.bias.mode == BiasMode::automatic) shadow.bias = {};
  while (shadow.size && tileSide(*shadow.size, atlas) > atlas.size) {
    shadow.size = static_cast<ShadowSize>(int(*shadow.size) - 1);
  }
}

void mend(Sun& sun) {
  if (flip()) {
    sun.latitudeDegrees.reset();
    sun.longitudeDegrees.reset();
    sun.time.reset();
    sun.northDegrees.reset();
    return;
  }
  sun.azimuthDegrees.reset();
  sun.elevationDegrees.reset();
  sun.latitudeDegrees = sun.latitudeDegrees.value_or(48.1);
  sun.longitudeDegrees = sun.longitudeDegrees.value_or(11.6);
  sun.time = momentText({*rc::gen::inRange<std::int64_t>(-2'208'000'000'000, 4'133'000'000'000), pick(-12, 14) * 60});
}

void mend(Light& light, const Atlas& atlas) {
  const Vec3 down{0.5, -1, 0.25};
  if (light.direction && lengthOf(*light.direction) < 1e-3) light.direction = down;
  if (light.type == LightType::directional) {
    keepOnly(pick(0, 1), light.direction, light.sun);
    if (!light.direction && !light.sun) light.sun.emplace();
    if (light.sun) mend(*light.sun);
    light.position.reset();
    light.range.reset();
    light.radius.reset();
  } else {
    light.sun.reset();
    light.angularDiameterDegrees.reset();
    light.shadow.reset();
    light.position = light.position.value_or(Vec3{1, 2, 3});
    if (light.type == LightType::spot) light.direction = light.direction.value_or(down);
    if (light.type == LightType::point) light.direction.reset();
  }
  if (light.type != LightType::spot) {
    light.innerConeDegrees = Light().innerConeDegrees;
    light.outerConeDegrees = Light().outerConeDegrees;
  }
  if (light.innerConeDegrees >= light.outerConeDegrees) light.innerConeDegrees = light.outerConeDegrees / 2;
  keepOnly(pick(0, 2), light.color, light.temperatureKelvin);
  if (light.shadow) mend(*light.shadow, atlas);
}

} // namespace

rc::Gen<FrameSpec> anySpec() {
  return rc::gen::exec([] {
    FrameSpec spec = any<FrameSpec>(Notes{});
    if (std::int64_t{spec.width} * spec.height > kLimits.maxFramePixels) spec.height /= 8;
    spec.height = std::max(spec.height, 1);
    spec.atlas.baseSize = std::min(spec.atlas.baseSize, spec.atlas.size);
    for (NodeOptions& node : spec.nodes) mend(node);
    if (spec.quality) {
      keepOnly(pick(0, 1), spec.quality->maxError, spec.quality->maxMilliseconds);
      if (!spec.quality->maxError && !spec.quality->maxMilliseconds) spec.quality->maxError = 0.25;
    }
    if (spec.animation) mend(*spec.animation);
    if (spec.motionFrom) mend(*spec.motionFrom);
    std::erase_if(spec.views, [&](View view) { return view == View::motion && !spec.motionFrom; });
    if (spec.sunHours) mend(*spec.sunHours);
    std::erase_if(spec.views, [&](View view) { return view == View::sunHours && !spec.sunHours; });
    if (spec.views.empty()) spec.views = {View::color};
    for (VolumeOptions& volume : spec.volumes) mend(volume);
    keepOnly(pick(0, 2), spec.environment.file, spec.environment.sky, spec.environment.light);
    if (spec.environment.sky) mend(spec.environment.sky->sun);
    mend(spec.camera);
    mend(spec.shadow, spec.atlas);
    if (spec.lights) {
      for (Light& light : *spec.lights) mend(light, spec.atlas);
      const auto shown = debugLightIndex(spec.debug);
      if (shown && *shown >= static_cast<int>(spec.lights->size())) spec.debug.light.reset();
    }
    if (showsEnvironment(spec.debug)) {
      spec.debug.light = kEnvironmentName;
      spec.environment.shadows = EnvironmentShadows::rays;
    }
    return spec;
  });
}

} // namespace gnomon
