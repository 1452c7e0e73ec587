#include "server/scenes/redis_scripts.h"

namespace gnomon::redis_scripts {
namespace {

constexpr const char* kCommon = R"lua(
local function now()
  local time = redis.call('TIME')
  return string.format('%.0f', time[1] * 1000 + math.floor(time[2] / 1000))
end
local function eachPart(command, token, count)
  local found = 0
  for i = 0, tonumber(count) - 1 do
    found = found + redis.call(command, 'gnomon:part:' .. token .. ':' .. string.format('%.0f', i))
  end
  return found
end
local function removeScene(id, channel)
  local scene = redis.call('HMGET', 'gnomon:scene:' .. id, 'parts', 'bytes', 'count')
  if not scene[1] then return 0 end
  eachPart('UNLINK', scene[1], scene[3])
  redis.call('DEL', 'gnomon:scene:' .. id, 'gnomon:summary:' .. id)
  redis.call('ZREM', 'gnomon:scenes', id)
  redis.call('ZREM', 'gnomon:used', id)
  redis.call('DECRBY', 'gnomon:bytes', scene[2])
  redis.call('PUBLISH', channel, id)
  return 1
end
local function removeMap(key)
  local map = redis.call('HMGET', 'gnomon:map:' .. key, 'parts', 'bytes', 'count')
  redis.call('ZREM', 'gnomon:maps', key)
  if not map[1] then return end
  eachPart('UNLINK', map[1], map[3])
  redis.call('DEL', 'gnomon:map:' .. key)
  redis.call('DECRBY', 'gnomon:maps:bytes', map[2])
end
)lua";

redis::Script with(const char* text) {
  return redis::Script(std::string(kCommon) + text);
}

} // namespace

const redis::Script kBegin = with(R"lua(
if redis.call('EXISTS', KEYS[1]) == 1 then
  redis.call('ZADD', KEYS[2], 'XX', now(), ARGV[1])
  return {1, 0}
end
redis.call('ZREMRANGEBYSCORE', KEYS[4], '-inf', '(' .. now())
local taken = tonumber(redis.call('GET', KEYS[3]) or '0')
for _, entry in ipairs(redis.call('ZRANGE', KEYS[4], 0, -1)) do
  taken = taken + tonumber(string.match(entry, ':(%d+)$') or '0')
end
if tonumber(ARGV[4]) > 0 and taken + tonumber(ARGV[3]) > tonumber(ARGV[4]) then return {2, taken} end
if ARGV[2] ~= '' then redis.call('ZADD', KEYS[4], now() + tonumber(ARGV[5]), ARGV[2]) end
return {0, taken}
)lua");

const redis::Script kCommit = with(R"lua(
redis.call('ZREM', KEYS[4], ARGV[2])
if redis.call('EXISTS', KEYS[1]) == 1 then
  eachPart('UNLINK', ARGV[3], ARGV[5])
  redis.call('ZADD', KEYS[2], 'XX', now(), ARGV[1])
  return 0
end
if eachPart('PERSIST', ARGV[3], ARGV[5]) ~= tonumber(ARGV[5]) then
  eachPart('UNLINK', ARGV[3], ARGV[5])
  return redis.error_reply('GONE Parts of the scene have expired.')
end
redis.call('HSET', KEYS[1], 'parts', ARGV[3], 'bytes', ARGV[4], 'count', ARGV[5])
redis.call('SET', KEYS[6], ARGV[6])
redis.call('ZADD', KEYS[5], 0, ARGV[1])
redis.call('ZADD', KEYS[2], now(), ARGV[1])
redis.call('INCRBY', KEYS[3], ARGV[4])
return 1
)lua");

const redis::Script kAbandon = with(R"lua(
eachPart('UNLINK', ARGV[2], ARGV[3])
return redis.call('ZREM', KEYS[1], ARGV[1])
)lua");

const redis::Script kKeepSummary = with(R"lua(
if redis.call('EXISTS', KEYS[1]) == 0 then return 0 end
redis.call('SET', KEYS[2], ARGV[1])
return 1
)lua");

const redis::Script kUse = with(R"lua(
local missing = {}
for _, id in ipairs(ARGV) do
  if redis.call('EXISTS', 'gnomon:scene:' .. id) == 1 then
    redis.call('ZADD', 'gnomon:used', 'XX', now(), id)
  else
    missing[#missing + 1] = id
  end
end
return missing
)lua");

const redis::Script kRemove = with("return removeScene(ARGV[1], ARGV[2])");

const redis::Script kCountUnused = with(R"lua(
local last = string.format('%.0f', now() - tonumber(ARGV[1]))
return {redis.call('ZCOUNT', 'gnomon:used', '-inf', '(' .. last), redis.call('ZCARD', 'gnomon:used')}
)lua");

const redis::Script kRemoveUnused = with(R"lua(
local last = string.format('%.0f', now() - tonumber(ARGV[1]))
local ids = redis.call('ZRANGEBYSCORE', 'gnomon:used', '-inf', '(' .. last, 'LIMIT', 0, ARGV[3])
for _, id in ipairs(ids) do
  if removeScene(id, ARGV[2]) == 0 then redis.call('ZREM', 'gnomon:used', id) end
end
return ids
)lua");

const redis::Script kCommitMap = with(R"lua(
if redis.call('EXISTS', KEYS[1]) == 1 or eachPart('PERSIST', ARGV[2], ARGV[4]) ~= tonumber(ARGV[4]) then
  eachPart('UNLINK', ARGV[2], ARGV[4])
  return 0
end
redis.call('HSET', KEYS[1], 'parts', ARGV[2], 'bytes', ARGV[3], 'count', ARGV[4])
redis.call('ZADD', 'gnomon:maps', now(), ARGV[1])
local taken = redis.call('INCRBY', 'gnomon:maps:bytes', ARGV[3])
while taken > tonumber(ARGV[5]) do
  local oldest = redis.call('ZRANGE', 'gnomon:maps', 0, 0)[1]
  if not oldest then break end
  removeMap(oldest)
  taken = tonumber(redis.call('GET', 'gnomon:maps:bytes'))
end
return 1
)lua");

const redis::Script kUseMap = with("return redis.call('ZADD', 'gnomon:maps', 'XX', now(), ARGV[1])");

const redis::Script kRemoveMaps = with(R"lua(
for _, key in ipairs(redis.call('ZRANGE', 'gnomon:maps', 0, -1)) do
  if string.sub(key, 1, 65) == ARGV[1] .. '-' then removeMap(key) end
end
return 1
)lua");

} // namespace gnomon::redis_scripts
