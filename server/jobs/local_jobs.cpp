#include "server/jobs/local_jobs.h"

#include <algorithm>

#include "protocol/sequence/sequence.h"
#include "server/jobs/job_queue.h"

namespace gnomon {
namespace {

std::uint64_t bytesOf(const NewJob& job, const JobProgress& progress) {
  return job.request.size() + progress.bytes;
}

} // namespace

LocalJobs::Entry* LocalJobs::at(const std::string& job) {
  const auto found =
      std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.job.id == job; });
  return found == entries_.end() ? nullptr : &*found;
}

/// What all other jobs keep, as the job's client sees it.
SharedUse LocalJobs::bytesBeside(const NewJob& job) const {
  SharedUse use{.capacity = limits_.bytes};
  for (const Entry& entry : entries_) {
    if (entry.job.id == job.id) continue;
    const std::uint64_t bytes = bytesOf(entry.job, entry.progress);
    use.taken += bytes;
    use.byClient += entry.job.client.name == job.client.name ? bytes : 0;
    use.bySite += entry.job.client.site == job.client.site ? bytes : 0;
  }
  return use;
}

void LocalJobs::dropOld() {
  const auto oldest = Clock::now() - limits_.age;
  entries_.remove_if([&](const Entry& entry) { return entry.changed < oldest; });
}

void LocalJobs::noteChange(Entry& entry) {
  entry.changed = Clock::now();
  entry.progress.changed = unixMilliseconds();
}

void LocalJobs::end(Entry& entry, JobState state, const Problems& problems) {
  noteChange(entry);
  entry.progress.state = state;
  entry.progress.problems = problems;
  entry.progress.ended = entry.progress.changed;
  entry.waiting.clear();
  entry.taken.clear();
}

void LocalJobs::takeBackSilent() {
  const auto oldest = Clock::now() - limits_.lease;
  for (Entry& entry : entries_) {
    for (auto taken = entry.taken.begin(); taken != entry.taken.end();) {
      if (taken->second.renewed >= oldest) {
        ++taken;
        continue;
      }
      entry.waiting.push_front(std::move(taken->second.frame));
      taken = entry.taken.erase(taken);
    }
    const auto poisonous = std::find_if(entry.waiting.begin(), entry.waiting.end(), [&](const WaitingFrame& frame) {
      return frame.deliveries >= limits_.deliveries;
    });
    if (poisonous != entry.waiting.end()) {
      end(entry, JobState::failed, {poisonProblem(poisonous->index, poisonous->deliveries)});
    }
  }
}

/// The job of the site that has waited longest, and of its jobs the one that has.
LocalJobs::Entry* LocalJobs::nextInTurn() {
  std::map<std::string_view, std::uint64_t> lastOfSite;
  for (const Entry& entry : entries_) {
    std::uint64_t& last = lastOfSite[entry.job.client.site];
    last = std::max(last, entry.turn);
  }
  Entry* next = nullptr;
  const auto turnOf = [&](const Entry& entry) { return std::pair(lastOfSite[entry.job.client.site], entry.turn); };
  for (auto entry = entries_.rbegin(); entry != entries_.rend(); ++entry) {
    if (!entry->waiting.empty() && (next == nullptr || turnOf(*entry) < turnOf(*next))) next = &*entry;
  }
  return next;
}

Status LocalJobs::put(const NewJob& job) {
  const std::lock_guard lock(mutex_);
  dropOld();
  SharedUse use{.capacity = limits_.jobs, .taken = entries_.size()};
  for (const Entry& entry : entries_) {
    use.byClient += entry.job.client.name == job.client.name ? 1 : 0;
    use.bySite += entry.job.client.site == job.client.site ? 1 : 0;
  }
  if (use.byClient >= limits_.jobsOfClient) return tooManyJobs(limits_.jobsOfClient);
  const SharedUse bytes = bytesBeside(job);
  if (use.taken >= use.capacity || bytes.taken + job.request.size() > bytes.capacity) {
    return noRoomForJobs(limits_.bytes);
  }
  if (!mayTake(use, 1, Share::half)) return noShareOfJobs(limits_.jobs);
  if (!mayTake(bytes, job.request.size(), Share::threeQuarters)) {
    return noShareOfBytes(ProblemCode::busy, limits_.bytes);
  }
  auto file = ResultFile::make(directory_);
  if (!file) return std::move(file).problems();
  Entry entry{.job = job, .progress = queuedProgress(job), .file = *std::move(file)};
  const int end = job.isChained ? job.first + 1 : job.count;
  for (int index = job.first; index < end; ++index) entry.waiting.push_back({index, job.carried});
  entries_.push_front(std::move(entry));
  queued_.notify_all();
  return Done{};
}

