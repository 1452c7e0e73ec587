#pragma once

#include "protocol/job/job.h"
#include "protocol/json/problem_rows.h"

/// The rows of a job's answers; see fields.h.
namespace gnomon {

template <>
inline constexpr std::array kSpellings<JobState>{
    spelling<JobState::queued>("no frame was begun"),
    spelling<JobState::running>("some frames were begun"),
    spelling<JobState::done>("all frames are drawn"),
    spelling<JobState::failed>("a frame could not be drawn"),
    spelling<JobState::cancelled>("it was removed while a client waited for it"),
};

template <>
inline constexpr auto kRows<Job> = replyRows(
    "Job", "A sequence that is drawn in the background.", field<&Job::id>("Names the job; not guessable."),
    field<&Job::state>("State of the job."), field<&Job::scene>("Id of its scene."),
    field<&Job::key>("Name of the key that asked for it; absent = the server has no keys."),
    field<&Job::first>("Index of the first frame that is drawn."), field<&Job::done>("Frames that are drawn."),
    field<&Job::of>("Frames that are to be drawn; the last index is `first` + `of` - 1."),
    field<&Job::bytes>("Size of the pictures so far.", {.unit = "bytes"}),
    field<&Job::created>("When it was requested; RFC 3339, in UTC, as all its times."),
    field<&Job::started>("When its first frame was begun; absent = not yet."),
    field<&Job::ended>("When it was done or failed; absent = not yet."),
    field<&Job::expires>("When it is removed with its pictures, if no further frame is drawn."),
    field<&Job::problems>("Why it failed; pointers are places in the request for the sequence."),
    field<&Job::address>("Address of the job."),
    field<&Job::result>("Address of all frames, in the forms of a sequence."),
    field<&Job::frames>("Address of one frame, with its index for `{index}`."));

template <>
inline constexpr auto kRows<JobList> = replyRows(
    "JobList", "Jobs.",
    field<&JobList::jobs>("Those of the client's key, or all where it has the scope `admin`, the newest first."));

} // namespace gnomon
