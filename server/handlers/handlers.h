#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <semaphore>
#include <string>
#include <vector>

#include "protocol/spec/frame_spec.h"
#include "protocol/spec/limits.h"
#include "server/bakes/bake_registry.h"
#include "server/dispatch/dispatcher.h"
#include "server/frames/reply_cache.h"
#include "server/frames/shared_frames.h"
#include "server/http/connection.h"
#include "server/http/reply.h"
#include "server/http/router.h"
#include "server/jobs/job_news.h"
#include "server/jobs/job_queue.h"
#include "server/scenes/scene_store.h"
#include "server/system/byte_budget.h"
#include "server/system/fair_shares.h"
#include "server/system/lasting.h"

namespace gnomon {

/// What the handlers share. Outlives them; each part may be used by any thread.
struct Services {
  SceneStore& store;
  Dispatcher& workers;
  ByteBudget& replyBytes; ///< that of the connections, for what handlers hold of replies before it is sent
  JobQueue& jobs;
  JobLimits jobLimits{};
  FrameEnds jobFrames{};   ///< that this server took
  JobNews jobNews{jobs};   ///< for replies that wait
  FairShares waits{1'024}; ///< how many replies may wait for news of jobs
  Limits limits;
  std::chrono::milliseconds requestTimeout{60'000};     ///< from a request's first byte to its reply
  std::chrono::milliseconds evaluationTimeout{600'000}; ///< the same of evaluations and bakes
  std::chrono::milliseconds sequenceTimeout{3'600'000}; ///< of all frames of a sequence
  std::chrono::milliseconds replyRoom = ConnectionLimits().replyRoom;
  const Lasting* lackingThreads = nullptr; ///< requests that come find no thread; nullptr = they always do
  const StopSignal* cut = nullptr;         ///< once raised, no reply waits for room any more; nullptr = never
  std::vector<StaticFile> page;
  std::counting_semaphore<> evaluations{1}; ///< how many more may run at once
  std::counting_semaphore<> bakes{1};       ///< the same
  std::counting_semaphore<> sequences{1};   ///< the same
  ByteBudget videoMemory{0};                ///< of the encoders of videos that are being sent
  BakeRegistry bakeBook{};
  SharedFrames shared{};
  ReplyCache replies{0};
  FrameSpec drakeColors{};                ///< how Drake's color pictures are drawn
  std::function<std::string()> metrics{}; ///< the text of GET /metrics
  std::atomic<bool> draining = false;     ///< true from the first signal on; readyz reports it
};

HttpReply postScene(Services& services, RouteCall call);   ///< POST /v1/scenes
HttpReply putScene(Services& services, RouteCall call);    ///< PUT /v1/scenes/{id}
HttpReply listScenes(Services& services, RouteCall call);  ///< GET /v1/scenes
HttpReply getScene(Services& services, RouteCall call);    ///< GET /v1/scenes/{id}
HttpReply deleteScene(Services& services, RouteCall call); ///< DELETE /v1/scenes/{id}
HttpReply getNodes(Services& services, RouteCall call);    ///< GET /v1/scenes/{id}/nodes

HttpReply postFrame(Services& services, RouteCall call);  ///< POST /v1/scenes/{id}/frames
HttpReply getFrame(Services& services, RouteCall call);   ///< GET /v1/scenes/{id}/frame?…
HttpReply postPlan(Services& services, RouteCall call);   ///< POST /v1/scenes/{id}/plan
HttpReply renderOnce(Services& services, RouteCall call); ///< POST /v1/render

HttpReply renderDrake(Services& services, RouteCall call); ///< POST /render

HttpReply postEvaluation(Services& services, RouteCall call); ///< POST /v1/scenes/{id}/evaluations

HttpReply postSequence(Services& services, RouteCall call); ///< POST /v1/scenes/{id}/sequences

HttpReply listJobs(Services& services, RouteCall call);     ///< GET /v1/jobs
HttpReply getJob(Services& services, RouteCall call);       ///< GET /v1/jobs/{id}
HttpReply deleteJob(Services& services, RouteCall call);    ///< DELETE /v1/jobs/{id}
HttpReply getJobResult(Services& services, RouteCall call); ///< GET /v1/jobs/{id}/result
HttpReply getJobFrame(Services& services, RouteCall call);  ///< GET /v1/jobs/{id}/frames/{index}

HttpReply postBake(Services& services, RouteCall call);   ///< POST /v1/scenes/{id}/bakes
HttpReply getBake(Services& services, RouteCall call);    ///< GET /v1/scenes/{id}/bakes/{key}
HttpReply deleteBake(Services& services, RouteCall call); ///< DELETE /v1/scenes/{id}/bakes/{key}

/// The addresses of a server's state.
enum class Addresses {
  one, ///< beside everything else
  two  ///< at an address of its own; probes are answered at both
};

/// Every route for clients. `services` outlives them.
std::vector<Route> makeRoutes(Services& services, Addresses addresses = Addresses::one);

/// The routes of the second address.
std::vector<Route> makeAdminRoutes(Services& services);

/// What connections call: finds the route, checks the type of the body, and refuses other requests.
HttpService makeService(std::vector<Route> routes);

} // namespace gnomon
