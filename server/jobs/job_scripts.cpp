#include "server/jobs/job_scripts.h"

#include <string>

namespace gnomon::job_scripts {
namespace {

constexpr const char* kCommon = R"lua(
local P = 'gnomon:jobs:'
local call = redis.call
local function now()
  local time = call('TIME')
  return time[1] * 1000 + math.floor(time[2] / 1000)
end
local function text(number) return string.format('%d', number) end
local function touch(id)
  local time = text(now())
  call('HSET', P .. 'job:' .. id, 'changed', time)
  call('ZADD', P .. 'changed', time, id)
  return time
end
local function leaveRing(id, site)
  call('LREM', P .. 'ring:' .. site, 0, id)
  if call('LLEN', P .. 'ring:' .. site) == 0 then call('LREM', P .. 'ring', 0, site) end
end
local function siteOf(id) -- jobs of earlier versions have none
  return call('HGET', P .. 'job:' .. id, 'site') or call('HGET', P .. 'job:' .. id, 'client')
end
local function finishJob(id, state, problems)
  local time = touch(id)
  call('HSET', P .. 'job:' .. id, 'state', state, 'ended', time, 'problems', problems)
  leaveRing(id, siteOf(id))
  call('UNLINK', P .. 'stream:' .. id)
end
local function removeJob(id)
  local job = call('HMGET', P .. 'job:' .. id, 'client', 'key', 'first', 'count', 'bytes', 'requestBytes', 'site')
  call('ZREM', P .. 'changed', id)
  if not job[1] then return 0 end
  leaveRing(id, job[7] or job[1])
  call('SREM', P .. 'client:' .. job[1], id)
  call('SREM', P .. 'site:' .. (job[7] or job[1]), id)
  call('ZREM', P .. 'key:' .. job[2], id)
  call('DECRBY', P .. 'bytes', text(job[5] + job[6]))
  call('UNLINK', P .. 'job:' .. id, P .. 'stream:' .. id)
  for index = tonumber(job[3]), job[4] - 1 do call('UNLINK', P .. 'frame:' .. id .. ':' .. index) end
  return 1
end
local function removeOld(age)
  local old = call('ZRANGEBYSCORE', P .. 'changed', '-inf', '(' .. text(now() - age), 'LIMIT', 0, 4)
  for _, id in ipairs(old) do removeJob(id) end
end
local function isOpen(id)
  local state = call('HGET', P .. 'job:' .. id, 'state')
  return state == 'queued' or state == 'running'
end
local function settle(id, entry)
  call('XACK', P .. 'stream:' .. id, 'takers', entry)
  call('XDEL', P .. 'stream:' .. id, entry)
end
local function bytesOf(id)
  local job = call('HMGET', P .. 'job:' .. id, 'bytes', 'requestBytes')
  return (job[1] or 0) + (job[2] or 0)
end
local function allBytes() return tonumber(call('GET', P .. 'bytes') or 0) end
local function hasShare(id, client, site, bytes, limit) -- mayTake() of fair_shares.h; `bytes`: all that the job then has
  local taken = allBytes() - bytesOf(id)
  for _, set in ipairs({P .. 'client:' .. client, P .. 'site:' .. site}) do
    local beside = 0
    for _, other in ipairs(call('SMEMBERS', set)) do
      if other ~= id then beside = beside + bytesOf(other) end
    end
    if beside > 0 and beside + bytes > math.floor((limit - taken + beside) * 3 / 4) then return false end
  end
  return true
end
local function fieldsOf(id)
  local fields = call('HMGET', P .. 'job:' .. id, 'key', 'scene', 'state', 'first', 'count', 'done', 'bytes', 'carried',
                      'problems', 'created', 'started', 'changed', 'ended')
  if not fields[1] then return false end
  table.insert(fields, 1, id)
  return fields
end
)lua";

redis::Script script(const char* own) {
  return redis::Script(std::string(kCommon) + own);
}

} // namespace