Result<std::optional<FrameTurn>> LocalJobs::take(std::chrono::milliseconds patience) {
  const auto until = Clock::now() + patience;
  std::unique_lock lock(mutex_);
  while (true) {
    dropOld();
    takeBackSilent();
    Entry* const entry = nextInTurn();
    if (entry == nullptr) {
      if (Clock::now() >= until) return std::optional<FrameTurn>();
      queued_.wait_until(lock, std::min(until, Clock::now() + limits_.lease));
      continue;
    }
    WaitingFrame frame = std::move(entry->waiting.front());
    entry->waiting.pop_front();
    ++frame.deliveries;
    entry->turn = ++turns_;
    if (entry->progress.state == JobState::queued) {
      entry->progress.state = JobState::running;
      noteChange(*entry);
      entry->progress.started = entry->progress.changed;
    }
    FrameTurn turn{.job = entry->job.id,
                   .index = frame.index,
                   .client = entry->job.client,
                   .scene = entry->job.scene,
                   .before = frame.before,
                   .deliveries = frame.deliveries,
                   .receipt = std::to_string(turns_)};
    entry->taken.emplace(turn.receipt, TakenFrame{std::move(frame), Clock::now()});
    return std::optional(std::move(turn));
  }
}

Result<std::optional<std::string>> LocalJobs::request(const std::string& job) {
  const std::lock_guard lock(mutex_);
  const Entry* const entry = at(job);
  return entry == nullptr ? std::nullopt : std::optional(entry->job.request);
}

Result<bool> LocalJobs::renew(const FrameTurn& turn) {
  const std::lock_guard lock(mutex_);
  Entry* const entry = at(turn.job);
  if (entry == nullptr) return false;
  const auto taken = entry->taken.find(turn.receipt);
  if (taken == entry->taken.end()) return false;
  taken->second.renewed = Clock::now();
  return true;
}

Status LocalJobs::finish(const FrameTurn& turn, const JobFrame& frame) {
  std::unique_lock lock(mutex_);
  const auto wanted = [&]() -> Entry* {
    Entry* const entry = at(turn.job);
    return entry != nullptr && !entry->progress.isEnded() && !entry->kept.contains(turn.index) ? entry : nullptr;
  };
  Entry* entry = wanted();
  if (entry == nullptr) return Done{};
  const SharedUse bytes = bytesBeside(entry->job);
  const std::uint64_t own = bytesOf(entry->job, entry->progress) + frame.pictures.bytes().size();
  if (!mayTake(bytes, own, Share::threeQuarters)) {
    end(*entry, JobState::failed,
        {bytes.taken + own > bytes.capacity ? noRoomForFrame(limits_.bytes)
                                            : noShareOfBytes(ProblemCode::insufficientStorage, limits_.bytes)});
    return Done{};
  }
  const std::shared_ptr<ResultFile> file = entry->file;
  lock.unlock();
  const auto offset = file->add(frame.pictures.bytes().bytes());
  lock.lock();
  entry = wanted();
  if (entry == nullptr) return Done{};
  if (!offset) {
    end(*entry, JobState::failed, offset.problems());
    return Done{};
  }
  entry->kept.emplace(turn.index, KeptFrame{frame.note, *offset, frame.pictures.bytes().size()});
  entry->taken.erase(turn.receipt);
  std::erase_if(entry->taken, [&](const auto& taken) { return taken.second.frame.index == turn.index; });
  std::erase_if(entry->waiting, [&](const WaitingFrame& waiting) { return waiting.index == turn.index; });
  JobProgress& progress = entry->progress;
  progress.bytes += frame.pictures.bytes().size();
  ++progress.done;
  noteChange(*entry);
  if (progress.first + progress.done == progress.count) {
    end(*entry, JobState::done, {});
  } else if (entry->job.isChained) {
    entry->waiting.push_back({turn.index + 1, carriedAfter(turn.before, frame.note.carried)});
    queued_.notify_one();
  }
  return Done{};
}

