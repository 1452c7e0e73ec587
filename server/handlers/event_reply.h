#pragma once

#include <functional>

#include "protocol/base/result.h"
#include "server/http/event_stream.h"
#include "server/http/router.h"

namespace gnomon {

/// Work that puts its progress and its result as events, and returns what became of it. `gone` may be called by any
/// thread; true = the client is gone, and the work should end soon.
using EventWork = std::function<StreamResult(const std::function<bool()>& gone, EventStream& events)>;

/// A reply of events that are sent while `work` runs, on a thread of its own. An exception becomes an event `problem`.
HttpReply eventReply(const RouteCall& call, EventWork work);

/// The data of an event `problem`. `problems` is not empty.
std::string problemText(const Problems& problems, const std::string& requestId);

} // namespace gnomon
