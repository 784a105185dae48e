// middleware/query/query.h: the question Foretouch answers: what does each link meet first between
// two poses? Lengths in metres in the world W; t is normalised, 0 at the earlier pose and 1 at the
// later. The promise, its proof and the constants in it: docs/guarantees.md.
#pragma once

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "articulated/result.h"
#include "middleware/contact.h"
#include "middleware/query/query_scratch.h"
#include "middleware/query_options.h"
#include "middleware/scene/scene.h"

namespace foretouch {

/// The first contact of every link of `avatar` while it moves as `motion` says. Errors are bad
/// options (tolerance, a policy or an ignored pair out of range) or a motion of another avatar.
/// Geometry never produces one: see Verdict. The first form fills `step` and allocates nothing once
/// scratch and step have grown to the scene's needs. If it fails, every link of `step` is
/// Undecided, free until 0.
[[nodiscard]] Result<Done> firstContacts(const Avatar& avatar, const ChainMotion& motion,
                                         const Scene& scene, const QueryOptions& options,
                                         QueryScratch& scratch, StepContacts& step);
[[nodiscard]] Result<StepContacts> firstContacts(const Avatar& avatar, const ChainMotion& motion,
                                                 const Scene& scene, const QueryOptions& options,
                                                 QueryScratch& scratch);
[[nodiscard]] Result<StepContacts> firstContacts(const Avatar& avatar, const ChainMotion& motion,
                                                 const Scene& scene,
                                                 const QueryOptions& options = {});

/// What a discrete check sees: does the link's surface touch a triangle at this one instant? It
/// skips ignored pairs. The computed distance decides (no claim within rounding of zero).
[[nodiscard]] bool touchesAt(const Avatar& avatar, const ChainMotion& motion, LinkId link, double t,
                             const Scene& scene, const QueryOptions& options,
                             QueryScratch& scratch);

}  // namespace foretouch
