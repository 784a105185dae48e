// planning/ompl.h, installed as <foretouch/ompl.h>: Foretouch as the collision checker of OMPL 1.5
// (libompl-dev): edges are proven, not sampled, so there is no resolution to choose. Include it
// where you include OMPL; Foretouch's libraries do not need OMPL. docs/robots.md shows a program.
//
// A state must be a robot's configuration: real numbers (RealVectorStateSpace), angles on the
// circle (SO2StateSpace) for periodic coordinates, or compounds of these (SE2StateSpace for a
// mobile base), one number per coordinate, in order. On the circle an edge takes the shorter arc,
// as OMPL interpolates it.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <ompl/base/MotionValidator.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateValidityChecker.h>
#include <optional>
#include <utility>
#include <vector>

#include "articulated/result.h"
#include "middleware/edges/edge_query.h"
#include "planning/ompl_states.h"

namespace foretouch {

/// What one OMPL problem asks, for any number of threads (ParallelPlan).
class OmplEdges {
 public:
  OmplEdges(EdgeQuery edges, OmplStates states)
      : edges_(std::move(edges)), states_(std::move(states)) {}

  /// Proven free, keeping the clearance, and within the joints' limits.
  [[nodiscard]] bool isFree(const ompl::base::State* state) const {
    Memory& memory = memoryOfThread();
    states_.read(state, memory.q0);
    return isFree(memory.q0, memory);
  }

  /// `lastFree`, which may be null: if the answer is false, where a free state lies on the edge
  /// (t), to which all is proven free; 0 if there is none but, as OMPL assumes, the begin.
  [[nodiscard]] bool isFree(const ompl::base::State* from, const ompl::base::State* to,
                            double* lastFree) const {
    Memory& memory = memoryOfThread();
    states_.read(from, memory.q0);
    states_.readEnd(memory.q0, to, memory.q1);
    numEdges_.fetch_add(1, std::memory_order_relaxed);
    const auto answer = edges_.answer(memory.q0, memory.q1, memory.scratch);
    if (answer.ok() && answer.value().isUsable()) return true;
    if (lastFree != nullptr) *lastFree = answer.ok() ? freeBefore(answer.value(), memory) : 0.0;
    return false;
  }

  /// As EdgeQuery::place(): between plans, not while one is made.
  Result<Done> place(std::size_t prop, const std::optional<RigidPose>& X_WP) {
    return edges_.place(prop, X_WP);
  }
  [[nodiscard]] const EdgeQuery& query() const { return edges_; }
  /// Edges asked so far; OMPL's own counters of motions are not for several threads and stay 0.
  [[nodiscard]] std::uint64_t numEdges() const { return numEdges_.load(); }

 private:
  /// Memory that all problems of a thread share.
  struct Memory {
    Scratch scratch;
    std::vector<double> q0, q1, between;
  };
  static Memory& memoryOfThread() {
    thread_local Memory memory;
    return memory;
  }

  [[nodiscard]] bool isFree(const std::vector<double>& q, Memory& memory) const {
    const auto answer = edges_.answer(q, q, memory.scratch);
    return answer.ok() && answer.value().isUsable();
  }

  /// At freeUntil the robot is within the tolerance of what it meets, and no edge goes on from
  /// there: steps back until the state is free by itself. Limits are convex, so what lies between
  /// two configurations within them is within them.
  [[nodiscard]] double freeBefore(const EdgeAnswer& answer, Memory& memory) const {
    for (const double share : {1.0 - 0x1p-10, 1.0 - 0x1p-7, 1.0 - 0x1p-4, 0.5}) {
      const double t = answer.freeUntil * share;
      memory.between.resize(memory.q0.size());
      edges_.robot().between(memory.q0.data(), memory.q1.data(), t, memory.between.data());
      if (t > 0.0 && isFree(memory.between, memory)) return t;
    }
    return 0.0;
  }

  EdgeQuery edges_;
  OmplStates states_;
  mutable std::atomic<std::uint64_t> numEdges_{0};
};

class OmplValidityChecker : public ompl::base::StateValidityChecker {
 public:
  OmplValidityChecker(const ompl::base::SpaceInformationPtr& space,
                      std::shared_ptr<const OmplEdges> edges)
      : StateValidityChecker(space), edges_(std::move(edges)) {}
  bool isValid(const ompl::base::State* state) const override { return edges_->isFree(state); }

 private:
  std::shared_ptr<const OmplEdges> edges_;
};

class OmplMotionValidator : public ompl::base::MotionValidator {
 public:
  OmplMotionValidator(const ompl::base::SpaceInformationPtr& space,
                      std::shared_ptr<const OmplEdges> edges)
      : MotionValidator(space), edges_(std::move(edges)) {}
  bool checkMotion(const ompl::base::State* from, const ompl::base::State* to) const override {
    return edges_->isFree(from, to, nullptr);
  }
  /// `last`: never later than what is proven free, and free by itself (or `from`, at 0).
  bool checkMotion(const ompl::base::State* from, const ompl::base::State* to,
                   std::pair<ompl::base::State*, double>& last) const override {
    double t = 0.0;
    if (edges_->isFree(from, to, &t)) return true;
    last.second = t;
    if (last.first != nullptr) si_->getStateSpace()->interpolate(from, to, t, last.first);
    return false;
  }

 private:
  std::shared_ptr<const OmplEdges> edges_;
};

/// Lets `space` ask Foretouch about states and motions; returns what it asks.
/// Errors: as OmplStates::of().
inline Result<std::shared_ptr<OmplEdges>> useForetouch(const ompl::base::SpaceInformationPtr& space,
                                                       EdgeQuery edges) {
  auto states = OmplStates::of(edges.robot(), space->getStateSpace());
  if (!states.ok()) return states.error();
  auto shared = std::make_shared<OmplEdges>(std::move(edges), std::move(states).value());
  space->setStateValidityChecker(std::make_shared<OmplValidityChecker>(space, shared));
  space->setMotionValidator(std::make_shared<OmplMotionValidator>(space, shared));
  return Result<std::shared_ptr<OmplEdges>>(std::move(shared));
}

}  // namespace foretouch
