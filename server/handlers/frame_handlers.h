#pragma once

#include "server/frames/services.h"
#include "server/http/router.h"

namespace gnomon {

HttpReply postFrame(Services& services, RouteCall call);  ///< POST /v1/scenes/{id}/frames
HttpReply getFrame(Services& services, RouteCall call);   ///< GET /v1/scenes/{id}/frame?…
HttpReply renderOnce(Services& services, RouteCall call); ///< POST /v1/render

} // namespace gnomon
