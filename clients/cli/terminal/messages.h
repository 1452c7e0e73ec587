#pragma once

#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "protocol/base/result.h"

namespace gnomon::cli {

/// JSON pointer of the spec -> the flag that set it, so that a problem can name what the user typed.
using FlagOrigins = std::map<std::string, std::string>;

/// One line: "--sun (/lights/0/sun/elevationDegrees): what is wrong; allowed: -90..90; got: 100". Control characters
/// in what came from elsewhere are replaced, so that a file or a server can't write to the terminal.
std::string problemLine(const Problem& problem, const FlagOrigins& origins = {});

/// The same problems, each saying first what it is about.
Problems about(const std::string& what, Problems problems);

/// The problems of loading a scene, where those that have no place in it get its file as their place.
Problems ofScene(const std::string& file, Problems problems);

/// Form of problems on standard error.
enum class ProblemForm { lines, json };

/// Settings of all messages, set before any command runs.
void setProblemForm(ProblemForm form);
void showNoProgress();
/// Origins of the flags that were not typed; a problem of such a flag names its origin.
void setFlagOrigins(std::map<std::string, std::string> flags);

/// As an RFC 9457 body of one line, each problem with the flag that set its pointer, and that
/// flag's origin if it was not typed.
std::string problemsAsJson(const Problems& problems, const FlagOrigins& origins = {});

/// Every problem on its line on stderr, each after "gnomon: "; or all as JSON on one line. Gives kExitProblem.
int printProblems(const Problems& problems, const FlagOrigins& origins = {});

/// Every warning on its line on stderr, each after "gnomon: warning: "; or all as JSON on one line.
void printWarnings(const std::vector<std::string>& warnings);

/// The text with every control character replaced, so that what a file or a server says can't steer the terminal.
std::string printable(std::string text);

/// Progress of the current work on stderr: a spinner, the stage, a bar where the share is known, the
/// seconds so far. Only on a terminal; anywhere else it writes nothing and starts no thread.
class ProgressLine {
 public:
  explicit ProgressLine(bool shown);
  static ProgressLine onTerminal(); ///< shown when stderr is a terminal
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void stage(const std::string& name); ///< the stage that begins now; the one before is done
  void share(double done);             ///< of the stage, 0..1
  void lead(const std::string& text);  ///< prefix of every later stage: "3 of 12: "
  void finish();                       ///< clears the line; call before anything else is printed

 private:
  void draw();
  void run();

  using Clock = std::chrono::steady_clock;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::string lead_;
  std::string stage_;         // empty = nothing to show
  double share_ = -1;         // < 0 = not known
  Clock::time_point started_; // of the stage
  std::size_t frame_ = 0;     // of the spinner
  bool stopping_ = false;
  std::thread thread_;
};

} // namespace gnomon::cli
