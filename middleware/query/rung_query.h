// middleware/query/rung_query.h: a query above link fidelity: the step's volumes, their first
// contacts, and the verdicts of the links they cover. Not installed.
#pragma once

#include "articulated/motion.h"
#include "middleware/contact.h"
#include "middleware/query/query_plan.h"
#include "middleware/query/query_scratch.h"
#include "middleware/query/work_meter.h"

namespace foretouch::internal {

/// Answers every link of `step`. Preconditions: isRung(plan.options.fidelity); `meter` started with
/// the query.
void rungQuery(const QueryPlan& plan, const ChainMotion& motion, const WorkMeter& meter,
               ScratchParts& scratch, StepContacts& step);

/// Does the volume that covers the link touch a triangle at `t`?
[[nodiscard]] bool rungTouchesAt(const QueryPlan& plan, const ChainMotion& motion, LinkId link,
                                 double t, ScratchParts& scratch);

}  // namespace foretouch::internal
