// middleware/query/rung_query.h: a query above link fidelity: the step's volumes, their first
// contacts, and the verdicts of the links they cover. Not installed.
#pragma once

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "middleware/contact.h"
#include "middleware/query/query_scratch.h"
#include "middleware/query/work_meter.h"
#include "middleware/query_options.h"
#include "middleware/scene/culler.h"
#include "middleware/scene/scene.h"

namespace foretouch::internal {

/// Answers every link of `step`. Preconditions: the options are valid, isRung(options.fidelity);
/// `meter` started with the query.
void rungQuery(const Avatar& avatar, const ChainMotion& motion, const Scene& scene,
               const QueryOptions& options, const TriangleCuller& culler, const WorkMeter& meter,
               ScratchParts& scratch, StepContacts& step);

/// Does the volume that covers the link touch a triangle at `t`?
[[nodiscard]] bool rungTouchesAt(const Avatar& avatar, const ChainMotion& motion, LinkId link,
                                 double t, const Scene& scene, const QueryOptions& options,
                                 ScratchParts& scratch);

}  // namespace foretouch::internal
