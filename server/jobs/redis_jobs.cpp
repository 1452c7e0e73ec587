#include "server/jobs/redis_jobs.h"

#include <algorithm>
#include <limits>
#include <thread>
#include <utility>

#include "protocol/fields/fields.h"
#include "protocol/job/job_rows.h"
#include "protocol/sequence/sequence.h"
#include "protocol/spec/limits.h"
#include "server/jobs/job_queue.h"
#include "server/jobs/job_scripts.h"
#include "server/jobs/job_text.h"
#include "server/system/clock.h"
#include "server/system/log.h"
#include "server/system/numbers.h"

namespace gnomon {
namespace {

constexpr std::chrono::seconds kPatience{10};
constexpr std::size_t kMostText = 512u << 20; ///< of one value in Redis
constexpr const char* kPrefix = "gnomon:jobs:";

std::string frameKey(const std::string& job, int index) {
  return kPrefix + ("frame:" + job + ':') + std::to_string(index);
}

/// Of a command that Redis did not carry out.
Problem refused(const redis::Reply& error) {
  logEvent("jobs", error.text);
  if (error.isError("OOM")) return {ProblemCode::insufficientStorage, "", "What keeps the jobs is full.", "", ""};
  return {ProblemCode::unavailable, "", "What keeps the jobs does not take them now.", "", ""};
}

/// Of what no replica writes. `key`: where it is.
Problem damaged(const std::string& key) {
  logEvent("jobs", "What Redis holds at " + key + " can't be used.");
  return {ProblemCode::internal, "", "What was kept of this job can't be read.", "", ""};
}

std::string jobKey(const std::string& job) {
  return kPrefix + ("job:" + job);
}

/// Reads numbers out of replies, and remembers whether each was one within its bounds.
class Numbers {
 public:
  template <class Number>
  Number read(const redis::Reply& reply, Number least, Number most) {
    const auto number = numberIn<Number>(reply.isInteger() ? std::to_string(reply.integer) : reply.text, least, most);
    areSound_ = areSound_ && number.has_value();
    return number.value_or(least);
  }
  bool areSound() const { return areSound_; }

