#include "tests/fuzz/vmc_inputs.h"

#include <algorithm>
#include <vector>

#include "assets/human_bones.h"
#include "network/vmc/vmc_stream.h"
#include "tests/fuzz/promise.h"

namespace foretouch::fuzz {
namespace {

/// Required bones alone, where a person has them.
Skeleton humanoid() {
  RawSkeleton raw;
  const auto add = [&](const std::string& name, JointId parent, const Eigen::Vector3d& offset) {
    raw.joints.push_back({name, parent, offset, Quaternion::Identity()});
    return static_cast<JointId>(raw.joints.size() - 1);
  };
  const JointId hips = add("hips", add("root", kNoParent, {0, 0, 0}), {0, 1, 0});
  const JointId spine = add("spine", hips, {0, 0.2, 0});
  add("head", spine, {0, 0.4, 0});
  for (const auto& [side, s] : {std::pair<std::string, double>{"left", 1.0}, {"right", -1.0}}) {
    const JointId arm = add(side + "UpperArm", spine, {0.2 * s, 0.2, 0});
    add(side + "Hand", add(side + "LowerArm", arm, {0.3 * s, 0, 0}), {0.3 * s, 0, 0});
    const JointId leg = add(side + "UpperLeg", hips, {0.1 * s, -0.1, 0});
    add(side + "Foot", add(side + "LowerLeg", leg, {0, -0.4, 0}), {0, -0.4, 0});
  }
  return Skeleton::build(raw).value();
}

const VmcBody& body() {
  static const VmcBody one = VmcBody::make(1, humanoid(), VmcBones::Original).value();
  return one;
}

/// The least bytes of a bone's message: its address, types, a name and seven numbers.
constexpr std::size_t kLeastBoneBytes = 20 + 12 + 8 + 28;

void checkSaid(const VmcStream::Said& said, std::int64_t now) {
  Bytes payload;
  PoseMessage pose;
  encode(said.pose, payload);
  require(decode(payload, pose) == Reject::None, "what is said can be read");
  require(pose.sequence >= kFirstUncounted, "no order is claimed");
  require(said.receiveUtimeUs <= now && pose.session <= now + 1, "nothing comes from the future");
  require(!pose.joints.empty(), "a pose has joints");
  if (!said.skeleton) return;
  SkeletonMessage skeleton;
  encode(*said.skeleton, payload);
  require(decode(payload, skeleton) == Reject::None, "its skeleton can be read");
  require(skeleton.hash == pose.skeletonHash, "and is the pose's");
}

}  // namespace

bool feedVmc(const std::uint8_t* data, std::size_t size) {
  VmcStream stream(body());
  std::vector<VmcStream::Said> said;
  std::int64_t now = 1'000'000;
  std::size_t at = 0, poses = 0;
  while (at + 2 <= size) {
    const std::size_t length = static_cast<std::size_t>(data[at] << 8 | data[at + 1]);
    at += 2;
    const std::size_t end = at + std::min(length, size - at);
    const Bytes datagram(data + at, data + end);  // on the heap at its exact size
    at = end;
    now += 10'000;
    const std::size_t before = said.size();
    if (!stream.take(datagram, now, said)) {
      require(said.size() == before, "nothing of a broken packet counts");
    }
    for (std::size_t i = before; i < said.size(); ++i) checkSaid(said[i], now);
    poses = said.size();
    require(poses * kLeastBoneBytes <= size, "each pose has a bone of its own");
  }
  return poses > 0;
}

}  // namespace foretouch::fuzz
