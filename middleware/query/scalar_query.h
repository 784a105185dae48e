// middleware/query/scalar_query.h: a query the plain way, link by link, in doubles: the only way
// for more LSS than lanes take, and what lanes are held against. Not installed.
#pragma once

#include "articulated/motion.h"
#include "middleware/contact.h"
#include "middleware/pair/query_plan.h"
#include "middleware/pair/work_meter.h"
#include "middleware/query/body.h"
#include "middleware/scratch.h"

namespace foretouch::internal {

/// Answers every link of `step`. Precondition: `meter` started with the query.
void scalarQuery(const QueryPlan& plan, const Body& body, const ChainMotion& motion,
                 const WorkMeter& meter, QueryMemory& scratch, StepContacts& step);

}  // namespace foretouch::internal
