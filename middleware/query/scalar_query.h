// middleware/query/scalar_query.h: a query the plain way, link by link, in doubles: the reference
// for lane queries, and the only way for skins. Not installed.
#pragma once

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "middleware/contact.h"
#include "middleware/query/body.h"
#include "middleware/query/query_scratch.h"
#include "middleware/query/work_meter.h"
#include "middleware/query_options.h"
#include "middleware/scene/culler.h"
#include "middleware/scene/scene.h"

namespace foretouch::internal {

/// Answers every link of `step`. Preconditions: the options are valid; `meter` started with the
/// query.
void scalarQuery(const Body& body, const ChainMotion& motion, const Scene& scene,
                 const QueryOptions& options, const TriangleCuller& culler, const WorkMeter& meter,
                 ScratchParts& scratch, StepContacts& step);

}  // namespace foretouch::internal
