#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocol/base/result.h"
#include "protocol/fields/field_codec.h"
#include "protocol/json/json_source.h"
#include "protocol/report/frame_report.h"
#include "protocol/report/replies.h"
#include "protocol/spec/frame_spec.h"

namespace gnomon {

/// A FrameSpec from untrusted JSON. Depth is bounded before parsing; unknown and duplicate keys, wrong types,
/// NaN and values out of range are all reported, each with its JSON pointer. Cross-field rules included (validate.h).
Result<FrameSpec> decodeFrameSpec(std::string_view json);

/// The same from a tree, however that was read; `problems` are those of the reading.
Result<FrameSpec> decodeFrameTree(const JsonNode& root, ProblemList problems);

/// A summary as toJson writes it; members that are absent have their defaults.
Result<SceneSummary> decodeSceneSummary(std::string_view json);

/// One line of JSON. Names in a scene need not be UTF-8: bytes that are not are replaced.
std::string jsonText(const Json& json);

/// The body of application/problem+json (RFC 9457): {type, title, status, detail, instance, problems: [{code, pointer,
/// detail, limit?, actual?}]}. Type and title are the first problem's; `status` is the caller's choice; an empty
/// `instance` is left out. Bytes that are not UTF-8 are replaced. `problems` is not empty.
Json problemJson(const Problems& problems, int status, std::string_view instance);

std::string_view problemName(ProblemCode code);  ///< "invalidValue"
std::string_view problemTitle(ProblemCode code); ///< "Invalid Value"

/// The schema of that body.
Json problemSchema();

/// A FrameSpec from a decoded query string, as strictly as decodeFrameSpec: keys are fields' paths
/// ("camera.orbit.azimuthDegrees", "lights[0].intensity"; see base/json.h) in any order, values are JSON or bare
/// words; short forms: sun=AZIMUTH,ELEVATION or LATITUDE,LONGITUDE TIME; view=NAME; format=png. Pointers name the query
/// key.
Result<FrameSpec> decodeFrameQuery(const std::vector<std::pair<std::string, std::string>>& query);

/// The page as toJson writes it; nothing = it is no page.
std::optional<NodePage> readNodePage(std::string_view json);

/// The report as toJson writes it, whose `chosen` is one of those tried; nothing = it is no such report.
std::optional<QualityReport> readQualityReport(std::string_view json);

} // namespace gnomon
