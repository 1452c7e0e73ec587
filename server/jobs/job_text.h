#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "server/jobs/job_queue.h"

/// What a queue keeps as JSON.
namespace gnomon {

std::string textOf(const FrameNote& note);
std::string textOf(const Problems& problems);
std::string textOf(const Carried& carried);

/// Nothing where the text is none of these, or a note's key, times or pictures are none that a frame has.
std::optional<FrameNote> readFrameNote(std::string_view text);
std::optional<Problems> readProblems(std::string_view text);
std::optional<Carried> readCarried(std::string_view text);

} // namespace gnomon
