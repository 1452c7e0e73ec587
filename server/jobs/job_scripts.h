#pragma once

#include "server/redis/reply.h"

/// The steps of a queue in Redis, each of which is done whole or not at all.
///
/// Keys, behind "gnomon:jobs:":
///   job:ID           hash: the job and how far it is
///   stream:ID        stream of the frames that wait or are in work, with the consumer group "takers"
///   frame:ID:INDEX   hash: what was drawn, as note and pictures
///   ring             list of sites whose clients have unfinished jobs, the next in turn first
///   ring:SITE        list of these jobs, in the same order
///   client:CLIENT    set of all jobs of a client
///   site:SITE        set of all jobs of the clients of a site
///   key:KEY          sorted set of all jobs of a key, by their number
///   changed          sorted set of all jobs, by the millisecond of their last change
///   count, bytes     numbers given to jobs; bytes that they take
namespace gnomon::job_scripts {

extern const redis::Script kPut;    ///< id, key, client, site, scene, request, first, count, isChained, carried, limits
extern const redis::Script kTake;   ///< consumer, lease, deliveries, age -> a frame, or nil
extern const redis::Script kRenew;  ///< id, entry, consumer -> 1 where the frame is still wanted
extern const redis::Script kFinish; ///< id, entry, index, note, pictures, carried, limit of bytes, no room, no share
extern const redis::Script kFail;   ///< id, entry, index, problems
extern const redis::Script kGiveBack; ///< id, entry, lease, deliveries
extern const redis::Script kFind;     ///< id, age -> the job's fields, or nil
extern const redis::Script kList;     ///< "key:" and a key, or "changed" for all, age -> the fields of each
extern const redis::Script kRemove;   ///< id -> 1 where there was one
extern const redis::Script kSize;     ///< age -> jobs, frames left, bytes

} // namespace gnomon::job_scripts
