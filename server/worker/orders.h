#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "protocol/base/lru.h"
#include "protocol/cost/cost_model.h"
#include "server/system/byte_budget.h"
#include "server/wire/messages.h"
#include "server/worker/render_thread.h"
#include "server/worker/scene_loader.h"

/// What a worker does: one function for each kind of order. Each runs on a thread of its own.
namespace gnomon {

/// Settings that were chosen for one view, and serve others of its kind.
struct QualityChoice {
  std::string view; ///< hash of the frame that was measured
  QualityReport report;
};

/// As it is stored: the view in a line, then the report as JSON.
std::string textOf(const QualityChoice& choice);
std::optional<QualityChoice> readQualityChoice(std::string_view text); ///< nothing where the text is another one

/// What a frame says that takes its settings from `choice`. `view`: hash of that frame.
QualityReport reusedReport(QualityChoice choice, std::string_view view);

/// Settings chosen for earlier frames with a target, by what decides them; the least recently used are dropped first.
/// Any thread.
class QualityChoices {
 public:
  /// `key`: any text. Only its hash is kept.
  std::optional<QualityChoice> find(const std::string& key);
  void keep(const std::string& key, const QualityChoice& choice);

 private:
  static constexpr std::size_t kMost = 1024; ///< a few hundred bytes each

  struct Entry {
    std::string hash;
    QualityChoice choice;
  };

  std::mutex mutex_;
  LruList<Entry> entries_;
};

/// Orders that a worker carries out at the same time. Any thread.
struct OrdersAtWork {
  std::atomic<std::size_t> running{0};
  std::atomic<std::uint64_t> begun{0}; ///< since the worker's start
};

/// An order, from its beginning to its end.
class Presence {
 public:
  explicit Presence(OrdersAtWork& orders) : orders_(orders), first_(++orders.running == 1), number_(++orders.begun) {}
  Presence(const Presence&) = delete;
  Presence& operator=(const Presence&) = delete;
  ~Presence() { --orders_.running; }

  /// No other order was carried out beside it so far.
  bool wasAlone() const { return first_ && orders_.begun == number_; }

 private:
  OrdersAtWork& orders_;
  bool first_;
  std::uint64_t number_;
};

/// The problem of an order that could not allocate: tooLarge where it had the worker to itself; unavailable where
/// others, whose memory comes back, were carried out beside it.
Problem noMemoryFor(const Presence& order);

struct Answer;
/// The answer of an order; where memory was lacking for a part of it (noMemory() of result.h) beside other orders, that
/// it is unavailable.
Answer judgedAnswer(Answer answer, const Presence& order);

/// What all orders of a worker share. Outlives them; each part may be used by any thread.
struct WorkContext {
  RenderThread& renderer;
  SceneLoader& scenes;
  ByteBudget frameMemory; ///< of pictures that are being drawn or encoded
  QualityChoices choices;
  CostModel costs;                         ///< learned from the frames drawn here
  std::shared_ptr<LightMapStore> stored{}; ///< choices that outlive the worker, beside light maps; nullptr = none do
  OrdersAtWork atWork{};
};

/// An order as it arrived.
struct OrderCall {
  Order order;
  FileDescriptor bundle;
  std::string request; ///< JSON
  Clock::time_point deadline;
  GoOn goOn; ///< false once the deadline has passed or no client waits any more
  std::function<void(std::string_view name, std::string_view data)> event;
};

/// The result of an order: problems, or a body, or neither where all of it was sent as events.
struct Answer {
  Problems problems{};
  bool damaged = false; ///< as in Outcome
  std::string contentType{};
  std::string body{};
  std::vector<StageTime> stages{};
  std::vector<std::string> warnings{};
};

Answer loadOrder(WorkContext& context, const OrderCall& call);
Answer frameOrder(WorkContext& context, const OrderCall& call);
Answer planOrder(WorkContext& context, const OrderCall& call);
Answer evaluationOrder(WorkContext& context, const OrderCall& call);
Answer bakeOrder(WorkContext& context, const OrderCall& call);
Answer bakeFileOrder(WorkContext& context, const OrderCall& call);
Answer nodesOrder(WorkContext& context, const OrderCall& call);
Answer sequenceFrameOrder(WorkContext& context, const OrderCall& call);

/// Calls the one for the order's kind. Nothing that it throws leaves it.
Answer carryOut(WorkContext& context, const OrderCall& call) noexcept;

/// What a frame of the scene takes on the device that will draw it. `asJson`: as frameBytes.
std::size_t bytesOf(const WorkContext& context, const LoadedScene& scene, const FrameSpec& spec, bool asJson = false);

/// The order's scene, or the answer that says why it can't be had.
std::variant<LoadedScene, Answer> sceneOf(WorkContext& context, const OrderCall& call);

/// tooLarge at `pointer` where there can never be room for so many bytes.
Status checkMemory(const ByteBudget& budget, std::size_t bytes, std::string_view pointer);

/// Takes memory as soon as there is room; checkMemory's problem, and deadlineExceeded where the order is stopped
/// before.
Status takeMemory(ByteLease& lease, const ByteBudget& budget, std::size_t bytes, std::string_view pointer,
                  const OrderCall& call);

/// The problem of work that was stopped: at its deadline, or because no client waits for it.
Problem stoppedProblem(std::string_view what, const OrderCall& call);

inline constexpr std::string_view kJson = "application/json";

/// Measures. Every frame takes its turn on the render thread, so that other clients' frames are drawn in between.
/// Problems: evaluate()'s, tooLarge, deadlineExceeded.
Result<EvaluationReport> evaluateScene(WorkContext& context, const LoadedScene& scene, const Evaluation& evaluation,
                                       const OrderCall& call, const EvaluationListener& listener = {});

/// The settings that meet the target of `spec`: those of an earlier frame of this scene and class of views, or else
/// found by drawing and measuring many frames. Problems as an evaluation gives, with places in `spec`.
Result<QualityReport> settleQuality(WorkContext& context, const LoadedScene& scene, const FrameSpec& spec,
                                    const OrderCall& call);

} // namespace gnomon
