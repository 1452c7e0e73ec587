#pragma once

#include <string>

#include "server/redis/reply.h"

/// What a store in Redis is made of, and the steps that change it, each of which happens whole or not at all.
///
///   gnomon:scene:ID      hash: `parts` (token of its parts), `bytes`, `count` (of parts)
///   gnomon:summary:ID    its summary's text
///   gnomon:part:TOKEN:N  the N-th piece of a bundle or light map, from 0; until all are there, they expire
///   gnomon:scenes        sorted set: every id, all of one score
///   gnomon:used          sorted set: every id by the time of its last use, milliseconds
///   gnomon:bytes         bytes of all bundles
///   gnomon:writing       sorted set: "TOKEN:BYTES" of what is being written, by when it expires, milliseconds
///   gnomon:map:KEY       hash of a light map, as that of a scene
///   gnomon:maps          sorted set: every light map's key by the time of its last use
///   gnomon:maps:bytes    bytes of all light maps
///
/// Times are those of the Redis server. The id of each removed scene is published on a channel.
namespace gnomon {

inline const std::string kScenesKey = "gnomon:scenes";
inline const std::string kUsedKey = "gnomon:used";
inline const std::string kBytesKey = "gnomon:bytes";
inline const std::string kWritingKey = "gnomon:writing";

inline std::string sceneKey(const std::string& id) {
  return "gnomon:scene:" + id;
}
inline std::string summaryKey(const std::string& id) {
  return "gnomon:summary:" + id;
}
inline std::string lightMapKey(const std::string& key) {
  return "gnomon:map:" + key;
}

} // namespace gnomon

namespace gnomon::redis_scripts {

/// KEYS: scene, used, bytes, writing. ARGV: id, "TOKEN:BYTES" or nothing, bytes, quota (0 = none), milliseconds.
/// {1, taken}: the scene is there, and used now. {2, taken}: there is no room. {0, taken}: its parts may be written.
extern const redis::Script kBegin;

/// KEYS: scene, used, bytes, writing, scenes, summary. ARGV: id, "TOKEN:BYTES", token, bytes, count, summary. 1: the
/// scene is there now. 0: it was there, and the parts are removed. An error GONE: parts have expired.
extern const redis::Script kCommit;

/// KEYS: writing. ARGV: "TOKEN:BYTES", token, count. Removes the parts.
extern const redis::Script kAbandon;

/// KEYS: scene, summary. ARGV: summary. Replaces it where the scene is there.
extern const redis::Script kKeepSummary;

/// ARGV: ids. Marks them as used now. The ids that are not there.
extern const redis::Script kUse;

/// ARGV: id, channel. 1, or 0 where it was not there.
extern const redis::Script kRemove;

/// ARGV: milliseconds. How many scenes were not used for so long, and how many there are.
extern const redis::Script kCountUnused;

/// ARGV: milliseconds, channel, the most ids. Removes scenes that were not used for so long. Their ids.
extern const redis::Script kRemoveUnused;

/// KEYS: light map. ARGV: key, token, bytes, count, budget. Keeps a light map, and drops those that were not used for
/// longest, down to the budget. Where it is there already, or its parts have expired, the parts are removed.
extern const redis::Script kCommitMap;

/// ARGV: key. Marks a light map as used now.
extern const redis::Script kUseMap;

/// ARGV: scene's id. Removes the light maps of a scene.
extern const redis::Script kRemoveMaps;

} // namespace gnomon::redis_scripts
