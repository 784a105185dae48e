#include "network/wire/messages.h"

#include <cstring>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "lss/index.h"

namespace foretouch {
namespace {

/// The bytes to hash: integers and doubles little-endian on every machine.
class HashedBytes {
 public:
  void add(std::uint64_t word) {
    for (int shift = 0; shift < 64; shift += 8) {
      bytes_.push_back(static_cast<char>(static_cast<std::uint8_t>(word >> shift)));
    }
  }
  void add(double number) {
    std::uint64_t word = 0;
    std::memcpy(&word, &number, sizeof word);
    add(word);
  }
  void add(const std::string& text) {
    add(static_cast<std::uint64_t>(text.size()));
    bytes_ += text;
  }
  [[nodiscard]] std::int64_t hash() const {
    return static_cast<std::int64_t>(XXH64(bytes_.data(), bytes_.size(), 0));
  }

 private:
  std::string bytes_;
};

}  // namespace

const char* toString(StepKind kind) {
  switch (kind) {
    case StepKind::Consecutive: return "consecutive";
    case StepKind::First: return "first";
    case StepKind::AcrossGap: return "across-gap";
  }
  return "consecutive";
}

std::int64_t skeletonHash(const RawSkeleton& skeleton) {
  HashedBytes bytes;
  for (const RawJoint& joint : skeleton.joints) {
    bytes.add(joint.name);
    bytes.add(static_cast<std::uint64_t>(static_cast<std::int64_t>(joint.parent)));
    for (int i = 0; i < 3; ++i) bytes.add(joint.offset[i]);
    bytes.add(joint.rotation.w());
    bytes.add(joint.rotation.x());
    bytes.add(joint.rotation.y());
    bytes.add(joint.rotation.z());
  }
  return bytes.hash();
}

RawSkeleton rawSkeleton(const Skeleton& skeleton) {
  RawSkeleton raw;
  raw.joints.reserve(countOf(skeleton.numJoints()));
  for (JointId joint = 0; joint < skeleton.numJoints(); ++joint) {
    raw.joints.push_back({skeleton.name(joint), skeleton.parent(joint), skeleton.restOffset(joint),
                          skeleton.restRotation(joint)});
  }
  return raw;
}

}  // namespace foretouch
