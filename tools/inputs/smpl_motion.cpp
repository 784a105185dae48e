#include "tools/inputs/smpl_motion.h"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "assets/bvh/bvh_limits.h"
#include "assets/clip/clip_file.h"
#include "assets/text_file.h"
#include "lss/index.h"
#include "tools/inputs/npz_arrays.h"

namespace foretouch::tools {
namespace {

using Eigen::Matrix3Xd;
using Eigen::Vector3d;

constexpr std::size_t kMaxBodyModelBytes = std::size_t{1} << 30;
constexpr double kMostTurn = 1e4;  // rad: 1600 turns

const std::array<const char*, 22> kBody{
    "pelvis",     "left_hip",    "right_hip",    "spine1",     "left_knee",     "right_knee",
    "spine2",     "left_ankle",  "right_ankle",  "spine3",     "left_foot",     "right_foot",
    "neck",       "left_collar", "right_collar", "head",       "left_shoulder", "right_shoulder",
    "left_elbow", "right_elbow", "left_wrist",   "right_wrist"};

/// The names for SMPL (24), SMPL-H (52) or SMPL-X (55); numbers for other counts.
std::vector<std::string> namesOf(std::size_t joints) {
  constexpr std::size_t kSmpl = 24, kSmplH = 52, kSmplX = 55;
  std::vector<std::string> names(kBody.begin(), kBody.end());
  if (joints == kSmpl) names.insert(names.end(), {"left_hand", "right_hand"});
  if (joints == kSmplX) names.insert(names.end(), {"jaw", "left_eye", "right_eye"});
  if (joints == kSmplH || joints == kSmplX) {
    for (const char* const side : {"left_", "right_"}) {
      for (const char* const finger : {"index", "middle", "pinky", "ring", "thumb"}) {
        for (const char* const part : {"1", "2", "3"}) {
          names.push_back(std::string(side) + finger + part);
        }
      }
    }
  }
  if (names.size() == joints) return names;
  names.clear();
  for (std::size_t i = 0; i < joints; ++i) names.push_back("joint " + std::to_string(i));
  return names;
}

/// An array of numbers with `dimensions` sizes.
Result<NpzArray> numbers(const NpzArrays& arrays, const char* name, std::size_t dimensions) {
  FORETOUCH_TRY(auto array, arrays.array(name));
  if (array.texts.empty() && array.shape.size() == dimensions) return array;
  return Error::of(ErrorCode::Mismatch, std::string("array '") + name + "': expected numbers of " +
                                            std::to_string(dimensions) + " dimensions");
}

Error misfit(const char* name, const std::string& expected) {
  return Error::of(ErrorCode::Mismatch, std::string("array '") + name + "': expected " + expected);
}

/// Where the joints are at rest, and what carries each.
struct SmplBody {
  Matrix3Xd joints;
  std::vector<JointId> parents;
  std::size_t betasLeftOut = 0;
};

Result<SmplBody> bodyOf(const NpzArrays& model, const std::vector<double>& betas) {
  FORETOUCH_TRY(const auto vertices, numbers(model, "v_template", 2));
  FORETOUCH_TRY(const auto regressor, numbers(model, "J_regressor", 2));
  FORETOUCH_TRY(const auto tree, numbers(model, "kintree_table", 2));
  const std::size_t numVertices = vertices.shape[0], numJoints = regressor.shape[0];
  if (vertices.shape[1] != 3) return misfit("v_template", "three columns");
  if (numJoints == 0 || regressor.shape[1] != numVertices) {
    return misfit("J_regressor",
                  "a column for each of the " + std::to_string(numVertices) + " vertices");
  }
  if (tree.shape[0] != 2 || tree.shape[1] != numJoints) {
    return misfit("kintree_table", "two rows of " + std::to_string(numJoints));
  }
  SmplBody body;
  Matrix3Xd shaped = Eigen::Map<const Matrix3Xd>(vertices.numbers.data(), 3,
                                                 static_cast<Eigen::Index>(numVertices));
  bool isShaped = false;
  for (const double beta : betas) isShaped = isShaped || beta != 0.0;
  if (isShaped) {
    FORETOUCH_TRY(const auto shapes, numbers(model, "shapedirs", 3));
    if (shapes.shape[0] != numVertices || shapes.shape[1] != 3) {
      return misfit("shapedirs", "the shape of 'v_template' in front");
    }
    const std::size_t held = std::min(betas.size(), shapes.shape[2]);
    body.betasLeftOut = betas.size() - held;
    for (std::size_t i = 0; i < 3 * numVertices; ++i) {
      double& coordinate =
          shaped(static_cast<Eigen::Index>(i % 3), static_cast<Eigen::Index>(i / 3));
      for (std::size_t b = 0; b < held; ++b) {
        coordinate += shapes.numbers[i * shapes.shape[2] + b] * betas[b];
      }
    }
  }
  body.joints = Matrix3Xd::Zero(3, static_cast<Eigen::Index>(numJoints));
  for (std::size_t j = 0; j < numJoints; ++j) {
    const Eigen::Map<const Eigen::VectorXd> weights(&regressor.numbers[j * numVertices],
                                                    static_cast<Eigen::Index>(numVertices));
    body.joints.col(static_cast<Eigen::Index>(j)) = shaped * weights;
    const double parent = tree.numbers[j];  // the root's, whatever the file says: -1, or 2^32 - 1
    if (j > 0 &&
        !(parent >= 0.0 && parent < static_cast<double>(j) && parent == std::floor(parent))) {
      return misfit("kintree_table", "parents before their children");
    }
    body.parents.push_back(j == 0 ? kNoParent : static_cast<JointId>(parent));
  }
  return body;
}

Result<double> rateIn(const NpzArrays& motion, std::optional<double> asked) {
  if (asked) return *asked;
  for (const char* const name : {"mocap_framerate", "mocap_frame_rate"}) {
    if (!motion.has(name)) continue;
    FORETOUCH_TRY(const auto rate, motion.array(name));
    if (rate.numbers.size() != 1 || !(rate.numbers[0] > 0.0 && rate.numbers[0] <= 1e6)) {
      return misfit(name, "one number above 0");
    }
    return rate.numbers[0];
  }
  return Error::of(ErrorCode::Empty,
                   "expected an array 'mocap_framerate' or 'mocap_frame_rate', or --row-rate");
}

Quaternion turnOf(const double* v) {
  const Vector3d turn(v[0], v[1], v[2]);
  const double angle = turn.norm();
  if (!(angle > 0.0)) return Quaternion::Identity();
  return Quaternion(Eigen::AngleAxisd(angle, turn / angle)).normalized();
}

struct SmplMotion {
  NpzArray poses, places;
  std::vector<double> betas;
  double rateHz = 0.0;
};

Result<SmplMotion> motionIn(const std::string& path, std::optional<double> rateHz) {
  FORETOUCH_TRY(auto bytes, readWholeFile(path, kMaxJointTableBytes));
  FORETOUCH_TRY(const auto arrays, NpzArrays::of(std::move(bytes)));
  SmplMotion motion;
  FORETOUCH_TRY(motion.poses, numbers(arrays, "poses", 2));
  FORETOUCH_TRY(motion.places, numbers(arrays, "trans", 2));
  FORETOUCH_TRY(motion.rateHz, rateIn(arrays, rateHz));
  if (motion.places.shape[1] != 3 || motion.places.shape[0] != motion.poses.shape[0]) {
    return misfit("trans", "three numbers for each row of 'poses'");
  }
  if (motion.poses.shape[0] == 0) return misfit("poses", "at least one row");
  if (arrays.has("betas")) {
    FORETOUCH_TRY(auto betas, arrays.array("betas"));
    motion.betas = std::move(betas.numbers);
  }
  return motion;
}

Result<Clip> posed(const SmplMotion& motion, const SmplBody& body) {
  const std::size_t joints = body.parents.size(), frames = motion.poses.shape[0];
  if (motion.poses.shape[1] != 3 * joints) {
    return misfit("poses", "3 columns for each of the body model's " + std::to_string(joints) +
                               " joints, found " + std::to_string(motion.poses.shape[1]) +
                               ": the model of another family?");
  }
  if (frames * joints * 7 > kMaxBvhValues) {
    return Error::of(ErrorCode::LimitExceeded, "expected at most 2^26 values");
  }
  Clip clip;
  RawSkeleton raw;
  const std::vector<std::string> names = namesOf(joints);
  for (std::size_t j = 0; j < joints; ++j) {
    const Vector3d at = body.joints.col(static_cast<Eigen::Index>(j));
    const JointId parent = body.parents[j];
    const Vector3d offset = parent == kNoParent ? at : Vector3d(at - body.joints.col(parent));
    raw.joints.push_back({names[j], parent, offset, Quaternion::Identity()});
  }
  FORETOUCH_TRY(clip.skeleton, Skeleton::build(raw));
  clip.frameTimeS = 1.0 / motion.rateHz;
  clip.hasRotation.assign(joints, true);
  clip.hasTranslation.assign(joints, false);
  clip.hasTranslation[0] = true;
  clip.endSites.resize(joints);
  for (std::size_t f = 0; f < frames; ++f) {
    Pose pose = restPose(clip.skeleton);
    for (std::size_t j = 0; j < joints; ++j) {
      const double* const turn = &motion.poses.numbers[(f * joints + j) * 3];
      if (!(std::abs(turn[0]) + std::abs(turn[1]) + std::abs(turn[2]) <= kMostTurn)) {
        return misfit("poses", "turns of at most 1e4 rad, in row " + std::to_string(f));
      }
      pose.rotations[j] = turnOf(turn);
    }
    pose.translations[0] += Eigen::Map<const Vector3d>(&motion.places.numbers[3 * f]);
    FORETOUCH_TRY(auto checked, validatedPose(clip.skeleton, pose));
    clip.frames.push_back(std::move(checked));
  }
  if (body.betasLeftOut > 0) {
    clip.notes.push_back("the last " + std::to_string(body.betasLeftOut) + " of its " +
                         std::to_string(motion.betas.size()) +
                         " betas are left out: the body model has no more shapes");
  }
  return clip;
}

}  // namespace

Result<Clip> clipFromSmpl(const std::string& motionPath, const std::string& bodyPath,
                          std::optional<double> rateHz) {
  FORETOUCH_TRY(const auto motion, inFile(motionIn(motionPath, rateHz), motionPath));
  FORETOUCH_TRY(auto bytes, readWholeFile(bodyPath, kMaxBodyModelBytes));
  FORETOUCH_TRY(const auto model, inFile(NpzArrays::of(std::move(bytes)), bodyPath));
  FORETOUCH_TRY(const auto body, inFile(bodyOf(model, motion.betas), bodyPath));
  return inFile(posed(motion, body), motionPath);
}

}  // namespace foretouch::tools
