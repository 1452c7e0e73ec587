#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/dispatch/task.h"
#include "server/http/reply.h"

/// What became of a task, as a reply. Pure functions.
namespace gnomon {

/// The result as a reply: the body with its type and room, stages in Server-Timing, warnings in Gnomon-Warnings, or the
/// problems.
HttpReply replyOf(TaskResult result, std::string_view requestId);

/// The value of a Gnomon-Warnings header: a JSON array of strings, in ASCII. Of warnings that would make it longer than
/// kMostWarningBytes, it says only how many there are.
inline constexpr std::size_t kMostWarningBytes = 4096;
std::string warningsField(const std::vector<std::string>& warnings);

/// The body of a result; nothing where the result has problems, or gets one because there is no body.
std::optional<SharedBytes> bodyOf(TaskResult& result);

/// "queue;dur=0.12, load;dur=3.4": the value of a Server-Timing header.
std::string serverTiming(const std::vector<StageTime>& stages);

RefusalReason refusalOf(TaskRefusal refusal);

} // namespace gnomon
