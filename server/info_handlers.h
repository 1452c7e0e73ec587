#pragma once

#include "server/router.h"
#include "server/services.h"

namespace gnomon {

HttpReply getCapabilities(Services& services, RouteCall call);
HttpReply getOpenApi(Services& services, RouteCall call);
HttpReply getLivez(Services& services, RouteCall call);  ///< 200 while the process answers at all
HttpReply getReadyz(Services& services, RouteCall call); ///< 503 while draining, or with a queue that is nearly full

/// A handler for one file of the web page.
std::function<HttpReply(RouteCall)> pageHandler(const StaticFile& file);

} // namespace gnomon
