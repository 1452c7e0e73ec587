#pragma once

#include <algorithm>
#include <string>

#include "renderer/reference/reference.h"
#include "renderer/resolve/resolve_frame.h"
#include "tests/renderer/frame_fixture.h"

namespace gnomon::testing {

/// What rays say of light 0 of a frame, at the pixels' centres, for a light taken as a point.
inline LightReference truthOf(const ScenePtr& scene, const std::string& json, int samples = 1) {
  const auto spec = decodeFrameSpec(json);
  const auto frame = resolveFrame(*scene, *spec);
  const auto traced = TracedScene::build(scene, frame->scene);
  const TraceInput input{*traced, frame->view, spec->width, spec->height, *frame->spec.lights, frame->nodes};
  const int first[] = {0};
  auto reference = traceReference(input, first, samples);
  EXPECT_TRUE(reference);
  return reference ? std::move(reference->lights[0]) : LightReference{};
}

/// How many receivers a shadow view tells wrong.
struct Misclassified {
  std::size_t wrong = 0;
  std::size_t receivers = 0;
};

inline Misclassified misclassified(const std::vector<float>& shown, const LightReference& truth) {
  Misclassified count;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (truth.receiver[i] == 0) continue;
    ++count.receivers;
    if ((shown[i] >= 0.5f) != (truth.visibility[i] >= 0.5f)) ++count.wrong;
  }
  return count;
}

} // namespace gnomon::testing
