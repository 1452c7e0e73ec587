#pragma once

#include <string_view>

#include "server/frames/services.h"
#include "server/http/http_service.h"
#include "server/http/router.h"

namespace gnomon {

/// Every route that the server has. `services` outlives them.
std::vector<Route> makeRoutes(Services& services);

/// What the sockets' side calls: finds the route, checks what the head tells, and answers problems for the rest.
HttpService makeService(Services& services);

} // namespace gnomon
