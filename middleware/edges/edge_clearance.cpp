// How near edges come: EdgeQuery::clearance() and clearanceAll().

#include <algorithm>
#include <string>

#include "articulated/try.h"
#include "lss/rounding.h"
#include "middleware/edges/edge_memory.h"
#include "middleware/edges/edge_query.h"
#include "middleware/edges/edge_tasks.h"
#include "middleware/near/clearance_search.h"

namespace foretouch {
namespace {

using internal::ClearanceMemory;
using internal::ClearanceSearch;
using internal::EdgeMemory;

void moveToWorld(const RigidPose& X_WP, Clearance& clearance) {
  clearance.p_WScene = X_WP.rotation * clearance.p_WScene + X_WP.translation;
  clearance.p_WLink = X_WP.rotation * clearance.p_WLink + X_WP.translation;
  clearance.nhat_SL_W = X_WP.rotation * clearance.nhat_SL_W;
}

}  // namespace

Result<EdgeClearance> EdgeQuery::clearance(const double* q0, const double* q1, std::size_t count,
                                           Scratch& scratch, double* slope0, double* slope1) const {
  FORETOUCH_CHECK(robot_->checked(q0, count));
  FORETOUCH_CHECK(robot_->checked(q1, count));
  const int parts = robot_->partsBetween(q0, q1, kMostParts);
  if (parts == 0) {
    return Error::in("q", ErrorCode::LimitExceeded,
                     "expected an edge on which no joint turns by more than 12,288 rad");
  }
  auto& memory = scratch.of<EdgeMemory>();
  memory.q.resize(count);
  robot_->poseAt(q0, memory.to);
  ClearanceSearch search(clearance_->options(), scratch.of<ClearanceMemory>());
  for (int part = 0; part < parts; ++part) {
    std::swap(memory.from, memory.to);
    robot_->between(q0, q1, static_cast<double>(part + 1) / parts, memory.q.data());
    robot_->poseAt(memory.q.data(), memory.to);
    lookAt(search, scratch, static_cast<double>(part) / parts, 1.0 / parts);
  }
  EdgeClearance answer{search.finish(), -1};
  if (answer.triangle >= 0) answer.prop = search.prop();
  if (answer.prop >= 0) moveToWorld(*props_[slotOf(answer.prop)].X_WP, answer);
  findSlopes(answer, q0, q1, scratch, slope0, slope1);
  return answer;
}

/// Looks from memory.from to memory.to, in W and as each prop sees it.
void EdgeQuery::lookAt(ClearanceSearch& search, Scratch& scratch, double begin,
                       double share) const {
  const Skeleton& skeleton = robot_->avatar().skeleton();
  auto& memory = scratch.of<EdgeMemory>();
  memory.motion.assign(skeleton, memory.from, memory.to);
  const double rounding = robot_->poseRounding();
  search.look({&clearance_->plan(), &memory.motion, rounding, begin, share, -1});
  const double ofProps =
      rounding + internal::kPropRounding * (robot_->reach() + 2.0 * kMostPropDistance);
  for (std::size_t i = 0; i < props_.size(); ++i) {
    const Prop& prop = props_[i];
    if (!prop.X_WP) continue;
    internal::seenFrom(*prop.X_WP, skeleton, memory.from, memory.propFrom);
    internal::seenFrom(*prop.X_WP, skeleton, memory.to, memory.propTo);
    memory.motion.assign(skeleton, memory.propFrom, memory.propTo);
    search.look({&prop.clearance.plan(), &memory.motion, ofProps, begin, share,
                 static_cast<std::int32_t>(i)});
  }
}

/// At the least separation its time does not count: it changes as the separation at that time does.
void EdgeQuery::findSlopes(const EdgeClearance& answer, const double* q0, const double* q1,
                           Scratch& scratch, double* slope0, double* slope1) const {
  const std::size_t n = robot_->numCoordinates();
  for (double* slope : {slope0, slope1}) {
    if (slope != nullptr) std::fill(slope, slope + n, 0.0);
  }
  if ((slope0 == nullptr && slope1 == nullptr) || answer.triangle < 0) return;
  auto& memory = scratch.of<EdgeMemory>();
  robot_->between(q0, q1, answer.t, memory.q.data());
  robot_->poseAt(memory.q.data(), memory.to);
  memory.motion.assign(robot_->avatar().skeleton(), memory.to, memory.to);
  memory.motion.statesAt(0.0, memory.states);
  for (const bool isFirst : {true, false}) {
    double* const slope = isFirst ? slope0 : slope1;
    if (slope == nullptr) continue;
    robot_->slopeAt(memory.q.data(), memory.states, answer.link, answer.p_WLink,
                    (isFirst ? 1.0 - answer.t : answer.t) * answer.nhat_SL_W, slope);
  }
}

Result<Done> EdgeQuery::clearanceAll(const double* q0, const double* q1, std::size_t count,
                                     WorkerPool& pool, std::vector<EdgeClearance>& answers,
                                     double* slopes0, double* slopes1) const {
  FORETOUCH_CHECK(internal::checkAll(robot(), q0, count));
  FORETOUCH_CHECK(internal::checkAll(robot(), q1, count));
  const std::size_t n = robot().numCoordinates();
  const auto ofEdge = [n](double* slopes, std::size_t i) {
    return slopes != nullptr ? slopes + i * n : nullptr;
  };
  answers.resize(count);
  return internal::runEdges(pool, count, [&](std::size_t i, Scratch& scratch) -> Result<Done> {
    answers[i] = {};
    FORETOUCH_TRY(answers[i], clearance(q0 + i * n, q1 + i * n, n, scratch, ofEdge(slopes0, i),
                                        ofEdge(slopes1, i)));
    return Done{};
  });
}

}  // namespace foretouch