Status LocalJobs::fail(const FrameTurn& turn, const Problems& problems) {
  const std::lock_guard lock(mutex_);
  Entry* const entry = at(turn.job);
  if (entry != nullptr && !entry->progress.isEnded() && !entry->kept.contains(turn.index)) {
    end(*entry, JobState::failed, problems);
  }
  return Done{};
}

Status LocalJobs::giveBack(const FrameTurn& turn, bool isTried) {
  const std::lock_guard lock(mutex_);
  Entry* const entry = at(turn.job);
  const auto taken = entry == nullptr ? std::map<std::string, TakenFrame>::iterator() : entry->taken.find(turn.receipt);
  if (entry == nullptr || taken == entry->taken.end()) return Done{};
  WaitingFrame frame = std::move(taken->second.frame);
  entry->taken.erase(taken);
  if (!isTried) --frame.deliveries;
  entry->waiting.push_front(std::move(frame));
  queued_.notify_one();
  return Done{};
}

Result<std::optional<JobProgress>> LocalJobs::find(const std::string& job) {
  const std::lock_guard lock(mutex_);
  dropOld();
  const Entry* const entry = at(job);
  return entry == nullptr ? std::nullopt : std::optional(entry->progress);
}

Result<std::vector<JobProgress>> LocalJobs::list(const std::optional<std::string>& key) {
  const std::lock_guard lock(mutex_);
  dropOld();
  std::vector<JobProgress> jobs;
  for (const Entry& entry : entries_) {
    if (!key || entry.job.key == *key) jobs.push_back(entry.progress);
  }
  return jobs;
}

const LocalJobs::KeptFrame* LocalJobs::keptAt(const std::string& job, int index) {
  const Entry* const entry = at(job);
  if (entry == nullptr) return nullptr;
  const auto kept = entry->kept.find(index);
  return kept == entry->kept.end() ? nullptr : &kept->second;
}

Result<std::optional<FrameNote>> LocalJobs::note(const std::string& job, int index) {
  const std::lock_guard lock(mutex_);
  const KeptFrame* const kept = keptAt(job, index);
  return kept == nullptr ? std::nullopt : std::optional(kept->note);
}

Result<std::optional<JobFrame>> LocalJobs::frame(const std::string& job, int index) {
  std::unique_lock lock(mutex_);
  const KeptFrame* const kept = keptAt(job, index);
  if (kept == nullptr) return std::optional<JobFrame>();
  const KeptFrame found = *kept;
  const std::shared_ptr<ResultFile> file = at(job)->file;
  lock.unlock();
  auto bytes = file->read(found.offset, found.size);
  if (!bytes) return Problem{ProblemCode::unavailable, "", "The disk does not give the frame back.", "", ""};
  auto pictures = FramePictures::of(found.note.pictures, *std::move(bytes));
  if (!pictures) return std::move(pictures).problems();
  return std::optional(JobFrame{found.note, *std::move(pictures)});
}

Result<bool> LocalJobs::remove(const std::string& job) {
  const std::lock_guard lock(mutex_);
  return entries_.remove_if([&](const Entry& entry) { return entry.job.id == job; }) > 0;
}

Result<JobsSize> LocalJobs::size() {
  const std::lock_guard lock(mutex_);
  dropOld();
  JobsSize size{.jobs = entries_.size()};
  for (const Entry& entry : entries_) {
    const JobProgress& progress = entry.progress;
    size.bytes += bytesOf(entry.job, progress);
    if (!progress.isEnded()) size.framesLeft += progress.count - progress.first - progress.done;
  }
  return size;
}

} // namespace gnomon
