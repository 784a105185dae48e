// tools/replay/step_solver.h: one step of a replay, from two frames of the clip to a line of
// results.
#pragma once

#include <cstdint>
#include <string>

#include "articulated/motion.h"
#include "articulated/result.h"
#include "middleware/depth/depth.h"
#include "middleware/query/query.h"
#include "tools/inputs/replay_inputs.h"
#include "tools/replay/results_writer.h"
#include "tools/touches/ground.h"

namespace foretouch::tools {

struct ReplayedStep {
  StepAnswer answer;
  std::string line;  ///< Its line in the results file.
};

/// Answers single steps, in any order; one per thread. Its arguments must outlive it.
class StepSolver {
 public:
  /// `query`: that of the inputs. `depths`: those of its surface; null without one.
  StepSolver(const ReplayInputs& inputs, const Query& query, const LinkDepths* depths,
             const StepFormat& format)
      : inputs_(inputs),
        query_(query),
        depths_(depths),
        format_(format),
        ground_(inputs.avatar, inputs.scene, inputs.request.ground) {}

  [[nodiscard]] Result<ReplayedStep> solve(std::int64_t step);

 private:
  [[nodiscard]] Result<Pose> poseAt(std::int64_t frame);
  [[nodiscard]] StepAnswer recorded(std::int64_t step, const StepContacts& contacts,
                                    double latencyUs) const;
  [[nodiscard]] std::vector<LinkId> missedByPoses(const ChainMotion& motion,
                                                  const std::vector<LinkContact>& contacts);
  void findDepths(const ChainMotion& motion, StepAnswer& answer) const;
  void findGround(const ChainMotion& motion, StepAnswer& answer);

  const ReplayInputs& inputs_;
  const Query& query_;
  const LinkDepths* depths_;
  const StepFormat& format_;
  GroundTest ground_;
  Scratch scratch_;
  std::int64_t frame_ = -1;  // whose pose pose_ is
  Pose pose_;
};

}  // namespace foretouch::tools
