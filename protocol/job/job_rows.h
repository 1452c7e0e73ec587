#pragma once

#include "protocol/job/job.h"
#include "protocol/json/problem_rows.h"

/// The rows of a job's answers; see fields.h.
namespace gnomon {

template <>
inline constexpr std::array kSpellings<JobState>{
    spelling(JobState::queued, "queued", "no frame was begun"),
    spelling(JobState::running, "running", "some frames were begun"),
    spelling(JobState::done, "done", "all frames are drawn"),
    spelling(JobState::failed, "failed", "a frame could not be drawn"),
    spelling(JobState::cancelled, "cancelled", "it was removed while a client waited for it"),
};
static_assert(spellsAll<JobState>());

template <>
inline constexpr auto kRows<Job> = replyRows(
    "Job", "A sequence that is drawn in the background.",
    field("id", &Job::id, {.says = "Names the job; not guessable."}),
    field("state", &Job::state, {.says = "State of the job."}),
    field("scene", &Job::scene, {.says = "Id of its scene."}),
    field("first", &Job::first, {.says = "Index of the first frame that is drawn."}),
    field("done", &Job::done, {.says = "Frames that are drawn."}),
    field("of", &Job::of, {.says = "Frames that are to be drawn; the last index is `first` + `of` - 1."}),
    field("bytes", &Job::bytes, {.says = "Size of the pictures so far.", .unit = "bytes"}),
    field("created", &Job::created, {.says = "When it was requested; RFC 3339, in UTC, as all its times."}),
    field("started", &Job::started, {.says = "When its first frame was begun; absent = not yet."}),
    field("ended", &Job::ended, {.says = "When it was done or failed; absent = not yet."}),
    field("expires", &Job::expires, {.says = "When it is removed with its pictures, if no further frame is drawn."}),
    field("problems", &Job::problems, {.says = "Why it failed; pointers are places in the request for the sequence."}),
    field("address", &Job::address, {.says = "Address of the job."}),
    field("result", &Job::result, {.says = "Address of all frames, in the forms of a sequence."}),
    field("frames", &Job::frames, {.says = "Address of one frame, with its index for `{index}`."}));
static_assert(kRowsAreComplete<Job>);

template <>
inline constexpr auto kRows<JobList> = replyRows("JobList", "Jobs.",
                                                 field("jobs", &JobList::jobs,
                                                       {.says = "Those of the client's key, the newest first."}));
static_assert(kRowsAreComplete<JobList>);

} // namespace gnomon