const redis::Script kPut = script(R"lua(
local id, key, client, site, scene, request, first, count, chained, carried, ofClient, jobs, bytes, age = unpack(ARGV)
removeOld(tonumber(age))
local own, ofSite, taken = call('SCARD', P .. 'client:' .. client), call('SCARD', P .. 'site:' .. site), call('ZCARD', P .. 'changed')
if own >= tonumber(ofClient) then return 'client' end
if taken >= tonumber(jobs) then return 'room' end
if allBytes() + #request > tonumber(bytes) then return 'room' end
if own >= math.max(math.floor((jobs - taken + own) / 2), 1) then return 'share' end
if ofSite >= math.max(math.floor((jobs - taken + ofSite) * 3 / 4), 1) then return 'share' end
if not hasShare(id, client, site, #request, bytes) then return 'bytes' end
local time = touch(id)
call('HSET', P .. 'job:' .. id, 'key', key, 'client', client, 'site', site, 'scene', scene, 'request', request, 'requestBytes', #request,
     'first', first, 'count', count, 'chained', chained, 'carried', carried, 'state', 'queued', 'done', 0, 'bytes', 0,
     'problems', '{"problems":[]}', 'created', time, 'started', 0, 'ended', 0)
call('INCRBY', P .. 'bytes', #request)
call('SADD', P .. 'client:' .. client, id)
call('SADD', P .. 'site:' .. site, id)
call('ZADD', P .. 'key:' .. key, call('INCR', P .. 'count'), id)
call('XGROUP', 'CREATE', P .. 'stream:' .. id, 'takers', '0', 'MKSTREAM')
local last = chained == '1' and tonumber(first) or count - 1
for index = tonumber(first), last do call('XADD', P .. 'stream:' .. id, '*', 'index', index, 'carried', carried) end
if call('LLEN', P .. 'ring:' .. site) == 0 then call('RPUSH', P .. 'ring', site) end
call('RPUSH', P .. 'ring:' .. site, id)
return 'ok'
)lua");

const redis::Script kTake = script(R"lua(
local consumer, lease, deliveries, age, poison = unpack(ARGV)
removeOld(tonumber(age))
local function silentEntry(stream)
  local cursor = '0-0'
  repeat
    local claimed = call('XAUTOCLAIM', stream, 'takers', consumer, lease, cursor, 'COUNT', 1)
    if claimed[2][1] then return claimed[2][1] end
    cursor = claimed[1]
  until cursor == '0-0'
end
local function nextEntry(id)
  local stream = P .. 'stream:' .. id
  if call('EXISTS', stream) == 0 then return end
  local entry = silentEntry(stream)
  if entry then return entry end
  local read = call('XREADGROUP', 'GROUP', 'takers', consumer, 'COUNT', 1, 'STREAMS', stream, '>')
  return read and read[1][2][1]
end
for _ = 1, call('LLEN', P .. 'ring') do
  local site = call('LMOVE', P .. 'ring', P .. 'ring', 'LEFT', 'RIGHT')
  for _ = 1, site and call('LLEN', P .. 'ring:' .. site) or 0 do
    local id = call('LMOVE', P .. 'ring:' .. site, P .. 'ring:' .. site, 'LEFT', 'RIGHT')
    local entry = nextEntry(id)
    if entry then
      local times = call('XPENDING', P .. 'stream:' .. id, 'takers', entry[1], entry[1], 1)[1][4]
      if times > tonumber(deliveries) then
        finishJob(id, 'failed', (poison:gsub('INDEX', entry[2][2])))
      else
        if call('HGET', P .. 'job:' .. id, 'state') == 'queued' then
          call('HSET', P .. 'job:' .. id, 'state', 'running', 'started', touch(id))
        end
        local job = call('HMGET', P .. 'job:' .. id, 'client', 'scene')
        return {id, entry[2][2], entry[2][4], job[1], site, job[2], times, entry[1]}
      end
    end
  end
end
return false
)lua");

const redis::Script kRenew = script(R"lua(
local id, entry, consumer = unpack(ARGV)
if not isOpen(id) then return 0 end
local pending = call('XPENDING', P .. 'stream:' .. id, 'takers', entry, entry, 1)[1]
if not pending then return 0 end
if pending[2] == consumer then call('XCLAIM', P .. 'stream:' .. id, 'takers', consumer, 0, entry, 'JUSTID') end
return 1
)lua");

const redis::Script kFinish = script(R"lua(
local id, entry, index, note, pictures, carried, limit, noRoom, noShare = unpack(ARGV)
local frame = P .. 'frame:' .. id .. ':' .. index
if not isOpen(id) then return 'closed' end
settle(id, entry)
if call('EXISTS', frame) == 1 then return 'known' end
if allBytes() + #pictures > tonumber(limit) then
  finishJob(id, 'failed', noRoom)
  return 'room'
end
if not hasShare(id, call('HGET', P .. 'job:' .. id, 'client'), siteOf(id), bytesOf(id) + #pictures, limit) then
  finishJob(id, 'failed', noShare)
  return 'bytes'
end
call('HSET', frame, 'note', note, 'pictures', pictures)
call('INCRBY', P .. 'bytes', #pictures)
call('HINCRBY', P .. 'job:' .. id, 'bytes', #pictures)
local done = call('HINCRBY', P .. 'job:' .. id, 'done', 1)
local job = call('HMGET', P .. 'job:' .. id, 'first', 'count', 'chained')
touch(id)
if job[1] + done == tonumber(job[2]) then
  finishJob(id, 'done', '{"problems":[]}')
elseif job[3] == '1' then
  call('XADD', P .. 'stream:' .. id, '*', 'index', index + 1, 'carried', carried)
end
return 'kept'
)lua");

const redis::Script kFail = script(R"lua(
local id, index, problems = unpack(ARGV)
if isOpen(id) and call('EXISTS', P .. 'frame:' .. id .. ':' .. index) == 0 then finishJob(id, 'failed', problems) end
return 'ok'
)lua");

const redis::Script kGiveBack = script(R"lua(
local id, entry, lease, times, consumer = unpack(ARGV)
if not isOpen(id) then return 0 end
local pending = call('XPENDING', P .. 'stream:' .. id, 'takers', entry, entry, 1)[1]
if not pending or pending[2] ~= consumer then return 0 end
call('XCLAIM', P .. 'stream:' .. id, 'takers', consumer, 0, entry, 'IDLE', lease, 'RETRYCOUNT', times, 'JUSTID')
return 1
)lua");

const redis::Script kFind = script(R"lua(
removeOld(tonumber(ARGV[2]))
return fieldsOf(ARGV[1])
)lua");

const redis::Script kList = script(R"lua(
removeOld(tonumber(ARGV[2]))
local jobs = {}
for _, id in ipairs(call('ZREVRANGE', P .. ARGV[1], 0, -1)) do
  local fields = fieldsOf(id)
  if fields then table.insert(jobs, fields) end
end
return jobs
)lua");

const redis::Script kRemove = script(R"lua(
return removeJob(ARGV[1])
)lua");

const redis::Script kSize = script(R"lua(
removeOld(tonumber(ARGV[1]))
local left = 0
for _, site in ipairs(call('LRANGE', P .. 'ring', 0, -1)) do
  for _, id in ipairs(call('LRANGE', P .. 'ring:' .. site, 0, -1)) do
    local job = call('HMGET', P .. 'job:' .. id, 'first', 'count', 'done')
    if job[1] then left = left + job[2] - job[1] - job[3] end
  end
end
return {call('ZCARD', P .. 'changed'), left, allBytes()}
)lua");

} // namespace gnomon::job_scripts
