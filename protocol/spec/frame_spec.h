#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "protocol/spec/environment_options.h"
#include "protocol/spec/output_options.h"
#include "protocol/spec/scene_options.h"
#include "protocol/spec/shadow_options.h"

/// Rows of the fields: field_rows.h.
namespace gnomon {

struct Ambient {
  Vec3 color{1, 1, 1};
  double intensity = 0.6; ///< mean radiance above, weighted by the cosine, in the unit of the lights

  bool operator==(const Ambient&) const = default;
};

struct Background {
  Vec3 color{0.60, 0.66, 0.74};
  double alpha = 1;

  bool operator==(const Background&) const = default;
};

/// The moment of one of the file's animations. Neither index nor name: the file's rest pose.
struct AnimationMoment {
  std::optional<int> index{};
  std::optional<std::string> name{};
  double timeSeconds = 0;

  bool operator==(const AnimationMoment&) const = default;
};

struct MotionFrom {
  std::optional<Camera> camera{};
  std::optional<AnimationMoment> animation{};
  std::optional<std::vector<NodeOptions>> nodes{};

  bool operator==(const MotionFrom&) const = default;
};

struct Debug {
  std::optional<std::variant<int, std::string>> light{}; ///< an index, or "environment"
  int tile = 0;
  bool predictEdges = false;

  bool operator==(const Debug&) const = default;
};

/// A quality target instead of explicit settings: exactly one of the two.
struct Quality {
  std::optional<double> maxError{};
  std::optional<double> maxMilliseconds{};

  bool operator==(const Quality&) const = default;
};

/// Everything that a frame depends on besides the scene. JSON keys are the members' names.
struct FrameSpec {
  int width = 1280;
  int height = 720;
  Camera camera;
  std::optional<std::vector<Light>> lights;
  Shadow shadow;
  ShadowLightPolicy shadowLightPolicy = ShadowLightPolicy::all;
  Atlas atlas;
  std::vector<NodeOptions> nodes;
  std::vector<VolumeOptions> volumes;
  std::optional<int> scene;
  std::optional<std::string> materialVariant{};
  std::optional<AnimationMoment> animation{};
  Ambient ambient;
  EnvironmentOptions environment;
  std::optional<Ground> ground{};
  Background background;
  double exposure = 0;
  ToneMapping toneMapping = ToneMapping::neutral;
  Antialiasing antialiasing = Antialiasing::msaa4x;
  std::vector<View> views{View::color};
  std::optional<MotionFrom> motionFrom;
  std::optional<SunHours> sunHours{};
  Debug debug;
  std::optional<Quality> quality;
  DeviceChoice device = DeviceChoice::auto_; ///< effective: what drew
  Output output;

  bool operator==(const FrameSpec&) const = default;
};

} // namespace gnomon
