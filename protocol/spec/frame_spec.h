#pragma once

#include <optional>
#include <string>
#include <vector>

#include "protocol/spec/output_options.h"
#include "protocol/spec/scene_options.h"
#include "protocol/spec/shadow_options.h"
#include "protocol/spec/volume_options.h"

namespace gnomon {

/// Light of the surroundings: a neutral studio, brighter above (+Y) than at the sides and below.
struct Ambient {
  Vec3 color{1, 1, 1};    ///< linear RGB, 0..1
  double intensity = 0.3; ///< mean radiance above, weighted by the cosine, in the unit of the lights

  bool operator==(const Ambient&) const = default;
};

/// What stands where no surface is. Neither exposed nor tone mapped.
struct Background {
  Vec3 color{0.60, 0.66, 0.74}; ///< linear RGB, 0..1
  double alpha = 1;             ///< 0..1

  bool operator==(const Background&) const = default;
};

/// The moment of one of the file's animations. Neither index nor name: the file's rest pose.
struct AnimationMoment {
  std::optional<int> index{};        ///< into the file's animations
  std::optional<std::string> name{}; ///< of an animation, instead of its index; the first of that name
  double timeSeconds = 0;            ///< before its first and after its last keyframe, a channel holds that one's value

  bool operator==(const AnimationMoment&) const = default;
};

/// What view `motion` compares with. What is absent is as in the frame itself.
struct MotionFrom {
  std::optional<Camera> camera{};
  std::optional<AnimationMoment> animation{};
  std::optional<std::vector<NodeOptions>> nodes{}; ///< places alone

  bool operator==(const MotionFrom&) const = default;
};

/// What the debug views show.
struct Debug {
  std::optional<int> light{}; ///< index into the lights; absent = the first that casts in this frame, or else the first
  int tile = 0;               ///< of that light: a cascade, or a face
  bool predictEdges = false;  ///< the report says how far the edges of its shadow are expected to be off

  bool operator==(const Debug&) const = default;
};

/// What the shadows of a frame shall be, instead of how: exactly one of the two.
struct Quality {
  std::optional<double> maxError{}; ///< share of misclassified receivers, 0..1: the cheapest settings that hold it
  std::optional<double> maxMilliseconds{}; ///< of a whole warm frame: the most exact settings that fit into it

  bool operator==(const Quality&) const = default;
};

/// Everything that a frame depends on besides the scene. JSON keys are the members' names.
struct FrameSpec {
  int width = 1280; ///< pixels
  int height = 720; ///< pixels
  Camera camera;
  std::optional<std::vector<Light>> lights; ///< absent = the scene's own; if it has none, one sun
  Shadow shadow;                            ///< for every light without a shadow of its own
  ShadowLightPolicy shadowLightPolicy = ShadowLightPolicy::all;
  Atlas atlas;
  std::vector<NodeOptions> nodes;               ///< of two for one node the later one counts
  std::vector<VolumeOptions> volumes;           ///< clouds, smoke and fog
  std::optional<int> scene;                     ///< index of the glTF scene; absent = the file's default
  std::optional<std::string> materialVariant{}; ///< of KHR_materials_variants, by name; absent = the materials as given
  std::optional<AnimationMoment> animation{};   ///< absent = the file's rest pose
  Ambient ambient;
  Background background;
  double exposure = 0; ///< stops; light is multiplied by 2^exposure before tone mapping
  ToneMapping toneMapping = ToneMapping::aces;
  Antialiasing antialiasing = Antialiasing::msaa4x;
  std::vector<View> views{View::color}; ///< at least one, each once
  std::optional<MotionFrom> motionFrom; ///< needed by view `motion` alone
  Debug debug;
  std::optional<Quality> quality;            ///< technique, cascades, sizes and filters are chosen so that it holds
  DeviceChoice device = DeviceChoice::auto_; ///< effective: what drew
  Output output;

  bool operator==(const FrameSpec&) const = default;
};

} // namespace gnomon
