#include "renderer/frame/measured_shadow.h"

#include <algorithm>

#include "renderer/reference/error_measures.h"

namespace gnomon {

Result<MeasuredShadow> measureShadow(const ResolvedFrame& frame, const TracedScene& traced, int light,
                                     std::vector<float> shown) {
  const FrameSpec& spec = frame.spec;
  std::vector<int> lights;
  int samples = kReferenceSamples;
  if (light >= 0) {
    lights.push_back(light);
    samples = std::max(samples, (*spec.lights)[static_cast<std::size_t>(light)].shadow->raySamples);
  }
  const TraceInput input{traced, frame.view, spec.width, spec.height, *spec.lights, frame.nodes};
  auto truth = traceReference(input, lights, samples);
  if (!truth) return truth.problems();
  const auto errors = measureErrors(*truth, std::span(&shown, lights.size()));
  return MeasuredShadow{std::move(*truth), std::move(shown), errors};
}

} // namespace gnomon
