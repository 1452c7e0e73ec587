#include "server/worker/worker.h"

#include <array>
#include <atomic>
#include <csignal>
#include <map>
#include <memory>
#include <mutex>
#include <system_error>
#include <thread>
#include <unistd.h>

#include "renderer/core/parallel.h"
#include "server/system/log.h"
#include "server/system/memory_limit.h"
#include "server/system/no_thread.h"
#include "server/wire/channel.h"
#include "server/wire/messages.h"
#include "server/worker/front_light_maps.h"
#include "server/worker/orders.h"
#include "server/worker/sandbox.h"
#include "server/worker/vdb_starter.h"

namespace gnomon {
namespace {

constexpr std::chrono::milliseconds kBeatPause{500};
constexpr std::chrono::seconds kSendPatience{10}; ///< the front reads at once, unless it is stopped

/// No destructors: threads may be at work, and a worker has nothing on any disk.
[[noreturn]] void end(int status) {
  flushLog(std::chrono::seconds(1));
  ::_exit(status);
}

/// The problem of an event that does not fit a message.
Problem tooLongProblem(std::size_t bytes) {
  return {ProblemCode::tooLarge, "", "The result of this request is too long for a message.",
          std::to_string(Channel::kMostText) + " bytes", std::to_string(bytes) + " bytes"};
}

Problem tooLargeProblem(std::size_t bytes) {
  return {ProblemCode::tooLarge, "", "The result of this request is too large to be sent.",
          std::to_string(kMostResultBytes) + " bytes", std::to_string(bytes) + " bytes"};
}

/// The message with an outcome, in a form that fits: where its problems are too many, it has only the first of them.
std::string messageOf(Outcome outcome) {
  const std::uint64_t number = outcome.number;
  ToFront message{.outcome = std::move(outcome)};
  std::string text = textOf(message);
  if (Channel::fits(text)) return text;
  message.outcome->warnings.clear(); // the body has them, too
  if (std::string shorter = textOf(message); Channel::fits(shorter)) return shorter;
  constexpr std::size_t kFirst = 100;
  auto& problems = message.outcome->problems;
  if (problems.size() > kFirst) {
    problems.resize(kFirst);
    if (std::string shorter = textOf(message); Channel::fits(shorter)) return shorter;
  }
  return textOf({.outcome = Outcome{.number = number, .problems = {tooLongProblem(text.size())}}});
}

/// The orders in progress, each on a thread of its own.
class OrderBook {
 public:
  using Flag = std::shared_ptr<std::atomic<bool>>;

  Flag begin(std::uint64_t number) {
    const std::lock_guard lock(mutex_);
    return cancelled_[number] = std::make_shared<std::atomic<bool>>(false);
  }
  void cancel(std::uint64_t number) {
    const std::lock_guard lock(mutex_);
    if (const auto found = cancelled_.find(number); found != cancelled_.end()) *found->second = true;
  }
  void end(std::uint64_t number) {
    const std::lock_guard lock(mutex_);
    cancelled_.erase(number);
  }

 private:
  std::mutex mutex_;
  std::map<std::uint64_t, Flag> cancelled_;
};

class Worker {
 public:
  explicit Worker(FileDescriptor socket)
      : channel_(std::move(socket), kSendPatience), lightMaps_(std::make_shared<FrontLightMaps>(channel_)) {}

  [[noreturn]] void run() {
    start(firstMessage());
    auto nextBeat = Clock::now();
    while (true) {
      Packet packet;
      switch (channel_.receive(packet, kBeatPause)) {
        case ChannelEvent::packet:
          take(std::move(packet));
          break;
        case ChannelEvent::timeout:
          break;
        case ChannelEvent::ended:
          end(0);
        case ChannelEvent::broken:
          end(1);
      }
      if (Clock::now() < nextBeat) continue;
      say({.beat = beat()});
      nextBeat = Clock::now() + kBeatPause;
    }
  }

 private:
  WorkerOptions firstMessage() {
    constexpr std::chrono::seconds kPatience{30};
    Packet packet;
    if (channel_.receive(packet, kPatience) != ChannelEvent::packet) end(1);
    const auto message = readToWorker(packet.text);
    if (!message || !message->start) end(1);
    return *message->start;
  }

  [[noreturn]] void refuse(const Problems& problems) {
    say({.refusal = Refusal{problems}});
    end(1);
  }

