// middleware/scalar_query.h: a query the plain way, link by link, in doubles: the reference that
// lane queries are held against, and the only way for skins and work budgets. Not installed.
#pragma once

#include "middleware/body.h"
#include "middleware/culler.h"
#include "middleware/query.h"

namespace foretouch::internal {

/// Fills `step`, whose links are all Clear. The options have been checked.
void scalarQuery(const Body& body, const ChainMotion& motion, const Scene& scene,
                 const QueryOptions& options, const TriangleCuller& culler,
                 QueryScratch::Impl& scratch, StepContacts& step);

}  // namespace foretouch::internal
