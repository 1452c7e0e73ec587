#include "protocol/bake/bake_rows.h"
#include "protocol/evaluation/evaluation_rows.h"
#include "protocol/fields/type_tables.h"
#include "protocol/job/job_rows.h"
#include "protocol/report/reply_rows.h"
#include "protocol/sequence/sequence_rows.h"

namespace gnomon {

template const ValueType& typeOf<double>();

template const ValueType& typeOf<AnimationMoment>();
template const ValueType& typeOf<Camera>();
template const ValueType& typeOf<FrameSpec>();
template const ValueType& typeOf<Light>();

template const ValueType& typeOf<Capabilities>();
template const ValueType& typeOf<ErrorMetrics>();
template const ValueType& typeOf<FrameReply>();
template const ValueType& typeOf<FrameReport>();
template const ValueType& typeOf<NodeList>();
template const ValueType& typeOf<NodePage>();
template const ValueType& typeOf<PlanReport>();
template const ValueType& typeOf<QualityReport>();
template const ValueType& typeOf<RendererInfo>();
template const ValueType& typeOf<SceneList>();
template const ValueType& typeOf<SceneSummary>();

template const ValueType& typeOf<BakeReport>();
template const ValueType& typeOf<BakeStep>();

template const ValueType& typeOf<EvaluationReport>();
template const ValueType& typeOf<EvaluationRequest>();
template const ValueType& typeOf<EvaluationRow>();
template const ValueType& typeOf<EvaluationStep>();

template const ValueType& typeOf<Job>();
template const ValueType& typeOf<JobList>();

template const ValueType& typeOf<Carried>();
template const ValueType& typeOf<SequenceFrame>();
template const ValueType& typeOf<SequenceReport>();
template const ValueType& typeOf<SequenceRequest>();

} // namespace gnomon
