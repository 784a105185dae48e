// tools/repair/stage.h: a clip that is to be mended: its body, what it is among, and what in it may
// change. World W: metres, +Y up. A pose is one that is played: 0 is the first one of the cut.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/result.h"
#include "middleware/near/near_features.h"
#include "middleware/query/query.h"
#include "tools/feet/feet_inputs.h"
#include "tools/repair/knobs.h"
#include "tools/repair/maker_file.h"

namespace foretouch::tools {

struct RepairRequest : FeetRequest {
  /// What is nearer than this to anything (m) is moved so far away, once it touched; feet rest so
  /// far above the ground.
  double gap = 0.0005;
  /// A foot that moves farther than this while it touches (m) means to: it does not slide.
  double mostSlide = 0.08;
};

/// The share of the gap that the kernel counts as contact. The rest is for rounding and curves.
inline constexpr double kToleranceShare = 0.2;

class RepairStage {
 public:
  /// Errors name the file or the option.
  [[nodiscard]] static Result<RepairStage> load(const RepairRequest& request);

  /// Poses the clip with changes, a column per pose. Errors: those of FeetInputs::poseAt().
  [[nodiscard]] Result<Done> change(const Changes& changes);
  /// The same with the poses of a clip of the same file. Errors: it has another number of frames.
  [[nodiscard]] Result<Done> replaceBy(Clip clip);

  [[nodiscard]] const RepairRequest& request() const { return request_; }
  [[nodiscard]] const FeetInputs& feet() const { return feet_; }
  [[nodiscard]] const Avatar& body() const { return *body_; }
  [[nodiscard]] const Query& query() const { return *query_; }
  [[nodiscard]] const NearQuery& near() const { return *near_; }
  [[nodiscard]] const MakerFile& file() const { return *file_; }
  [[nodiscard]] const std::vector<Knob>& knobs() const { return file_->knobs(); }
  [[nodiscard]] std::int32_t numPoses() const { return static_cast<std::int32_t>(poses_.size()); }
  [[nodiscard]] const std::vector<Pose>& poses() const { return poses_; }
  /// What the poses were changed by.
  [[nodiscard]] const Changes& changes() const { return changes_; }
  [[nodiscard]] double secondsOf(std::int64_t pose) const { return feet_.timeOf(pose); }
  /// The frame of the pose in the clip.
  [[nodiscard]] std::int64_t frameOf(std::int64_t pose) const {
    return feet_.played.steps.frameOf(pose);
  }
  /// The link of body() that a link of feet().body moves with.
  [[nodiscard]] LinkId linkOf(LinkId resting) const;
  /// Turns directions of the clip's roots into W.
  [[nodiscard]] Eigen::Matrix3d R_WClip() const;
  /// Where the clip goes on beyond the poses that are played, these must meet it.
  [[nodiscard]] bool isCutBefore() const { return frameOf(0) > 0; }
  [[nodiscard]] bool isCutAfter() const;
  /// Changes of the file: a column per frame of the clip.
  [[nodiscard]] Changes ofFile(const Changes& changes) const;

 private:
  RepairStage(RepairRequest request, FeetInputs feet)
      : request_(std::move(request)), feet_(std::move(feet)) {}
  [[nodiscard]] Result<Done> prepare();
  [[nodiscard]] Result<Done> takePoses();

  RepairRequest request_;
  FeetInputs feet_;
  std::vector<Pose> original_;  // the clip's frames
  std::vector<Pose> poses_;     // of body(), in W
  Changes changes_;
  std::unique_ptr<const Avatar> body_;
  std::unique_ptr<const Query> query_;
  std::unique_ptr<const NearQuery> near_;
  std::unique_ptr<const MakerFile> file_;
};

}  // namespace foretouch::tools
