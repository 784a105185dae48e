#include "tools/inputs/pose_curve.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "lss/index.h"
#include "middleware/bracket/bracket_plan.h"
#include "middleware/bracket/model_pieces.h"

namespace foretouch::tools {
namespace {

/// The most pieces per step, and in a whole clip, times its joints.
constexpr std::int64_t kMostPieces = 1024, kMostJoints = 50'000'000;

class CurveCutter {
 public:
  CurveCutter(const Avatar& avatar, const std::vector<Pose>& poses, double seconds,
              MotionModel model)
      : avatar_(avatar),
        body_(internal::BodyPlan::of(avatar, std::nullopt)),
        poses_(poses),
        seconds_(seconds),
        model_(model),
        isMoved_(countOf(avatar.numLinks()), 1) {
    // Whatever surface a link has, its LSS hold it.
    for (LinkId link = 0; link < avatar.numLinks(); ++link) {
      double radius = 0.0;
      for (const Lss& lss : avatar.lss(link)) radius = std::max(radius, lss.radius);
      body_.rho[slotOf(link)] += radius;
    }
  }

  [[nodiscard]] std::int64_t numSteps() const {
    return static_cast<std::int64_t>(poses_.size()) - 1;
  }

  /// The most that any link strays from the cubic in any of so many pieces of any step.
  double strayOf(std::int64_t pieces, double enough) {
    std::int64_t atOnce = internal::ModelPieces::kMost;
    while (pieces % atOnce != 0) --atOnce;
    const std::int64_t parts = pieces / atOnce;
    double most = 0.0;
    for (std::int64_t step = 0; step < numSteps() && most <= enough; ++step) {
      begin(step);
      for (std::int64_t part = 0; part < parts; ++part) {
        most = std::max(most, strayIn({posed_, partAt(part, parts), partAt(part + 1, parts)},
                                      static_cast<int>(atOnce)));
      }
    }
    return most;
  }

  std::vector<Pose> cut(std::int64_t pieces) {
    std::vector<Pose> curve;
    curve.reserve(static_cast<std::size_t>(numSteps() * pieces + 1));
    for (std::int64_t step = 0; step < numSteps(); ++step) {
      begin(step);
      const ChainMotion constant(avatar_.skeleton(), *posed_.from, *posed_.to);
      for (std::int64_t i = 0; i < pieces; ++i) {
        Pose& pose = curve.emplace_back();
        const double t = partAt(i, pieces);
        motion_.isConstantRate() && i > 0 ? constant.poseAt(t, pose) : motion_.poseAt(t, pose);
      }
    }
    curve.push_back(poses_.back());
    return curve;
  }

 private:
  static double partAt(std::int64_t part, std::int64_t parts) {
    return static_cast<double>(part) / static_cast<double>(parts);
  }
  void begin(std::int64_t step) {
    const auto poseOf = [&](std::int64_t i) -> const Pose* {
      return i >= 0 && i <= numSteps() ? &poses_[static_cast<std::size_t>(i)] : nullptr;
    };
    const bool isLate = model_ == MotionModel::CubicLate;
    posed_ = {poseOf(step - 1), poseOf(step), poseOf(step + 1), isLate ? poseOf(step + 2) : nullptr,
              seconds_,         seconds_,     seconds_};
    motion_.assign(avatar_.skeleton(), posed_, model_);
  }
  double strayIn(const internal::AskedPart& part, int pieces) {
    if (!pieces_.cut(avatar_, part, motion_, {pieces, isMoved_, places_})) {
      return std::numeric_limits<double>::infinity();
    }
    double most = 0.0;
    for (int k = 0; k < pieces; ++k) {
      for (LinkId link = 0; link < avatar_.numLinks(); ++link) {
        const auto& stray = pieces_.piece(k).strays[slotOf(link)];
        most = std::max(most, stray.at(body_.rho[slotOf(link)]));
      }
    }
    return most;
  }

  const Avatar& avatar_;
  internal::BodyPlan body_;
  const std::vector<Pose>& poses_;
  double seconds_;
  MotionModel model_;
  std::vector<std::uint8_t> isMoved_;
  PosedStep posed_;
  ModelMotion motion_;
  internal::ModelPieces pieces_;
  internal::KnownPlaces places_;
};

}  // namespace

Result<PoseCurve> poseCurve(const Avatar& avatar, const std::vector<Pose>& poses, double seconds,
                            MotionModel model, std::int64_t stride, double mostOffM) {
  CurveCutter cutter(avatar, poses, seconds, model);
  PoseCurve curve;
  curve.model = model;
  for (curve.pieces = stride;; curve.pieces *= 2) {
    if (curve.pieces > kMostPieces ||
        curve.pieces * cutter.numSteps() * avatar.numLinks() > kMostJoints) {
      return Error::in("--between", ErrorCode::LimitExceeded,
                       fmt::format("expected a --tolerance that fewer pieces hold, or a shorter "
                                   "part: {} pieces of a constant rate per step are off by up to "
                                   "{:.3g} m, and {:.3g} m are allowed",
                                   curve.pieces / 2, curve.offM, mostOffM));
    }
    curve.offM = cutter.strayOf(curve.pieces, mostOffM);
    if (curve.offM <= mostOffM) break;
  }
  curve.poses = cutter.cut(curve.pieces);
  return curve;
}

}  // namespace foretouch::tools
