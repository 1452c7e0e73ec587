#pragma once

#include <memory>

#include "server/access/key_ring.h"
#include "server/http/connection.h"

namespace gnomon {

/// The service behind a check of its clients' keys. A request whose route needs a scope is answered only where it shows
/// the secret of a key, as `Authorization: Bearer SECRET`: else 401. Where the route takes signed addresses
/// (access_key.h), one of these does as well: 403 where the signature is wrong, or its time is over. 403 where the
/// key does not allow the request, 429 where it has used up what it may. The client of an admitted request is its key's
/// name, and no cache that clients share may keep its reply.
HttpService withAccessCheck(HttpService service, std::shared_ptr<KeyRing> keys);

} // namespace gnomon
