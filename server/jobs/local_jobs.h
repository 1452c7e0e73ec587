#pragma once

#include <condition_variable>
#include <deque>
#include <list>
#include <map>
#include <mutex>

#include "server/jobs/job_queue.h"
#include "server/jobs/result_file.h"
#include "server/system/clock.h"
#include "server/system/fair_shares.h"

namespace gnomon {

/// The queue of one process. Jobs go with it; their pictures are files without a name, in a directory or in memory.
class LocalJobs final : public JobQueue {
 public:
  /// `directory`: empty = pictures are in memory.
  LocalJobs(JobLimits limits, std::string directory) : limits_(limits), directory_(std::move(directory)) {}

  Status put(const NewJob& job) override;
  Result<std::optional<FrameTurn>> take(std::chrono::milliseconds patience) override;
  Result<std::optional<std::string>> request(const std::string& job) override;
  Result<bool> renew(const FrameTurn& turn) override;
  Status finish(const FrameTurn& turn, const JobFrame& frame) override;
  Status fail(const FrameTurn& turn, const Problems& problems) override;
  Status giveBack(const FrameTurn& turn, bool isTried) override;
  Result<std::optional<JobProgress>> find(const std::string& job) override;
  Result<std::vector<JobProgress>> list(const std::optional<std::string>& key) override;
  Result<std::optional<FrameNote>> note(const std::string& job, int index) override;
  Result<std::optional<JobFrame>> frame(const std::string& job, int index) override;
  Result<bool> remove(const std::string& job) override;
  Result<JobsSize> size() override;

 private:
  struct WaitingFrame {
    int index = 0;
    Carried before{};
    int deliveries = 0; ///< how often it was taken
  };
  struct TakenFrame {
    WaitingFrame frame;
    Clock::time_point renewed;
  };
  struct KeptFrame {
    FrameNote note;
    std::uint64_t offset = 0;
    std::size_t size = 0;
  };
  struct Entry {
    NewJob job;
    JobProgress progress;
    std::shared_ptr<ResultFile> file;
    std::deque<WaitingFrame> waiting{};
    std::map<std::string, TakenFrame> taken{}; ///< by receipt
    std::map<int, KeptFrame> kept{};
    std::uint64_t turn = 0;                   ///< when a frame of it was taken last; 0 = never
    Clock::time_point changed = Clock::now(); ///< progress.changed, by a clock that is never set
  };
  using Entries = std::list<Entry>;

  // With the mutex held
  Entry* at(const std::string& job);
  const KeptFrame* keptAt(const std::string& job, int index);
  SharedUse bytesBeside(const NewJob& job) const;
  void dropOld();
  void takeBackSilent();
  Entry* nextInTurn();
  static void noteChange(Entry& entry);
  void end(Entry& entry, JobState state, const Problems& problems);

  const JobLimits limits_;
  const std::string directory_;
  std::mutex mutex_;
  std::condition_variable queued_;
  Entries entries_; ///< the newest first
  std::uint64_t turns_ = 0;
};

} // namespace gnomon
