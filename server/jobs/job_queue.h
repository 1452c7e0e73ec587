#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/job/job.h"
#include "protocol/sequence/sequence.h"
#include "server/system/client_identity.h"
#include "server/wire/frame_pictures.h"

/// Frames of sequences that wait to be drawn, and what was drawn.
namespace gnomon {

/// How much jobs may keep, and for how long.
struct JobLimits {
  std::size_t jobs = 256;                 ///< of all clients, where each has a descriptor (insufficientStorage)
  std::size_t jobsOfClient = 16;          ///< that are kept for one client, in any state (busy)
  std::uint64_t bytes = 1ull << 30;       ///< of all jobs: requests and pictures (insufficientStorage)
  std::chrono::seconds age{86'400};       ///< a job goes so long after its last frame
  int deliveries = 5;                     ///< >= 1; a frame that was taken more often fails its job
  std::chrono::milliseconds lease{2'000}; ///< a frame that was not renewed for so long is given to other takers
};

/// A job as it was asked for.
struct NewJob {
  std::string id{};
  std::string key{};       ///< name of the key that made it; empty = the server has no keys
  ClientIdentity client{}; ///< whose site takes turns with others
  std::string scene{};     ///< its id
  std::string request{};   ///< a SequenceRequest that passed its checks, as JSON
  int first = 0;           ///< index of the first frame
  int count = 1;           ///< > first; frames, those before `first` included
  bool isChained = false;  ///< a frame takes what the one before it left, and so waits for it
  Carried carried{};       ///< for frame `first`
};

/// What became of a job so far.
struct JobProgress {
  std::string id{};
  std::string key{};
  std::string scene{};
  JobState state = JobState::queued;
  int first = 0;
  int count = 0;
  int done = 0;
  std::uint64_t bytes = 0; ///< of its pictures
  Carried carried{};       ///< for frame `first`
  Problems problems{};
  // Milliseconds since 1970; 0 = not yet
  std::int64_t created = 0;
  std::int64_t started = 0;
  std::int64_t changed = 0; ///< the last time that a frame was drawn or the state changed
  std::int64_t ended = 0;

  /// Nothing more happens to it.
  bool isEnded() const { return state == JobState::done || state == JobState::failed; }
};

/// All jobs together.
struct JobsSize {
  std::size_t jobs = 0;       ///< in any state
  std::size_t framesLeft = 0; ///< that wait or are in work
  std::uint64_t bytes = 0;    ///< of requests and pictures
};

/// A frame to be drawn by the caller that took it.
struct FrameTurn {
  std::string job{};
  int index = 0;
  ClientIdentity client{};
  std::string scene{};
  Carried before{};      ///< what the frame takes from the one before it
  int deliveries = 1;    ///< how often it was taken, this time included
  std::string receipt{}; ///< the queue's own
};

/// All about a drawn frame but its pictures.
struct FrameNote {
  std::string contentKey{}; ///< SHA-256, in lower-case digits, of scene, specification and renderer: what the pictures
                            ///< depend on
  Carried carried{};        ///< of this frame alone
  std::vector<std::string> warnings{};
  std::vector<StageTime> stages{};
  double milliseconds = 0;
  std::vector<PictureNews> pictures{}; ///< in the order of their bytes
};

struct JobFrame {
  FrameNote note{};
  FramePictures pictures{}; ///< those of the note
};

/// Any thread; any number of processes, where what is behind it is shared. Every function may give the problem
/// unavailable, where what is behind it can't be reached; nothing is half done then, or it is done whole.
class JobQueue {
 public:
  virtual ~JobQueue() = default;

  /// Keeps a job and queues its frames: all, or, where they are chained, the first. Problems: busy where the client has
  /// as many as it may, or its share of all jobs or of their bytes (fair_shares.h: half of the jobs, three quarters of
  /// the bytes), insufficientStorage where there is no room.
  virtual Status put(const NewJob& job) = 0;

  /// A frame whose turn it is: sites take turns, and so do the jobs of each. Waits for one as long as `patience`;
  /// nothing = none came.
  virtual Result<std::optional<FrameTurn>> take(std::chrono::milliseconds patience) = 0;

  /// The request of a job; nothing where the job is gone.
  virtual Result<std::optional<std::string>> request(const std::string& job) = 0;

  /// Says that the frame is still being drawn. False = it is not wanted any more.
  virtual Result<bool> renew(const FrameTurn& turn) = 0;

  /// Keeps what was drawn, once: the second to come with the same frame changes nothing, and neither does a job that is
  /// gone or failed. In the same step the next frame of a chained job is queued, with `carried`. Where there is no
  /// room, or the client's other jobs have its share of the bytes, the job fails.
  virtual Status finish(const FrameTurn& turn, const JobFrame& frame) = 0;

  /// The job fails, and its other frames are not drawn any more. Problems are placed in the job's request.
  virtual Status fail(const FrameTurn& turn, const Problems& problems) = 0;

  /// Others may take it, at once. `isTried`: it counts as one of the deliveries.
  virtual Status giveBack(const FrameTurn& turn, bool isTried) = 0;

  virtual Result<std::optional<JobProgress>> find(const std::string& job) = 0;

  /// Jobs of a key, or of all, the newest first.
  virtual Result<std::vector<JobProgress>> list(const std::optional<std::string>& key) = 0;

  /// All about a frame but its pictures; nothing where it is not drawn yet.
  virtual Result<std::optional<FrameNote>> note(const std::string& job, int index) = 0;

  /// The same with its pictures.
  virtual Result<std::optional<JobFrame>> frame(const std::string& job, int index) = 0;

  /// Ends a job and forgets it with all of its frames. False where there was none.
  virtual Result<bool> remove(const std::string& job) = 0;

  virtual Result<JobsSize> size() = 0;
};

/// What became of a frame that this server took from the queue of jobs.
enum class FrameEnd {
  drawn,
  failed,    ///< and its job with it
  givenBack, ///< to be drawn later, or by another server
  unwanted,  ///< its job was removed or had failed, or another server was faster
};
inline constexpr std::array<std::string_view, 4> kFrameEndNames{"drawn", "failed", "givenBack", "unwanted"};

/// By FrameEnd. Any thread.
struct FrameEnds {
  std::array<std::atomic<std::uint64_t>, kFrameEndNames.size()> ends{};

  void add(FrameEnd end) { ++ends[static_cast<std::size_t>(end)]; }
};

std::int64_t unixMilliseconds();

/// The progress of a job that has not begun.
JobProgress queuedProgress(const NewJob& job);

Problem tooManyJobs(std::size_t most);       ///< busy: of one client
Problem noShareOfJobs(std::size_t most);     ///< busy: of one client or site, of those that all have
Problem noRoomForJobs(std::uint64_t bytes);  ///< insufficientStorage: for a new job
Problem noRoomForFrame(std::uint64_t bytes); ///< insufficientStorage: for the pictures of one in work
/// Of one client or site, of the bytes of all jobs: busy for a new job, insufficientStorage for a frame of one in work.
Problem noShareOfBytes(ProblemCode code, std::uint64_t bytes);
Problem poisonProblem(int index, int deliveries); ///< internal: every server that took the frame died
Problem unknownJob(std::string_view id);          ///< notFound

/// 32 lower-case hexadecimal digits, unguessable.
std::string newJobId();

} // namespace gnomon
