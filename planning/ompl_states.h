// planning/ompl_states.h: OMPL's states as a robot's configurations (planning/ompl.h).
#pragma once

#include <cmath>
#include <memory>
#include <ompl/base/StateSpace.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/spaces/SO2StateSpace.h>
#include <string>
#include <utility>
#include <vector>

#include "articulated/result.h"
#include "articulated/robot.h"

namespace foretouch {

/// Immutable, for any number of threads.
class OmplStates {
 public:
  /// Calls space->computeLocations(). Errors: a space with another number of values than the robot
  /// has coordinates, a part of it that is neither real numbers nor a circle, and a circle for a
  /// coordinate that is not periodic (Error::index is the coordinate).
  static Result<OmplStates> of(const Robot& robot, ompl::base::StateSpacePtr space) {
    space->computeLocations();
    OmplStates states;
    states.places_ = space->getValueLocations();
    states.space_ = std::move(space);
    if (states.places_.size() != robot.numCoordinates()) {
      return Error::in("state space", ErrorCode::Mismatch,
                       "expected " + std::to_string(robot.numCoordinates()) +
                           " values, one per coordinate of the robot, found " +
                           std::to_string(states.places_.size()));
    }
    for (std::size_t i = 0; i < states.places_.size(); ++i) {
      const int type = states.places_[i].stateLocation.space->getType();
      const bool isCircle = type == ompl::base::STATE_SPACE_SO2;
      const bool isPeriodic = robot.coordinates()[i].isPeriodic;
      if (type == ompl::base::STATE_SPACE_REAL_VECTOR || (isCircle && isPeriodic)) {
        states.isCircle_.push_back(isCircle);
        continue;
      }
      return Error::at(
          static_cast<std::int64_t>(i), ErrorCode::Mismatch,
          "coordinate '" + robot.coordinates()[i].name + "': expected " +
              (isCircle ? "real numbers: it is not periodic" : "real numbers or a circle"));
    }
    return states;
  }

  void read(const ompl::base::State* state, std::vector<double>& q) const {
    q.resize(places_.size());
    for (std::size_t i = 0; i < q.size(); ++i) {
      q[i] = *space_->getValueAddressAtLocation(state, places_[i]);
    }
  }

  /// Where the edge from q0 to `state` ends: on a circle by the shorter arc, a half turn as OMPL
  /// takes it. Angles of states lie within [-pi, pi], so the rounding of the turn is far within
  /// what articulated/robot.md allows for coordinates of up to 1,000.
  void readEnd(const std::vector<double>& q0, const ompl::base::State* state,
               std::vector<double>& q1) const {
    constexpr double kTurn = 6.28318530717958647693;
    read(state, q1);
    for (std::size_t i = 0; i < q1.size(); ++i) {
      const double by = q1[i] - q0[i];
      if (!isCircle_[i] || std::abs(by) <= kTurn / 2) continue;
      q1[i] += by > 0.0 ? -kTurn : kTurn;
    }
  }

 private:
  OmplStates() = default;

  ompl::base::StateSpacePtr space_;
  std::vector<ompl::base::StateSpace::ValueLocation> places_;
  std::vector<bool> isCircle_;
};

/// A space of the robot's configurations: real numbers within the limits, circles for periodic
/// angles. `unlimited`: how far (rad or m) a coordinate without limits is searched to both sides.
inline ompl::base::StateSpacePtr omplSpaceOf(const Robot& robot, double unlimited = 10.0) {
  auto whole = std::make_shared<ompl::base::CompoundStateSpace>();
  std::shared_ptr<ompl::base::RealVectorStateSpace> numbers;
  const auto closeNumbers = [&] {
    if (numbers != nullptr) whole->addSubspace(std::move(numbers), 1.0);
    numbers = nullptr;
  };
  for (const RobotCoordinate& coordinate : robot.coordinates()) {
    if (coordinate.isPeriodic) {
      closeNumbers();
      whole->addSubspace(std::make_shared<ompl::base::SO2StateSpace>(), 1.0);
      continue;
    }
    if (numbers == nullptr) numbers = std::make_shared<ompl::base::RealVectorStateSpace>();
    numbers->addDimension(std::isfinite(coordinate.lower) ? coordinate.lower : -unlimited,
                          std::isfinite(coordinate.upper) ? coordinate.upper : unlimited);
  }
  if (whole->getSubspaceCount() == 0 && numbers != nullptr) return numbers;
  closeNumbers();
  return whole;
}

}  // namespace foretouch
