#pragma once

#include "server/frames/services.h"
#include "server/http/router.h"

namespace gnomon {

HttpReply getCapabilities(Services& services, RouteCall call);
HttpReply getOpenApi(Services& services, RouteCall call);
HttpReply getLivez(Services& services, RouteCall call);  ///< 200 while the process answers at all
HttpReply getReadyz(Services& services, RouteCall call); ///< 503 while draining, or with a queue that is nearly full

/// A handler for one file of the web page.
std::function<HttpReply(RouteCall)> pageHandler(const StaticFile& file);

} // namespace gnomon
