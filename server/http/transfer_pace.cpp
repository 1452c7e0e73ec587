#include "server/http/transfer_pace.h"

#include <algorithm>

namespace gnomon {
namespace {

constexpr std::chrono::milliseconds kMost{10'000};  ///< what it can have earned then
constexpr std::chrono::milliseconds kLook{200};     ///< between two looks at the budget
constexpr std::chrono::milliseconds kNotice{4'000}; ///< for a transfer to show its speed once others wait

} // namespace

void PaceMeter::moved(std::size_t bytes, Clock::time_point now) {
  const double seconds =
      static_cast<double>(bytes) / static_cast<double>(std::max<std::size_t>(pace_.bytesPerSecond, 1));
  const std::chrono::duration<double> most = pace_.most;
  const auto earned = std::min(std::chrono::duration<double>(seconds), most);
  deadline_ = std::min(deadline_ + std::chrono::duration_cast<Clock::duration>(earned), now + pace_.most);
}

void TransferPace::moved(std::size_t bytes, Clock::time_point now) {
  least_.moved(bytes, now);
  if (hurried_) hurried_->moved(bytes, now);
}

void TransferPace::paused(Clock::duration time) {
  least_.paused(time);
  if (hurried_) hurried_->paused(time);
}

TransferState TransferPace::state(Clock::time_point now) {
  if (now >= least_.deadline()) return TransferState::tooSlow;
  if (budgets_.empty() || now < lookAgain_) return TransferState::goesOn;
  lookAgain_ = now + kLook;
  ByteBudget* wanted = nullptr; ///< by those who wait, most urgently
  std::size_t speed = 0;
  for (ByteBudget* const each : budgets_) {
    if (const std::size_t own = each->hurry(holder_, now); own > speed) wanted = each, speed = own;
  }
  if (wanted == nullptr) {
    hurried_.reset();
    return TransferState::goesOn;
  }
  if (!hurried_) hurried_.emplace(Pace{kNotice, kMost, speed}, now);
  hurried_->setSpeed(speed);
  const bool isLate = now >= hurried_->deadline();
  return isLate && wanted->mayEndOne(now) ? TransferState::othersWaited : TransferState::goesOn;
}

Clock::time_point TransferPace::wait(Clock::time_point now) const {
  return std::min(least_.deadline(), budgets_.empty() ? now + kLook : std::max(lookAgain_, now));
}

} // namespace gnomon
