#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "protocol/base/result.h"
#include "protocol/cost/frame_cost.h"
#include "protocol/spec/frame_spec.h"
#include "protocol/spec/output_options.h"
#include "server/http/multipart.h"

/// The form that Drake's RenderEngineGltfClient posts (its "glTF Render Client-Server API").
namespace gnomon {

enum class DrakeImage { color, depth, label };

/// A form whose fields are all there, each once, in range, and agree with each other.
struct DrakeForm {
  std::string_view scene; ///< a glTF; a view of the request's body
  DrakeImage image = DrakeImage::color;
  int width = 0;  ///< pixels
  int height = 0; ///< pixels
  Intrinsics lens;
  std::optional<SensorRange> range; ///< of depth
};

/// Every problem, each with the name of its field.
Result<DrakeForm> readDrakeForm(const std::vector<FormPart>& parts);

/// What color pictures are drawn with unless the operator says otherwise: the world's z axis points up; a sun that
/// throws shadows, light from all around, and no tone mapping.
FrameSpec drakeDefaults();

/// The frame that the form asks for, seen from the node that Drake names "Camera Node". `colors`: how those are drawn.
FrameSpec drakeFrame(const DrakeForm& form, const FrameSpec& colors);

/// What the form's scene brings to its frame, by its bytes alone: as many triangles as VTK's exporter fits into them.
SceneCounts likelyCounts(std::size_t sceneBytes);

/// A spec for colors as an operator writes it: a FrameSpec without what each form brings itself.
Result<FrameSpec> readDrakeSpec(std::string_view json);

} // namespace gnomon
