#pragma once

#include "server/handlers/services.h"
#include "server/http/router.h"

namespace gnomon {

HttpReply postScene(Services& services, RouteCall call);   ///< POST /v1/scenes
HttpReply putScene(Services& services, RouteCall call);    ///< PUT /v1/scenes/{id}
HttpReply listScenes(Services& services, RouteCall call);  ///< GET /v1/scenes
HttpReply getScene(Services& services, RouteCall call);    ///< GET /v1/scenes/{id}
HttpReply deleteScene(Services& services, RouteCall call); ///< DELETE /v1/scenes/{id}

} // namespace gnomon
