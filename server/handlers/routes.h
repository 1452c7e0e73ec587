#pragma once

#include "server/handlers/handlers.h"
#include "server/http/connection.h"
#include "server/http/router.h"

namespace gnomon {

/// The addresses of a server's state.
enum class Addresses {
  one, ///< beside everything else
  two  ///< at an address of its own; probes are answered at both
};

/// Every route for clients. `services` outlives them.
std::vector<Route> makeRoutes(Services& services, Addresses addresses = Addresses::one);

/// The routes of the second address.
std::vector<Route> makeAdminRoutes(Services& services);

/// What connections call: finds the route, checks the type of the body, and refuses other requests.
HttpService makeService(std::vector<Route> routes);

} // namespace gnomon
