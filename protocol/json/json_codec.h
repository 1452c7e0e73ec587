#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocol/base/result.h"
#include "protocol/json/json_source.h"
#include "protocol/report/capabilities.h"
#include "protocol/report/frame_report.h"
#include "protocol/report/replies.h"
#include "protocol/report/scene_summary.h"
#include "protocol/spec/frame_spec.h"

namespace gnomon {

/// A FrameSpec from untrusted JSON. Depth is bounded before parsing; unknown and duplicate keys, wrong types,
/// NaN and values out of range are all reported, each with its JSON pointer. Cross-field rules included (validate.h).
Result<FrameSpec> decodeFrameSpec(std::string_view json);

/// The same from a decoded query string: keys are dotted paths ("camera.orbit.azimuthDegrees"), values are JSON or
/// bare words; short forms: sun=AZIMUTH,ELEVATION; view=NAME; format=png|exr. Pointers name the query key.
Result<FrameSpec> decodeFrameQuery(const std::vector<std::pair<std::string, std::string>>& query);

Json toJson(const FrameSpec& spec); ///< fixed key order; reading it back gives the same spec
Json toJson(const FrameReport& report);
Json toJson(const PlanReport& report);
Json toJson(const SceneSummary& summary);
Json toJson(const RendererInfo& info);
Json toJson(const FrameReply& reply);
Json toJson(const SceneList& list);
Json toJson(const Capabilities& capabilities);

} // namespace gnomon
