#pragma once

#include "server/handlers/services.h"
#include "server/http/router.h"

namespace gnomon {

HttpReply postFrame(Services& services, RouteCall call);  ///< POST /v1/scenes/{id}/frames
HttpReply getFrame(Services& services, RouteCall call);   ///< GET /v1/scenes/{id}/frame?…
HttpReply postPlan(Services& services, RouteCall call);   ///< POST /v1/scenes/{id}/plan
HttpReply renderOnce(Services& services, RouteCall call); ///< POST /v1/render

} // namespace gnomon
