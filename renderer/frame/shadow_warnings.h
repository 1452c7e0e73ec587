#pragma once

#include <optional>
#include <span>
#include <string>

#include "protocol/report/frame_report.h"
#include "renderer/bake/light_map_layout.h"
#include "renderer/resolve/resolve_frame.h"
#include "renderer/shadow/shadow_plan.h"

/// Warnings about one light's shadow. Nothing where a rule does not apply.
namespace gnomon {

/// Pixels that a texel may span before a frame warns: of a shadow map, whose filters hide some of it, and of a light
/// map.
inline constexpr double kCoarseMapTexel = 16;
inline constexpr double kCoarseLightMapTexel = 8;

/// The light casts shadows, but its map got no texels.
std::optional<std::string> warningOfNoTexel(const PlannedLight& planned);

/// One block of the picture in twenty, or more, reads texels of a map that span more than kCoarseMapTexel pixels.
/// `layered`: lights whose shadow rays draw; a map beside them decides nothing that shows.
std::optional<std::string> warningOfCoarseTexels(const ResolvedFrame& frame, const PlannedLight& planned,
                                                 const std::optional<PredictedError>& error,
                                                 std::span<const int> layered);

/// The same for a light map: its texels, seen straight on, span more than kCoarseLightMapTexel pixels.
std::optional<std::string> warningOfCoarseLightMap(const CameraView& view, const ReceiverDepths& seen, int light,
                                                   const LightMapLayout& layout);

} // namespace gnomon
