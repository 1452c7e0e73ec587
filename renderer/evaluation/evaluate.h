#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "protocol/base/result.h"
#include "protocol/evaluation/evaluation.h"
#include "renderer/core/stop.h"
#include "renderer/frame/frame.h"

/// Speed against error, over whatever draws frames. Part of the door: see render.h.
namespace gnomon {

class EnvironmentCache;

/// How a frame's shadows hold still on surfaces along a path of cameras.
struct Shimmer {
  std::size_t points = 0;  ///< watched: world-fixed, of surfaces; counted for every light they face whose shadow shows
  std::size_t steps = 0;   ///< from one camera of the path to the next
  std::uint64_t flips = 0; ///< points that went from lit (S >= 0.5) to shadowed or back in one step

  /// Flips in 1,000 points and a frame. The truth has none to take off: neither surfaces nor lights move.
  double perThousand() const {
    return 1000.0 * static_cast<double>(flips) / (static_cast<double>(points) * static_cast<double>(steps));
  }
};

/// Draws a frame with TileUse::drawnAnew. A problem of code busy, unavailable, deadlineExceeded or internal ends the
/// evaluation; any other is the variant's own.
using DrawFrame = std::function<Result<Frame>(const FrameSpec&)>;

/// Flips of a frame's shadows in 1,000 points and a frame along cameras (Renderer::shimmer), with the same problems.
using MeasureShimmer =
    std::function<Result<double>(const FrameSpec&, std::span<const Camera> path, const Progress& progress)>;

/// What an evaluation has done for it.
struct EvaluationTools {
  DrawFrame draw;
  MeasureShimmer shimmer{};                         ///< needed where the evaluation has a path
  std::shared_ptr<EnvironmentCache> environments{}; ///< of whatever draws; needed where an environment's share is asked
};

/// Callbacks for the progress of an evaluation; may be empty.
struct EvaluationListener {
  /// Called before every frame, and repeatedly while rays are traced or a path is followed; by one thread at a time,
  /// not always the same. False asks to stop.
  std::function<bool(const EvaluationStep&)> step;
  /// Called for each row once its errors are known, or its problem; times come with the report.
  std::function<void(std::size_t index, const EvaluationRow&)> row;
};

/// Measures every variant: first the error of all, each shadowed light's S read from the view `shadow` at full
/// strength, a sample a pixel, with the maps that the variant's own frame has; then the time of all as they are asked
/// for, warm, in rounds, so that a machine's drift affects all of them equally. Variants that see the same from the
/// same place share one reference. Any thread; the tools are called on it. A variant that cannot be drawn is a row with
/// its problem. Where `debug.light` names the environment, its share is measured and no light's shadow, against
/// kEnvironmentReferenceSamples rays at least; then rows are ranked by rms. A problem of code `unavailable` where the
/// listener asked to stop; problems of the evaluation's own spec point into /spec.
Result<EvaluationReport> evaluate(const std::shared_ptr<const Scene>& scene, const Evaluation& evaluation,
                                  const RendererInfo& renderer, const EvaluationTools& tools,
                                  const EvaluationListener& listener = {});

/// Says of every row whether it is on the front of speed against error: nothing that was measured is faster and has
/// no more of that error, or has less and is no slower. Rows without figures are not.
void markPareto(std::vector<EvaluationRow>& rows, RankedError by = RankedError::misclassified);

} // namespace gnomon
