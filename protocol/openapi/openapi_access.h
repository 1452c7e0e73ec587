#pragma once

#include "protocol/base/json.h"

namespace gnomon::openapi {

/// The two kinds of credentials: components/securitySchemes.
Json securitySchemes();

/// The paths with what each operation needs where the server has keys, and with the replies that refuse a request
/// because of the client's key or address.
Json withAccess(Json paths);

} // namespace gnomon::openapi
