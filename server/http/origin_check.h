#pragma once

#include <string>
#include <vector>

#include "server/http/connection.h"

namespace gnomon {

/// From whose pages a browser may ask, and by which names it may reach the server.
///
/// A browser that is on some page sends that page's requests to any server, one on the loopback interface too. Two
/// checks keep pages away that the operator does not know: of the Host, since a page whose own name has been pointed at
/// this server's address (DNS rebinding) still sends that name; and of the Origin of everything but GET and HEAD.
struct OriginRules {
  /// "render.example", with a port or for every port; "*" = any. Address literals, "localhost" and `bind` need no
  /// mention. Empty while `bind` is a wildcard: any, since such a server is reached by names that it can't know.
  std::vector<std::string> allowedHosts;
  std::vector<std::string> allowedOrigins; ///< "https://page.example", or "*"; their pages may read the replies (CORS)
  std::string bind;
};

/// The service behind those checks: 421 for an unknown Host, 403 for a request that changes something from an unknown
/// page. Probes are answered under any name. Replies to pages of allowed origins say that these may read them, and
/// OPTIONS also what they may ask.
HttpService withOriginCheck(HttpService service, OriginRules rules);

} // namespace gnomon
