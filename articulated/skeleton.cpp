#include "articulated/skeleton.h"

#include <cmath>
#include <string>
#include <unordered_set>
#include <utility>

#include "articulated/quoted.h"
#include "lss/index.h"
#include "lss/rounding.h"

namespace foretouch {
namespace {

// A quaternion divided by its computed norm has |q|^2 within 12 unit roundoffs of 1 (4 for the sum
// of squares, halved by the root, 1 for the root, 1 for the division; twice that in the square; 4
// for the check itself). Above that sum, 16 leaves room; a closer one stays as it is.
constexpr double kUnitNormSquareError = 16.0 * kUnitRoundoff;

Error jointError(ErrorCode code, std::size_t joint, std::string message) {
  Error error;
  error.code = code;
  error.index = static_cast<std::int64_t>(joint);
  error.message = std::move(message);
  return error;
}

/// A joint's name in messages: index and name.
std::string title(const RawSkeleton& raw, std::size_t joint) {
  return "joint " + std::to_string(joint) + " " + inQuotes(raw.joints[joint].name);
}

std::optional<Error> hierarchyError(const RawSkeleton& raw) {
  if (raw.joints.empty()) return Error::of(ErrorCode::Empty, "expected at least one joint");
  if (raw.joints.size() > countOf(kMaxJoints)) {
    return jointError(ErrorCode::LimitExceeded, countOf(kMaxJoints),
                      "expected at most " + std::to_string(kMaxJoints) + " joints, found " +
                          std::to_string(raw.joints.size()));
  }
  std::vector<std::int32_t> depth(raw.joints.size(), 1);
  for (std::size_t i = 0; i < raw.joints.size(); ++i) {
    const JointId parent = raw.joints[i].parent;
    if (parent == kNoParent) continue;
    if (parent < 0 || slotOf(parent) >= i) {
      return jointError(ErrorCode::BadHierarchy, i,
                        title(raw, i) + " has parent " + std::to_string(parent) +
                            "; expected the index of an earlier joint, or " +
                            std::to_string(kNoParent));
    }
    depth[i] = depth[slotOf(parent)] + 1;
    if (depth[i] > kMaxChainDepth) {
      return jointError(ErrorCode::LimitExceeded, i,
                        title(raw, i) + " lies deeper than " + std::to_string(kMaxChainDepth) +
                            " joints below its root");
    }
  }
  return std::nullopt;
}

std::optional<Error> nameError(const RawSkeleton& raw) {
  std::unordered_set<std::string_view> seen;
  for (std::size_t i = 0; i < raw.joints.size(); ++i) {
    const std::string& name = raw.joints[i].name;
    if (const auto problem = nameProblem(name)) {
      return jointError(name.empty() ? ErrorCode::Empty : ErrorCode::Syntax, i,
                        "the name of " + title(raw, i) + " " + *problem);
    }
    if (!seen.insert(name).second) {
      return jointError(ErrorCode::DuplicateName, i,
                        title(raw, i) + " has the name of an earlier joint; names must be unique");
    }
  }
  return std::nullopt;
}

/// Checks one joint's numbers and makes its rotation unit.
std::optional<Error> fixRestPose(RawSkeleton& raw, std::size_t i) {
  RawJoint& joint = raw.joints[i];
  if (!joint.offset.allFinite() || !joint.rotation.coeffs().allFinite()) {
    return jointError(ErrorCode::NonFinite, i,
                      title(raw, i) + " has a rest offset or rotation that is not finite");
  }
  if (joint.offset.cwiseAbs().maxCoeff() > kMaxCoordinate) {
    return jointError(ErrorCode::OutOfRange, i,
                      title(raw, i) + " has a rest offset beyond 1e7 m; is the unit right?");
  }
  const auto unit = unitQuaternion(joint.rotation);
  if (!unit) {
    return jointError(ErrorCode::OutOfRange, i,
                      title(raw, i) + " has a rest rotation of norm " +
                          std::to_string(joint.rotation.norm()) + "; expected 1 within 0.001");
  }
  joint.rotation = *unit;
  return std::nullopt;
}

}  // namespace

std::optional<Quaternion> unitQuaternion(const Quaternion& q) {
  const double normSquare = q.squaredNorm();
  if (std::abs(normSquare - 1.0) <= kUnitNormSquareError) return q;
  const double norm = std::sqrt(normSquare);
  if (!(std::abs(norm - 1.0) <= kMaxQuaternionNormError)) return std::nullopt;
  return Quaternion(q.w() / norm, q.x() / norm, q.y() / norm, q.z() / norm);
}

std::optional<std::string> nameProblem(std::string_view name) {
  if (name.empty()) return "is empty";
  if (name.size() > kMaxNameBytes)
    return "is longer than " + std::to_string(kMaxNameBytes) + " bytes";
  if (!isUtf8(name)) return "is not UTF-8";
  unsigned char before = 0;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    // U+0080 to U+009F, in UTF-8 c2 80 to c2 9f, control terminals just like the ASCII ones.
    if (byte < 0x20 || byte == 0x7f || (before == 0xc2 && byte < 0xa0)) {
      return "holds a control character";
    }
    before = byte;
  }
  return std::nullopt;
}

Result<Skeleton> Skeleton::build(const RawSkeleton& raw) {
  if (auto error = hierarchyError(raw)) return *std::move(error);
  if (auto error = nameError(raw)) return *std::move(error);
  RawSkeleton fixed = raw;
  for (std::size_t i = 0; i < fixed.joints.size(); ++i) {
    if (auto error = fixRestPose(fixed, i)) return *std::move(error);
  }
  Skeleton skeleton;
  skeleton.joints_ = std::move(fixed.joints);
  skeleton.parents_.reserve(skeleton.joints_.size());
  for (const RawJoint& joint : skeleton.joints_) skeleton.parents_.push_back(joint.parent);
  return skeleton;
}

std::optional<JointId> Skeleton::find(std::string_view name) const {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (joints_[i].name == name) return static_cast<JointId>(i);
  }
  return std::nullopt;
}

JointId appendChain(const Skeleton& chain, JointId carrier, RawSkeleton& raw) {
  const auto first = static_cast<JointId>(raw.joints.size());
  for (JointId joint = 0; joint < chain.numJoints(); ++joint) {
    const JointId parent = chain.parent(joint);
    raw.joints.push_back({std::to_string(raw.joints.size()),
                          parent == kNoParent ? carrier : parent + first, chain.restOffset(joint),
                          chain.restRotation(joint)});
  }
  return first;
}

}  // namespace foretouch
