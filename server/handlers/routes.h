#pragma once

#include "server/handlers/handlers.h"
#include "server/http/connection.h"
#include "server/http/router.h"

namespace gnomon {

/// Every route that the server has. `services` outlives them.
std::vector<Route> makeRoutes(Services& services);

/// What connections call: finds the route, checks the type of the body, and refuses other requests.
HttpService makeService(Services& services);

} // namespace gnomon