 private:
  bool areSound_ = true;
};

constexpr int kMostFrames = static_cast<int>(kLimits.maxSequenceFrames);
constexpr std::int64_t kMostTime = 4'102'444'800'000; ///< milliseconds: the year 2100
constexpr std::uint64_t kMostCount = std::uint64_t{1} << 52;

std::optional<JobState> stateOf(std::string_view word) {
  const auto& all = kSpellings<JobState>;
  const auto found = std::find_if(all.begin(), all.end(), [&](const Spelling& each) { return each.name == word; });
  if (found == all.end()) return std::nullopt;
  return static_cast<JobState>(found->value);
}

/// From fieldsOf() of the scripts.
std::optional<JobProgress> progressOf(const redis::Reply& reply) {
  const auto& fields = reply.elements;
  if (fields.size() != 14) return std::nullopt;
  const auto state = stateOf(fields[3].text);
  auto carried = readCarried(fields[8].text);
  auto problems = readProblems(fields[9].text);
  if (!state || !carried || !problems || (*state == JobState::failed && problems->empty())) return std::nullopt;
  Numbers numbers;
  const int first = numbers.read(fields[4], 0, kMostFrames);
  const int count = numbers.read(fields[5], first + 1, kMostFrames);
  JobProgress progress{.id = fields[0].text,
                       .key = fields[1].text,
                       .scene = fields[2].text,
                       .state = *state,
                       .first = first,
                       .count = count,
                       .done = numbers.read(fields[6], 0, count - first),
                       .bytes = numbers.read<std::uint64_t>(fields[7], 0, kMostCount),
                       .carried = *std::move(carried),
                       .problems = *std::move(problems),
                       .created = numbers.read<std::int64_t>(fields[10], 0, kMostTime),
                       .started = numbers.read<std::int64_t>(fields[11], 0, kMostTime),
                       .changed = numbers.read<std::int64_t>(fields[12], 0, kMostTime),
                       .ended = numbers.read<std::int64_t>(fields[13], 0, kMostTime)};
  return numbers.areSound() ? std::optional(std::move(progress)) : std::nullopt;
}

} // namespace

RedisJobs::RedisJobs(JobLimits limits, std::shared_ptr<redis::Redis> redis)
    : limits_(limits), redis_(std::move(redis)), consumer_(newJobId()) {}

Result<redis::Reply> RedisJobs::run(const redis::Script& script, const std::vector<std::string>& arguments) const {
  constexpr std::size_t kMostReply = 16u << 20; // a list of jobs, each with its problems
  auto reply =
      redis_->run(script, {}, arguments, {.deadline = Clock::now() + kPatience, .limits = {.bytes = kMostReply}});
  if (reply && reply->isError()) return refused(*reply);
  return reply;
}

Result<redis::Reply> RedisJobs::ask(const redis::Command& command, std::size_t mostBytes) const {
  redis::Call call{.deadline = Clock::now() + kPatience};
  call.limits.bytes = mostBytes + (1 << 20);
  auto reply = redis_->ask(command, call);
  if (reply && reply->isError()) return refused(*reply);
  return reply;
}

Status RedisJobs::put(const NewJob& job) {
  const auto reply =
      run(job_scripts::kPut,
          {job.id, job.key, job.client.name, job.client.site, job.scene, job.request, std::to_string(job.first),
           std::to_string(job.count), job.isChained ? "1" : "0", textOf(job.carried),
           std::to_string(limits_.jobsOfClient), std::to_string(limits_.jobs), std::to_string(limits_.bytes), age()});
  if (!reply) return reply.problems();
  if (reply->text == "client") return tooManyJobs(limits_.jobsOfClient);
  if (reply->text == "share") return noShareOfJobs(limits_.jobs);
  if (reply->text == "bytes") return noShareOfBytes(ProblemCode::busy, limits_.bytes);
  if (reply->text == "room") return noRoomForJobs(limits_.bytes);
  return Done{};
}

Result<std::optional<FrameTurn>> RedisJobs::take(std::chrono::milliseconds patience) {
  constexpr std::chrono::milliseconds kShortest{20}; ///< between two looks
  constexpr std::chrono::milliseconds kLongest{250};
  const auto until = Clock::now() + patience;
  Problem poison = poisonProblem(0, limits_.deliveries);
  poison.detail.replace(poison.detail.find('0'), 1, "INDEX");
  for (auto pause = kShortest;; pause = std::min(pause * 2, kLongest)) {
    const auto reply = run(job_scripts::kTake,
                           {consumer_, lease(), std::to_string(limits_.deliveries), age(), textOf(Problems{poison})});
    if (!reply) return reply.problems();
    if (reply->elements.size() == 8) {
      const auto& fields = reply->elements;
      auto carried = readCarried(fields[2].text);
      if (!carried) return damaged(kPrefix + ("stream:" + fields[0].text));
      Numbers numbers;
      FrameTurn turn{.job = fields[0].text,
                     .index = numbers.read(fields[1], 0, kMostFrames - 1),
                     .client = {fields[3].text, fields[4].text},
                     .scene = fields[5].text,
                     .before = *std::move(carried),
                     .deliveries = numbers.read(fields[6], 1, std::numeric_limits<int>::max()),
                     .receipt = fields[7].text};
      if (!numbers.areSound()) return damaged(kPrefix + ("stream:" + turn.job));
      return std::optional(std::move(turn));
    }
    if (Clock::now() >= until) return std::optional<FrameTurn>();
    std::this_thread::sleep_until(std::min(Clock::now() + pause, until));
  }
}

Result<std::optional<std::string>> RedisJobs::request(const std::string& job) {
  auto reply = ask({"HGET", jobKey(job), "request"}, limits_.bytes);
  if (!reply) return reply.problems();
  return reply->isText() ? std::optional(std::move(reply->text)) : std::nullopt;
}

Result<bool> RedisJobs::renew(const FrameTurn& turn) {
  const auto reply = run(job_scripts::kRenew, {turn.job, turn.receipt, consumer_});
  if (!reply) return reply.problems();
  return reply->integer == 1;
}

Status RedisJobs::finish(const FrameTurn& turn, const JobFrame& frame) {
  if (frame.pictures.bytes().size() > kMostText) {
    return fail(turn,
                {{ProblemCode::tooLarge, "", "The pictures of a frame are too large to be kept.",
                  std::to_string(kMostText) + " bytes", std::to_string(frame.pictures.bytes().size()) + " bytes"}});
  }
  const auto reply = run(job_scripts::kFinish,
                         {turn.job, turn.receipt, std::to_string(turn.index), textOf(frame.note),
                          std::string(frame.pictures.bytes()), textOf(carriedAfter(turn.before, frame.note.carried)),
                          std::to_string(limits_.bytes), textOf(Problems{noRoomForFrame(limits_.bytes)}),
                          textOf(Problems{noShareOfBytes(ProblemCode::insufficientStorage, limits_.bytes)})});
  if (!reply) return reply.problems();
  return Done{};
}

Status RedisJobs::fail(const FrameTurn& turn, const Problems& problems) {
  const auto reply = run(job_scripts::kFail, {turn.job, std::to_string(turn.index), textOf(problems)});
  if (!reply) return reply.problems();
  return Done{};
}

Status RedisJobs::giveBack(const FrameTurn& turn, bool isTried) {
  const int times = isTried ? turn.deliveries : turn.deliveries - 1;
  const auto reply = run(job_scripts::kGiveBack, {turn.job, turn.receipt, lease(), std::to_string(times), consumer_});
  if (!reply) return reply.problems();
  return Done{};
}

Result<std::optional<JobProgress>> RedisJobs::find(const std::string& job) {
  const auto reply = run(job_scripts::kFind, {job, age()});
  if (!reply) return reply.problems();
  if (reply->isNil()) return std::optional<JobProgress>();
  auto progress = progressOf(*reply);
  if (!progress) return damaged(jobKey(job));
  return progress;
}

Result<std::vector<JobProgress>> RedisJobs::list(const std::optional<std::string>& key) {
  const auto reply = run(job_scripts::kList, {key ? "key:" + *key : "changed", age()});
  if (!reply) return reply.problems();
  std::vector<JobProgress> jobs;
  for (const redis::Reply& each : reply->elements) {
    if (auto progress = progressOf(each)) {
      jobs.push_back(*std::move(progress));
    } else {
      (void)damaged(jobKey(each.elements.empty() ? "" : each.elements.front().text));
    }
  }
  const auto isNewer = [](const JobProgress& a, const JobProgress& b) { return a.created > b.created; };
  if (!key) std::stable_sort(jobs.begin(), jobs.end(), isNewer); // of a key they are in order
  return jobs;
}

Result<std::optional<FrameNote>> RedisJobs::note(const std::string& job, int index) {
  const auto reply = ask({"HGET", frameKey(job, index), "note"}, 0);
  if (!reply) return reply.problems();
  if (reply->isNil()) return std::optional<FrameNote>();
  auto note = readFrameNote(reply->text);
  if (!note) return damaged(frameKey(job, index));
  return note;
}

Result<std::optional<JobFrame>> RedisJobs::frame(const std::string& job, int index) {
  auto reply = ask({"HMGET", frameKey(job, index), "note", "pictures"}, kMostText);
  if (!reply) return reply.problems();
  if (reply->elements.size() != 2 || !reply->elements[1].isText()) return std::optional<JobFrame>();
  auto note = readFrameNote(reply->elements[0].text);
  if (!note) return damaged(frameKey(job, index));
  auto pictures = FramePictures::of(note->pictures, std::move(reply->elements[1].text));
  if (!pictures) return damaged(frameKey(job, index));
  return std::optional(JobFrame{*std::move(note), *std::move(pictures)});
}

Result<bool> RedisJobs::remove(const std::string& job) {
  const auto reply = run(job_scripts::kRemove, {job});
  if (!reply) return reply.problems();
  return reply->integer == 1;
}

Result<JobsSize> RedisJobs::size() {
  const auto reply = run(job_scripts::kSize, {age()});
  if (!reply) return reply.problems();
  const auto& fields = reply->elements;
  if (fields.size() != 3) return damaged("gnomon:jobs:bytes");
  Numbers numbers;
  const JobsSize size{.jobs = numbers.read<std::size_t>(fields[0], 0, kMostCount),
                      .framesLeft = numbers.read<std::size_t>(fields[1], 0, kMostCount),
                      .bytes = numbers.read<std::uint64_t>(fields[2], 0, kMostCount)};
  if (!numbers.areSound()) return damaged("gnomon:jobs:bytes");
  return size;
}

} // namespace gnomon
