#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "clients/cli/commands/commands.h"
#include "clients/cli/commands/spec_flags.h"
#include "clients/cli/files/file_io.h"
#include "clients/cli/remote/http_client.h"
#include "clients/cli/remote/remote_scene.h"
#include "clients/cli/terminal/messages.h"
#include "protocol/base/bytes.h"
#include "protocol/job/job.h"
#include "protocol/job/job_rows.h"

/// The jobs of a server.
namespace gnomon::cli {
namespace {

struct JobsOptions {
  std::string action;
  std::string id;
  std::string output; ///< of fetch
  WhereOptions where;
};

std::string jobLine(const Job& job) {
  return printable(job.id + "  " + std::string(spell(job.state)) + "  " + std::to_string(job.done) + "/" +
                   std::to_string(job.of) + " frames  " + std::to_string(job.bytes) + " bytes  " + job.created +
                   (job.key ? "  " + *job.key : ""));
}

Problem noJob(const Remote& remote) {
  return {ProblemCode::internal, remote.url, "The reply is not a job."};
}

Result<Job> jobFrom(const Remote& remote, const std::string& path, ProgressLine& progress) {
  HttpCall call;
  call.path = path;
  const auto reply = callPatiently(remote, call, progress);
  if (!reply) return reply.problems();
  if (reply->status != 200) return problemsOf(remote.url, *reply);
  auto job = readJob(reply->body);
  if (!job) return noJob(remote);
  return *std::move(job);
}

std::string pathOf(const JobsOptions& options) {
  return "/v1/jobs/" + options.id;
}

/// Says why it has no further frames.
int endOf(const Job& job) {
  if (job.state == JobState::failed) return printProblems(job.problems);
  if (job.state == JobState::cancelled) {
    return printProblems({{ProblemCode::notFound, "id", "The job was removed.", "", job.id}});
  }
  return kExitOk;
}

int listJobs(const JobsOptions&, const Remote& remote, ProgressLine& progress) {
  HttpCall call;
  call.path = "/v1/jobs";
  const auto reply = callPatiently(remote, call, progress);
  progress.finish();
  if (!reply) return printProblems(reply.problems());
  if (reply->status != 200) return printProblems(problemsOf(remote.url, *reply));
  const auto list = readJobList(reply->body);
  if (!list) return printProblems({noJob(remote)});
  for (const Job& job : list->jobs) std::cout << jobLine(job) << '\n';
  return kExitOk;
}

int showJob(const JobsOptions& options, const Remote& remote, ProgressLine& progress) {
  const auto job = jobFrom(remote, pathOf(options), progress);
  progress.finish();
  if (!job) return printProblems(job.problems());
  std::cout << toJson(*job).dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
  return kExitOk;
}

int waitForJob(const JobsOptions& options, const Remote& remote, ProgressLine& progress) {
  progress.stage("waiting for the job");
  while (true) {
    const auto job = jobFrom(remote, pathOf(options) + "?wait=1", progress);
    if (!job) {
      progress.finish();
      return printProblems(job.problems());
    }
    progress.share(job->of > 0 ? static_cast<double>(job->done) / job->of : 1);
    if (job->state == JobState::queued || job->state == JobState::running) continue;
    progress.finish();
    std::cout << jobLine(*job) << '\n';
    return endOf(*job);
  }
}

/// The ZIP as it comes, under its name once it is whole.
int fetchJob(const JobsOptions& options, const Remote& remote, ProgressLine& progress) {
  const auto fail = [&](const Problems& problems) {
    progress.finish();
    return printProblems(problems);
  };
  std::optional<NewFile> file;
  Status written = Done{};
  const auto begin = [&] {
    auto made = NewFile::create(options.output);
    if (made) file.emplace(*std::move(made));
    if (!made) written = made.problems();
  };
  begin();
  if (!written) return fail(written.problems());
  progress.stage("fetching the frames");
  HttpCall call;
  call.path = pathOf(options) + "/result";
  call.headers = {{"Accept", "application/zip"}};
  call.onReceived = [&](std::string_view bytes) {
    if (written) written = file->write(asBytes(bytes));
  };
  call.onRestart = begin;
  const auto reply = callPatiently(remote, call, progress);
  if (!reply) return fail(reply.problems());
  if (reply->status != 200) return fail(problemsOf(remote.url, *reply));
  if (!written) return fail(written.problems());
  if (auto finished = file->finish(); !finished) return fail(finished.problems());
  const auto job = jobFrom(remote, pathOf(options), progress);
  progress.finish();
  if (!job) return printProblems(job.problems());
  std::cout << job->done << " frames\n";
  return endOf(*job);
}

int cancelJob(const JobsOptions& options, const Remote& remote, ProgressLine& progress) {
  HttpCall call;
  call.method = "DELETE";
  call.path = pathOf(options);
  const auto reply = callPatiently(remote, call, progress);
  progress.finish();
  if (!reply) return printProblems(reply.problems());
  if (reply->status != 204) return printProblems(problemsOf(remote.url, *reply));
  return kExitOk;
}

struct ActionRow {
  const char* name;
  bool needsJob;
  int (*run)(const JobsOptions&, const Remote&, ProgressLine&);
};

constexpr std::array kActions{ActionRow{"ls", false, listJobs}, ActionRow{"show", true, showJob},
                              ActionRow{"wait", true, waitForJob}, ActionRow{"fetch", true, fetchJob},
                              ActionRow{"cancel", true, cancelJob}};

const ActionRow* actionOf(const JobsOptions& options) {
  const auto* found =
      std::find_if(kActions.begin(), kActions.end(), [&](const ActionRow& row) { return row.name == options.action; });
  return found == kActions.end() ? nullptr : found;
}

void checkArguments(const JobsOptions& options) {
  const ActionRow* const action = actionOf(options);
  if (action == nullptr) return; // already reported
  const bool isId = options.id.size() == 32 && options.id.find_first_not_of("0123456789abcdef") == std::string::npos;
  if (action->needsJob && !isId) throw CLI::ValidationError("id", "needs a job's id, 32 hexadecimal digits");
  if (!action->needsJob && !options.id.empty()) throw CLI::ValidationError("id", "ls takes none");
  const bool fetches = options.action == "fetch";
  if (fetches == options.output.empty()) {
    throw CLI::ValidationError("--output", fetches ? "fetch needs a file for the ZIP" : "goes with fetch");
  }
}

int runJobs(const JobsOptions& options) {
  const auto remote = remoteOf(options.where);
  if (!remote) return printProblems(remote.problems());
  auto progress = ProgressLine::onTerminal();
  return actionOf(options)->run(options, *remote, progress);
}

} // namespace

Subcommand addJobsCommand(CLI::App& app) {
  auto options = std::make_shared<JobsOptions>();
  auto* command = app.add_subcommand("jobs", "List, watch, fetch and cancel the jobs of a server");
  command
      ->add_option("action", options->action,
                   "ls = list them; show = print one as JSON; wait = until it has ended; fetch = its frames as a ZIP; "
                   "cancel = end it and remove its frames")
      ->required()
      ->check(CLI::IsMember({"ls", "show", "wait", "fetch", "cancel"}));
  command->add_option("id", options->id, "The job's id, from sequence --async or ls");
  command->add_option("-o,--output", options->output, "With fetch: the ZIP")->type_name("FILE");
  options->where.server = "http://127.0.0.1:8080";
  addServerFlags(*command, options->where);
  command->get_option("--server")->capture_default_str();
  command->parse_complete_callback([options] { checkArguments(*options); });
  return {[command] { return command->parsed(); }, [options] { return runJobs(*options); }};
}

} // namespace gnomon::cli
