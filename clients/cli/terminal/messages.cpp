#include "clients/cli/terminal/messages.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "clients/cli/commands/commands.h"
#include "protocol/json/json_codec.h"

namespace gnomon::cli {
namespace {

/// Settings of messages, shared by all commands and passed to none.
struct Manners {
  ProblemForm problems = ProblemForm::lines;
  bool quiet = false;
  std::map<std::string, std::string> places; ///< of flags that a configuration sets
};

Manners& manners() {
  static Manners ours;
  return ours;
}

/// Origin of a flag that was not typed; empty for others.
std::string placeOf(const std::string& flag) {
  const auto place = manners().places.find(flag);
  return place == manners().places.end() ? "" : place->second;
}

/// The flag that set this place or something that holds it.
std::string originOf(std::string pointer, const FlagOrigins& origins) {
  while (!pointer.empty()) {
    if (const auto found = origins.find(pointer); found != origins.end()) return found->second;
    const auto slash = pointer.rfind('/');
    if (slash == std::string::npos) break;
    pointer.erase(slash);
  }
  return "";
}

} // namespace

std::string problemLine(const Problem& problem, const FlagOrigins& origins) {
  std::string line;
  const std::string flag = originOf(problem.pointer, origins);
  const std::string place = placeOf(flag);
  if (!flag.empty()) line += flag + (place.empty() ? "" : " of " + place) + " (" + problem.pointer + "): ";
  if (flag.empty() && !problem.pointer.empty()) line += problem.pointer + ": ";
  line += problem.detail;
  if (!problem.limit.empty()) line += " Allowed: " + problem.limit + ".";
  if (!problem.actual.empty()) line += " Got: " + problem.actual + ".";
  return printable(line);
}

Problems about(const std::string& what, Problems problems) {
  for (Problem& problem : problems) problem.detail = "(" + what + ") " + problem.detail;
  return problems;
}

Problems ofScene(const std::string& file, Problems problems) {
  for (Problem& problem : problems) {
    const bool isOfFile = problem.code == ProblemCode::malformed || problem.code == ProblemCode::invalidScene ||
                          problem.code == ProblemCode::unsupportedFeature;
    if (isOfFile && problem.pointer.empty()) problem.pointer = file == "-" ? "standard input" : file;
  }
  return problems;
}

void setProblemForm(ProblemForm form) {
  manners().problems = form;
}

void showNoProgress() {
  manners().quiet = true;
}

void setFlagOrigins(std::map<std::string, std::string> flags) {
  manners().places = std::move(flags);
}

std::string problemsAsJson(const Problems& problems, const FlagOrigins& origins) {
  Json json = problemJson(problems, 0, "");
  json.erase("status"); // of HTTP
  for (std::size_t i = 0; i < problems.size() && i < json["problems"].size(); ++i) {
    const std::string flag = originOf(problems[i].pointer, origins);
    if (!flag.empty()) json["problems"][i]["flag"] = flag;
    if (const std::string place = placeOf(flag); !place.empty()) json["problems"][i]["place"] = place;
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

int printProblems(const Problems& problems, const FlagOrigins& origins) {
  if (manners().problems == ProblemForm::json) {
    std::cerr << problemsAsJson(problems, origins) + "\n";
    return kExitProblem;
  }
  for (const Problem& problem : problems) std::cerr << "gnomon: " << problemLine(problem, origins) << '\n';
  return kExitProblem;
}

void printWarnings(const std::vector<std::string>& warnings) {
  if (warnings.empty()) return;
  if (manners().problems == ProblemForm::json) {
    std::cerr << Json{{"warnings", warnings}}.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
    return;
  }
  for (const std::string& warning : warnings) std::cerr << "gnomon: warning: " + printable(warning) + "\n";
}

std::string printable(std::string text) {
  const auto isControl = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
  std::replace_if(text.begin(), text.end(), isControl, '?');
  return text;
}

namespace {

constexpr std::array kSpinner{"⠋", "⠙", "⠹", "⠸", "⠼", "⠴", "⠦", "⠧", "⠇", "⠏"};
constexpr int kBarWidth = 24;
constexpr std::chrono::milliseconds kTick{80};
constexpr const char* kClearLine = "\r\x1b[K";

std::string bar(double share) {
  const int filled = static_cast<int>(std::clamp(share, 0.0, 1.0) * kBarWidth);
  std::string text = " ";
  for (int i = 0; i < kBarWidth; ++i) text += i < filled ? "━" : "─";
  return text + " " + std::to_string(static_cast<int>(share * 100)) + " %";
}

} // namespace

ProgressLine::ProgressLine(bool shown) {
  if (shown) thread_ = std::thread([this] { run(); });
}

ProgressLine ProgressLine::onTerminal() {
  return ProgressLine(!manners().quiet && ::isatty(STDERR_FILENO) == 1);
}

ProgressLine::~ProgressLine() {
  finish();
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void ProgressLine::stage(const std::string& name) {
  const std::lock_guard lock(mutex_);
  stage_ = name;
  share_ = -1;
  started_ = Clock::now();
  draw();
}

void ProgressLine::share(double done) {
  const std::lock_guard lock(mutex_);
  share_ = done;
}

void ProgressLine::lead(const std::string& text) {
  const std::lock_guard lock(mutex_);
  lead_ = printable(text);
}

void ProgressLine::finish() {
  const std::lock_guard lock(mutex_);
  if (!stage_.empty() && thread_.joinable()) std::fputs(kClearLine, stderr);
  stage_.clear();
}

/// With the mutex held.
void ProgressLine::draw() {
  if (stage_.empty() || !thread_.joinable()) return;
  const double seconds = std::chrono::duration<double>(Clock::now() - started_).count();
  std::fprintf(stderr, "%s%s %s%s%s  %.1f s", kClearLine, kSpinner[frame_ % kSpinner.size()], lead_.c_str(),
               stage_.c_str(), share_ < 0 ? "" : bar(share_).c_str(), seconds);
  std::fflush(stderr);
}

void ProgressLine::run() {
  std::unique_lock lock(mutex_);
  while (!changed_.wait_for(lock, kTick, [this] { return stopping_; })) {
    ++frame_;
    draw();
  }
}

} // namespace gnomon::cli
