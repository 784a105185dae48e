#include "tools/repair/maker_file.h"

#include <cmath>
#include <utility>

#include "articulated/try.h"
#include "assets/bvh/bvh_limits.h"
#include "assets/bvh/bvh_reader.h"
#include "assets/bvh/bvh_rewrite.h"
#include "assets/clip/clip_file.h"
#include "assets/text_file.h"
#include "lss/index.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

/// Bones whose positions the clip changes by less than this (m) have a constant length.
constexpr double kShifts = 1e-3;

class BvhFile : public MakerFile {
 public:
  static Result<std::unique_ptr<MakerFile>> open(const ClipRequest& request, const Clip& clip) {
    auto file = std::make_unique<BvhFile>();
    FORETOUCH_TRY(file->text_, readWholeFile(request.motionPath, kMaxBvhFileBytes));
    file->name_ = request.motionPath;
    file->scale_ = request.motionScale.value_or(1.0);
    file->clip_ = clip;
    FORETOUCH_TRY(const auto channels, bvhChannelsOf(file->text_, file->name_));
    for (std::size_t joint = 0; joint < channels.size(); ++joint) {
      file->addKnobs(static_cast<JointId>(joint), channels[joint]);
    }
    return std::unique_ptr<MakerFile>(std::move(file));
  }

  [[nodiscard]] Result<std::string> with(const Changes& changes) const override {
    std::vector<Pose> after;
    for (std::size_t frame = 0; frame < clip_.frames.size(); ++frame) {
      after.push_back(
          changedPose(clip_.frames[frame], knobs_, changes.col(static_cast<Eigen::Index>(frame))));
    }
    return rewriteBvh(text_, name_, scale_, clip_, after);
  }

  [[nodiscard]] Result<Clip> reread(const std::string& bytes) const override {
    return parseBvh(bytes, name_, BvhOptions{scale_});
  }

 private:
  void addKnobs(JointId joint, const BvhJointChannels& channels);
  [[nodiscard]] bool shifts(JointId joint, int axis) const;

  std::string text_, name_;
  double scale_ = 1.0;
  Clip clip_;
};

bool BvhFile::shifts(JointId joint, int axis) const {
  if (clip_.skeleton.parent(joint) == kNoParent) return true;
  const double first = clip_.frames.front().translations[slotOf(joint)][axis];
  for (const Pose& pose : clip_.frames) {
    if (std::abs(pose.translations[slotOf(joint)][axis] - first) > kShifts) return true;
  }
  return false;
}

void BvhFile::addKnobs(JointId joint, const BvhJointChannels& channels) {
  static constexpr const char* kAxes[] = {"x", "y", "z"};
  const auto add = [&](bool turns, int axis) {
    Knob knob;
    knob.name = clip_.skeleton.name(joint) + (turns ? " turn " : " shift ") + kAxes[axis];
    knob.drives.push_back({joint, turns, Vector3d::Unit(axis)});
    knobs_.push_back(std::move(knob));
  };
  for (int axis = 0; axis < 3; ++axis) {
    if (channels.shifts[static_cast<std::size_t>(axis)] && shifts(joint, axis)) add(false, axis);
  }
  if (channels.saysAnyTurn()) {
    for (int axis = 0; axis < 3; ++axis) add(true, axis);
  } else if (channels.turns.size() == 1) {
    add(true, channels.turns.front());
  }
}

}  // namespace

Result<std::unique_ptr<MakerFile>> MakerFile::open(const ClipRequest& request, const Clip& clip) {
  Result<std::unique_ptr<MakerFile>> file =
      Error::in(request.motionPath, ErrorCode::Mismatch,
                "expected a BVH clip, or a robot's table (.csv, .npz): clips of other formats are "
                "not mended");
  switch (clipFormatOf(request.motionPath)) {
    case ClipFormat::Bvh: file = BvhFile::open(request, clip); break;
    case ClipFormat::JointTable: file = openTable(request); break;
    case ClipFormat::Model:
    case ClipFormat::Acclaim:
    case ClipFormat::WebXr: break;
  }
  return file;
}

}  // namespace foretouch::tools