  void start(const WorkerOptions& options) {
    vdb_ = VdbStarter::start({ownVdbProgram(), options.vdbBytes});
    if (!vdb_) end(1);
    startVdbBy([this](const std::string& name, int input, int output) { return vdb_->startVdb(name, input, output); });
    const auto confined = confineFiles();
    if (!confined) refuse(confined.problems());
    Limits limits;
    limits.maxSceneBytes = options.maxSceneBytes;
    auto renderer = RenderThread::start({.backend = {options.device, options.backend, options.requireGpu},
                                         .gpuSceneBytes = options.gpuSceneBytes,
                                         .tracedSceneBytes = options.tracedSceneBytes,
                                         .lightMapBytes = options.lightMapBytes,
                                         .lightMaps = options.keepsLightMaps ? lightMaps_ : nullptr,
                                         .volumeBytes = options.volumeBytes,
                                         .environmentBytes = options.environmentBytes,
                                         .tileCacheBytes = options.tileCacheBytes});
    if (!renderer) refuse(renderer.problems());
    renderer_ = *std::move(renderer);
    scenes_ = std::make_unique<SceneLoader>(options.sceneMemoryBytes, limits);
    context_ = std::unique_ptr<WorkContext>(new WorkContext{*renderer_,
                                                            *scenes_,
                                                            ByteBudget(options.frameMemoryBytes),
                                                            {},
                                                            {},
                                                            options.keepsLightMaps ? lightMaps_ : nullptr});
    const bool drivers = renderer_->info().device == DeviceChoice::gl;
    if (drivers && !*confined) {
      logEvent("worker",
               "The system has no Landlock: a worker with a graphics driver may read and change what its "
               "user may.");
    }
    const auto sealed = seal(drivers ? Seal::drivers : Seal::full, options.memoryBytes);
    if (!sealed) refuse(sealed.problems());
    say({.ready = renderer_->info()});
  }

  void take(Packet packet) {
    auto message = readToWorker(packet.text);
    if (!message) end(1);
    if (message->order) {
      if (packet.files.size() != 2) end(1);
      accept(std::move(*message->order), std::move(packet.files));
    }
    if (message->cancel) orders_.cancel(message->cancel->number);
    if (message->forget) scenes_->forget(message->forget->scene);
    if (message->lightMap) {
      lightMaps_->found(message->lightMap->number, packet.files.empty() ? nullptr : &packet.files.front());
    }
  }

  void accept(Order order, std::vector<FileDescriptor> files) {
    const auto deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                             std::chrono::duration<double, std::milli>(order.milliseconds));
    const std::uint64_t number = order.number;
    const auto cancelled = orders_.begin(number);
    try {
      std::thread([this, number, order = std::move(order), files = std::move(files), deadline, cancelled]() mutable {
        std::atomic<std::size_t> tooLong = 0; // bytes of a message that did not fit; 0 = all did
        carry({std::move(order), std::move(files[0]),
               std::string(asText(readFile(files[1], kLimits.maxSpecBytes).value_or(Bytes()))), deadline,
               [deadline, cancelled, &tooLong] { return !*cancelled && tooLong == 0 && Clock::now() < deadline; },
               [this, number, &tooLong](std::string_view name, std::string_view data) {
                 const std::string text = textOf({.event = OrderEvent{number, std::string(name), std::string(data)}});
                 if (!Channel::fits(text)) {
                   tooLong = text.size();
                 } else {
                   send(text);
                 }
               }},
              tooLong);
      }).detach();
    } catch (const std::system_error&) {
      orders_.end(number);
      say({.outcome = Outcome{.number = number, .problems = {noThreadFor("the work")}}});
    }
  }

  /// `tooLong`: bytes of an event that could not be sent; the order has failed then, and is stopped by its goOn.
  void carry(const OrderCall& call, const std::atomic<std::size_t>& tooLong) {
    Answer answer = carryOut(*context_, call);
    if (tooLong > 0) answer = {.problems = {tooLongProblem(tooLong)}};
    if (answer.body.size() > kMostResultBytes) answer = {.problems = {tooLargeProblem(answer.body.size())}};
    Outcome outcome{.number = call.order.number,
                    .problems = std::move(answer.problems),
                    .damaged = answer.damaged,
                    .contentType = std::move(answer.contentType),
                    .stages = std::move(answer.stages),
                    .warnings = std::move(answer.warnings)};
    std::optional<FileDescriptor> body;
    const bool wasSent = outcome.contentType == kEventStream && answer.body.empty();
    if (outcome.problems.empty() && !outcome.damaged && !wasSent) {
      body = memoryFile(asBytes(answer.body));
      if (!body)
        outcome.problems.push_back({ProblemCode::unavailable, "", "There is no memory for the reply.", "", ""});
    }
    orders_.end(outcome.number);
    const std::array files{body ? body->get() : -1};
    send(messageOf(std::move(outcome)), std::span(files).first(body ? 1 : 0));
  }

  Beat beat() const {
    FrameCost unit;
    unit.parts.fill(1);
    const auto factors = context_->costs.parts(unit).parts;
    const ReuseCounts reused = scenes_->reused();
    return {scenes_->count(), scenes_->bytes(), reused.meshes, reused.images, {factors.begin(), factors.end()}};
  }

  void say(const ToFront& message) { send(textOf(message)); }

  /// `text`: of a message.
  void send(const std::string& text, std::span<const int> files = {}) {
    if (!channel_.send(text, files)) end(1);
  }

  Channel channel_;
  std::shared_ptr<FrontLightMaps> lightMaps_;
  std::unique_ptr<VdbStarter> vdb_;
  std::unique_ptr<RenderThread> renderer_;
  std::unique_ptr<SceneLoader> scenes_;
  std::unique_ptr<WorkContext> context_;
  OrderBook orders_;
};

} // namespace

void runWorker(FileDescriptor channel) {
  boundHeaps(coresToUse() + 1);
  // Signals are the front's; it closes the channel when it ends.
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(number, SIG_IGN);
  // Lives as long as the process: its threads may outlast this one.
  auto* worker = new Worker(std::move(channel));
  worker->run();
}

} // namespace gnomon
