#include "network/wire/messages.h"

#include "lss/index.h"
#include "network/wire/hashed_bytes.h"

namespace foretouch {

const char* toString(StepKind kind) {
  switch (kind) {
    case StepKind::Consecutive: return "consecutive";
    case StepKind::First: return "first";
    case StepKind::AcrossGap: return "across-gap";
  }
  return "consecutive";
}

const char* toString(BrokenBound::Claim claim) {
  switch (claim) {
    case BrokenBound::Claim::InGap: return "gap";
    case BrokenBound::Claim::Ahead: return "ahead";
  }
  return "gap";
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

}  // namespace foretouch
