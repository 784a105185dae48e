// tools/person/bound_check.h: whether a clip itself breaks the bounds that are claimed of its
// person: by its poses that were left out, and by how far it came across gaps.
#pragma once

#include <vector>

#include "articulated/motion.h"
#include "articulated/motion_model.h"
#include "middleware/bracket/axis_places.h"
#include "middleware/bracket/bracket.h"
#include "tools/person/person_counts.h"

namespace foretouch::tools {

class BoundCheck {
 public:
  /// The objects that it refers to outlive it.
  BoundCheck(const Avatar& avatar, const std::vector<LinkBound>& bounds)
      : avatar_(avatar), bounds_(bounds), placer_(avatar) {}

  /// Begins the step that the next brackets are about.
  void begin(const PosedStep& step, MotionModel model);
  /// Takes a left-out pose of the person at `u` of the step. `isKnown`: whether a link's is known.
  template <typename IsKnown>
  void leftOut(const Pose& truth, double u, double timeS, const StepBrackets& brackets,
               const IsKnown& isKnown, PersonCounts& counts) {
    place(truth, u);
    for (const LinkBracket& bracket : brackets.links) {
      if (bracket.verdict == BracketVerdict::Unclaimed || !isKnown(bracket.link)) continue;
      count(bracket.link, beyond(bracket, u), timeS, counts);
    }
  }
  /// A step in which only speeds and errors are claimed.
  void across(const PosedStep& step, const std::vector<LinkId>& links,
              const std::vector<LinkBound>& bounds, double timeS, PersonCounts& counts);

 private:
  void place(const Pose& truth, double u);
  [[nodiscard]] double beyond(const LinkBracket& bracket, double u) const;
  void count(LinkId link, double beyond, double timeS, PersonCounts& counts) const;

  const Avatar& avatar_;
  const std::vector<LinkBound>& bounds_;
  AxisPlacer placer_;
  ModelMotion model_;
  ChainMotion constant_;
  AxisPlaces truth_, modelled_;
  std::vector<double> apart_;
  Pose pose_;
};

}  // namespace foretouch::tools
