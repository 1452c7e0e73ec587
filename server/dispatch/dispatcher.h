#pragma once

#include <array>
#include <condition_variable>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "protocol/base/result.h"
#include "protocol/cost/cost_model.h"
#include "protocol/cost/passed_deadlines.h"
#include "server/dispatch/placement.h"
#include "server/dispatch/strike_list.h"
#include "server/dispatch/task.h"
#include "server/dispatch/worker_process.h"
#include "server/scenes/stored_light_maps.h"

namespace gnomon {

struct DispatcherOptions {
  std::string program = "/proc/self/exe";            ///< what workers run; see WorkerProcess
  std::size_t workers = 1;                           ///< >= 1
  std::size_t queueLimit = 64;                       ///< >= 1; tasks that may wait
  WorkerOptions each{};                              ///< for every worker
  std::chrono::milliseconds responseTimeout{10'000}; ///< a worker that sends nothing for so long is killed
  std::chrono::milliseconds stopping{1'000};         ///< and one that does not stop a task that was called off
  std::shared_ptr<StoredLightMaps> lightMaps{};      ///< nullptr = light maps are not stored

  /// Called for each task that goes to a worker, with how long it waited. It must return at once.
  std::function<void(Lane, double seconds)> waited{};

  /// Starts each thread of the dispatcher. It may throw std::system_error, as std::thread does where the system has no
  /// thread left.
  std::function<std::thread(std::function<void()>)> startThread = [](std::function<void()> work) {
    return std::thread(std::move(work));
  };
};

/// Why a worker had to be replaced.
enum class WorkerEnd {
  crash,       ///< it ended by itself, or sent what is no message
  silence,     ///< it stopped sending, or never became ready
  notStopping, ///< it went on with work that was cancelled
  memory       ///< it used more than it may
};
inline constexpr std::size_t kWorkerEnds = 4;
inline constexpr std::array<std::string_view, kWorkerEnds> kWorkerEndNames{"crash", "silence", "notStopping", "memory"};

/// What the workers are doing.
struct DispatcherState {
  std::size_t workers = 0;                               ///< that are to run
  std::size_t ready = 0;                                 ///< of these
  Clock::duration noneReadyFor{};                        ///< how long there has been no ready one; 0 = there is one
  std::size_t waiting = 0;                               ///< tasks
  std::size_t running = 0;                               ///< tasks
  std::size_t limit = 0;                                 ///< tasks that may wait
  std::array<std::size_t, kLanes> waitingByLane{};       ///< tasks
  std::array<std::size_t, kLanes> runningByLane{};       ///< tasks
  std::array<std::uint64_t, kWorkerEnds> replacements{}; ///< workers, since the start
  std::uint64_t reusedMeshes = 0; ///< by loads, since the start: found in a scene that a worker had
  std::uint64_t reusedImages = 0; ///< the same of images
};

/// Workers, and the queue before them. A worker that ends, stops sending, does not stop, or takes too much memory is
/// replaced; each task that it had is tried once more, with no other beside it, and if that ends its worker too, it is
/// a problem, and for a while no worker is given the same (StrikeList). Any thread.
class Dispatcher {
 public:
  /// Returns once all workers are ready, or one of them can't start: with those that can, or why none can.
  static Result<std::unique_ptr<Dispatcher>> start(DispatcherOptions options);
  ~Dispatcher(); ///< kills the workers; no task may be in progress

  /// Waits for the task's result. Problems beside the worker's own: busy where too many tasks wait,
  /// deadlineExceeded, unavailable where `gone` became true or the server ends, internal where workers ended over it or
  /// it could not be sent to one. Where a task is tried again, its caller is sent no event twice: the first ones of
  /// each name are passed over. `gone` is asked some fifty times a second, on the calling thread, as are `events`.
  TaskResult run(Task task, const std::function<bool()>& gone, const TaskEvents& events = {});

  /// How long a frame may take that finds nothing of earlier ones, as workers have learned.
  double milliseconds(const FrameSpec& spec, const SceneCounts& scene) const;

  /// How long it takes at least, as deadlines that passed have taught (Task::cost); 0 = not known.
  double leastMilliseconds(const FrameCost& cost) const;

  /// A scene was deleted: workers drop it.
  void forget(const std::string& scene);

  /// Of the worker that became ready last.
  RendererInfo info() const;
  DispatcherState state() const;

  /// Bytes of memory that all workers have now.
  std::uint64_t residentBytes() const;

  /// The workers' process ids; 0 where one is being replaced.
  std::vector<pid_t> processes() const;

  /// Tasks that are not done by then are called off with a problem of code unavailable.
  void endAt(Clock::time_point deadline);

 private:
  struct Ticket;
  struct Slot;
  using TicketPtr = std::shared_ptr<Ticket>;
  using Lock = std::unique_lock<std::mutex>;

  explicit Dispatcher(DispatcherOptions options);
  void keepWorking(Slot& slot);
  void guarded(Slot& slot, const std::function<void()>& work);
  bool startWorker(Slot& slot);
  void listen(Slot& slot);
  bool take(Slot& slot, Packet packet);
  void takeBeat(Slot& slot, const Beat& beat);
  bool takeStart(Slot& slot, const ToFront& message);
  bool isFitting(Slot& slot, Lock& lock, const std::function<bool()>& look);
  bool takeEvent(Slot& slot, const OrderEvent& event, Lock& lock);
  bool takeOutcome(Slot& slot, const Outcome& outcome, std::optional<SharedBytes> body, Lock& lock);
  static bool isAtWorkOn(const Slot& slot, std::string_view scene);
  void answerRequest(Slot& slot, const LightMapRequest& request);
  void replaceWorker(Slot& slot);
  void watch();
  struct Fault {
    Problem problem;
    WorkerEnd end = WorkerEnd::crash;
  };
  std::optional<Fault> faultOf(const Slot& slot) const;
  void endWorker(Slot& slot, Fault fault);
  void placeWaiting();
  void refuse(const TicketPtr& ticket, TaskResult result);
  bool mayWait(const Ticket& last) const;
  TicketPtr newestOfBusiest() const;
  void refuseForQueue(const TicketPtr& ticket);
  bool send(const TicketPtr& ticket, std::size_t worker);
  void finish(const TicketPtr& ticket, TaskResult result);
  void learnFrom(const Ticket& ticket, bool isLate);
  void callOff(const TicketPtr& ticket);
  int retryAfterSeconds() const;
  void countEnds(const Slot& slot);
  void refuseStruck();

  const DispatcherOptions options_;
  mutable std::mutex mutex_;
  std::condition_variable changed_; ///< a worker became ready or refused, or the dispatcher ends
  std::vector<std::unique_ptr<Slot>> slots_;
  std::list<TicketPtr> waiting_; ///< in order of arrival
  std::uint64_t numbers_ = 0;
  std::array<std::uint64_t, kWorkerEnds> replacements_{};
  std::uint64_t reusedMeshes_ = 0;
  std::uint64_t reusedImages_ = 0;
  Clock::time_point noneReadySince_; ///< where none is ready: when the last one went
  double taskMs_ = 0;                ///< moving average of what a task takes in a worker
  RendererInfo info_;
  FrameCost costFactors_; ///< milliseconds for a unit of each part
  PassedDeadlines passedDeadlines_;
  std::optional<Problems> refusal_; ///< of a worker that could not start
  StrikeList strikes_;
  Clock::time_point endAt_ = Clock::time_point::max();
  bool ending_ = false;
  std::thread watching_;
};

} // namespace gnomon
