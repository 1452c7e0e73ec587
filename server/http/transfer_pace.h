#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "server/system/byte_budget.h"
#include "server/system/clock.h"

namespace gnomon {

/// How slowly a client may send a body or take a reply. Each byte that moves earns the time that it takes at the least
/// speed; a client has only as much time as it has earned. A steady reader's bytes move in steps: its kernel asks for
/// more once a sixteenth of its buffer is free, of 6 MB some 400 KB, which are 20 s at 20 KiB a second.
struct Pace {
  std::chrono::milliseconds first{5'000}; ///< what it has at the beginning
  std::chrono::milliseconds most{20'000}; ///< what it can have earned
  std::size_t bytesPerSecond = 16 * 1024; ///< the least speed
};

/// The time that one transfer has left.
class PaceMeter {
 public:
  PaceMeter(const Pace& pace, Clock::time_point start) : pace_(pace), deadline_(start + pace.first) {}

  void moved(std::size_t bytes, Clock::time_point now);

  /// Time in which nothing was there to be moved.
  void paused(Clock::duration time) { deadline_ += time; }

  void setSpeed(std::size_t bytesPerSecond) { pace_.bytesPerSecond = bytesPerSecond; }

  /// When the transfer is too slow unless further bytes move.
  Clock::time_point deadline() const { return deadline_; }

 private:
  Pace pace_;
  Clock::time_point deadline_;
};

/// Whether a transfer may go on.
enum class TransferState {
  goesOn,
  tooSlow,     ///< slower than its pace
  othersWaited ///< its client held most bytes while other clients waited for some, and it would not have been done soon
};

/// Holds one transfer to its pace, and to the one that a budget asks for while other clients wait.
class TransferPace {
 public:
  /// `budgets`: of which `holder` holds bytes until the transfer ends; they outlive this.
  TransferPace(const Pace& pace, std::vector<ByteBudget*> budgets, Holder holder,
               Clock::time_point start = Clock::now())
      : budgets_(std::move(budgets)), holder_(std::move(holder)), least_(pace, start), lookAgain_(start) {}

  void moved(std::size_t bytes, Clock::time_point now);
  void paused(Clock::duration time);

  /// Is asked again by wait(), whether bytes move or not.
  TransferState state(Clock::time_point now);
  Clock::time_point wait(Clock::time_point now) const;

 private:
  const std::vector<ByteBudget*> budgets_;
  const Holder holder_;
  PaceMeter least_;
  std::optional<PaceMeter> hurried_; ///< while others wait
  Clock::time_point lookAgain_;      ///< when the budgets are asked next
};

} // namespace gnomon
