// The codec against lcm-gen's own: what either writes, the other reads, field by field.
#include <cstring>
#include <foretouch/contacts_t.hpp>
#include <foretouch/person_t.hpp>
#include <foretouch/pose_t.hpp>
#include <foretouch/skeleton_t.hpp>
#include <foretouch/solid_t.hpp>
#include <foretouch/status_t.hpp>
#include <string>

#include <gtest/gtest.h>

#include "network/wire/codec.h"
#include "network/wire/payload_check.h"
#include "tests/network/random_messages.h"

namespace foretouch {
namespace {

using test::Random;

/// Equal and, if they are doubles, of the same bits.
template <typename T>
bool same(const T& a, const T& b) {
  return a == b;
}
bool same(double a, double b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

template <typename LcmType>
Bytes lcmBytes(const LcmType& wire) {
  Bytes bytes(static_cast<std::size_t>(wire.getEncodedSize()));
  EXPECT_EQ(wire.encode(bytes.data(), 0, static_cast<int>(bytes.size())),
            static_cast<int>(bytes.size()));
  return bytes;
}

/// What a list of one part of every element is.
template <typename Element, typename Part>
auto listOf(const std::vector<Element>& elements, Part part) {
  std::vector<std::decay_t<decltype(part(elements[0]))>> list;
  for (const Element& element : elements) list.push_back(part(element));
  return list;
}

template <typename T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!same(a[i], b[i])) return false;
  }
  return true;
}

void expectSame(const SkeletonMessage& m, const skeleton_t& w) {
  EXPECT_TRUE(w.version == 1 && w.avatar == m.avatar && w.session == m.session &&
              w.send_utime == m.sendUtimeUs && w.generation == m.generation && w.hash == m.hash &&
              w.source == m.source && same(w.rate, m.rateHz));
  const auto& joints = m.skeleton.joints;
  const auto part = [&](auto field) { return listOf(joints, field); };
  EXPECT_TRUE(same(w.names, part([](const RawJoint& j) { return j.name; })));
  EXPECT_TRUE(same(w.parents, part([](const RawJoint& j) { return j.parent; })));
  EXPECT_TRUE(same(w.offset_x, part([](const RawJoint& j) { return j.offset.x(); })));
  EXPECT_TRUE(same(w.offset_y, part([](const RawJoint& j) { return j.offset.y(); })));
  EXPECT_TRUE(same(w.offset_z, part([](const RawJoint& j) { return j.offset.z(); })));
  EXPECT_TRUE(same(w.rotation_w, part([](const RawJoint& j) { return j.rotation.w(); })));
  EXPECT_TRUE(same(w.rotation_x, part([](const RawJoint& j) { return j.rotation.x(); })));
  EXPECT_TRUE(same(w.rotation_y, part([](const RawJoint& j) { return j.rotation.y(); })));
  EXPECT_TRUE(same(w.rotation_z, part([](const RawJoint& j) { return j.rotation.z(); })));
}

void expectSame(const PoseMessage& m, const pose_t& w) {
  EXPECT_TRUE(w.version == 1 && w.avatar == m.avatar && w.session == m.session &&
              w.sequence == m.sequence && w.utime == m.utimeUs && w.send_utime == m.sendUtimeUs &&
              w.skeleton_hash == m.skeletonHash);
  const auto part = [&](auto field) { return listOf(m.joints, field); };
  EXPECT_TRUE(same(w.joints, part([](const PoseJoint& j) { return j.joint; })));
  EXPECT_TRUE(same(w.flags, part([](const PoseJoint& j) { return j.flags; })));
  EXPECT_TRUE(same(w.rotation_w, part([](const PoseJoint& j) { return j.rotation.w(); })));
  EXPECT_TRUE(same(w.rotation_x, part([](const PoseJoint& j) { return j.rotation.x(); })));
  EXPECT_TRUE(same(w.rotation_y, part([](const PoseJoint& j) { return j.rotation.y(); })));
  EXPECT_TRUE(same(w.rotation_z, part([](const PoseJoint& j) { return j.rotation.z(); })));
  const auto moved = [&](auto field) { return listOf(m.translations, field); };
  EXPECT_TRUE(same(w.translated_joints, moved([](const PoseTranslation& t) { return t.joint; })));
  EXPECT_TRUE(
      same(w.translation_x, moved([](const PoseTranslation& t) { return t.translation.x(); })));
  EXPECT_TRUE(
      same(w.translation_y, moved([](const PoseTranslation& t) { return t.translation.y(); })));
  EXPECT_TRUE(
      same(w.translation_z, moved([](const PoseTranslation& t) { return t.translation.z(); })));
}

void expectSame(const AnsweredContact& m, const contacts_t& w, std::size_t i) {
  const LinkContact& c = m.contact;
  EXPECT_TRUE(w.links[i] == c.link && w.link_names[i] == m.linkName &&
              w.reasons[i] == static_cast<int>(c.reason) && same(w.free_until[i], c.freeUntil));
  if (c.verdict == Verdict::Undecided) {
    EXPECT_TRUE(w.triangles[i] == -1 && w.objects[i].empty() && w.link_triangles[i] == -1 &&
                w.link_features[i] == 0 && w.scene_features[i] == 0);
  } else {
    EXPECT_TRUE(w.triangles[i] == c.triangle && w.objects[i] == m.objectName &&
                w.link_triangles[i] == c.linkTriangle &&
                w.link_features[i] == static_cast<int>(c.linkFeature) &&
                w.scene_features[i] == static_cast<int>(c.sceneFeature));
  }
  EXPECT_TRUE(same(w.separation[i], c.separation) && same(w.penetration[i], c.penetration));
  EXPECT_TRUE(same(w.point_x[i], c.p_WScene.x()) && same(w.point_y[i], c.p_WScene.y()) &&
              same(w.point_z[i], c.p_WScene.z()));
  EXPECT_TRUE(same(w.on_link_x[i], c.p_WLink.x()) && same(w.on_link_y[i], c.p_WLink.y()) &&
              same(w.on_link_z[i], c.p_WLink.z()));
  EXPECT_TRUE(same(w.normal_x[i], c.nhat_SL_W.x()) && same(w.normal_y[i], c.nhat_SL_W.y()) &&
              same(w.normal_z[i], c.nhat_SL_W.z()));
}

void expectSame(const ContactsMessage& m, const contacts_t& w) {
  EXPECT_TRUE(w.version == 1 && w.avatar == m.avatar && w.session == m.session &&
              w.sequence_from == m.sequenceFrom && w.sequence_to == m.sequenceTo &&
              w.utime_from == m.utimeFromUs && w.utime_to == m.utimeToUs &&
              w.skeleton_hash == m.skeletonHash && w.kind == static_cast<int>(m.kind) &&
              w.lost == m.lost && same(w.tolerance, m.tolerance) &&
              w.fidelity == toString(m.fidelity) && w.work_budget == m.workBudget &&
              w.receive_utime == m.receiveUtimeUs && w.send_utime == m.sendUtimeUs &&
              same(w.query_us, m.queryUs));
  EXPECT_TRUE(
      same(w.verdicts, listOf(m.verdicts, [](Verdict v) { return static_cast<std::uint8_t>(v); })));
  ASSERT_EQ(static_cast<std::size_t>(w.num_contacts), m.contacts.size());
  for (std::size_t i = 0; i < m.contacts.size(); ++i) expectSame(m.contacts[i], w, i);
}

void expectSame(const StatusMessage& m, const status_t& w) {
  EXPECT_TRUE(w.version == 1 && w.utime == m.utimeUs && w.start_utime == m.startUtimeUs &&
              w.build == m.build && w.scene == m.scene && w.num_avatars == m.numAvatars &&
              w.num_workers == m.numWorkers && w.received == m.received &&
              w.answered == m.answered && w.rejected == m.rejected && w.lost == m.lost &&
              w.gaps == m.gaps && w.waiting == m.waiting &&
              w.publish_failures == m.publishFailures && w.journal_failures == m.journalFailures &&
              w.kernel_drops == m.kernelDrops);
  EXPECT_TRUE(same(w.reasons, listOf(m.counts, [](const auto& c) { return c.reason; })));
  EXPECT_TRUE(same(w.counts, listOf(m.counts, [](const auto& c) { return c.count; })));
  EXPECT_TRUE(same(w.latency_p50, m.latencyP50Us) && same(w.latency_p99, m.latencyP99Us) &&
              same(w.latency_max, m.latencyMaxUs) && same(w.query_p50, m.queryP50Us) &&
              same(w.query_p99, m.queryP99Us) && same(w.query_max, m.queryMaxUs));
}

/// Ours to lcm-gen's type; that one's bytes back to ours.
template <typename LcmType, typename Message>
void expectBothWays(const Message& message) {
  Bytes bytes;
  encode(message, bytes);
  LcmType wire;
  ASSERT_EQ(wire.decode(bytes.data(), 0, static_cast<int>(bytes.size())),
            static_cast<int>(bytes.size()));
  expectSame(message, wire);
  EXPECT_EQ(lcmBytes(wire), bytes);
  Message decoded;
  ASSERT_EQ(decode(lcmBytes(wire), decoded), Reject::None);
  expectSame(decoded, wire);
}

TEST(CodecAgainstLcmGen, ReadsAndWritesWhatItReadsAndWrites) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    expectBothWays<skeleton_t>(test::randomSkeletonMessage(random, 1 + random.below(30)));
    expectBothWays<pose_t>(test::randomPoseMessage(random, random.below(30)));
    expectBothWays<contacts_t>(test::randomContactsMessage(random, random.below(30)));
    expectBothWays<status_t>(test::randomStatusMessage(random, random.below(30)));
  }
}

/// Filled by lcm-gen's names alone: a sender that has never seen our types.
pose_t foreignPose(Random& random, int n) {
  pose_t wire;
  wire.version = 1;
  wire.avatar = 3;
  wire.session = wire.sequence = wire.utime = wire.send_utime = 1'000'000 + random.below(1000);
  wire.skeleton_hash = -5;
  wire.num_joints = wire.num_translations = n;
  for (int i = 0; i < n; ++i) {
    wire.joints.push_back(n - 1 - i);
    wire.flags.push_back(pose_t::VALID | pose_t::TRACKED);
    const Quaternion q = random.rotation();
    wire.rotation_w.push_back(q.w());
    wire.rotation_x.push_back(q.x());
    wire.rotation_y.push_back(q.y());
    wire.rotation_z.push_back(q.z());
    wire.translated_joints.push_back(i);
    wire.translation_x.push_back(random.uniform(-1.0, 1.0));
    wire.translation_y.push_back(random.uniform(-1.0, 1.0));
    wire.translation_z.push_back(random.uniform(-1.0, 1.0));
  }
  return wire;
}

TEST(CodecAgainstLcmGen, ReadsPosesThatItMade) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Random random(seed);
    const pose_t wire = foreignPose(random, random.below(100));
    PoseMessage message;
    ASSERT_EQ(decode(lcmBytes(wire), message), Reject::None) << seed;
    expectSame(message, wire);
  }
}

// As many as a skeleton may have are read; one more is not, whatever lcm-gen thinks of it.
TEST(CodecAgainstLcmGen, RefusesListsAndTextsBeyondTheLimits) {
  Random random(1);
  PoseMessage pose;
  EXPECT_EQ(decode(lcmBytes(foreignPose(random, kMaxJoints)), pose), Reject::None);
  EXPECT_EQ(decode(lcmBytes(foreignPose(random, kMaxJoints + 1)), pose), Reject::Limit);

  skeleton_t wire;
  wire.version = 1;
  wire.avatar = 0;
  wire.session = wire.send_utime = wire.hash = 0;
  wire.generation = 0;
  wire.rate = 0.0;
  wire.num_joints = 1;
  wire.parents = {-1};
  for (auto* const part : {&wire.offset_x, &wire.offset_y, &wire.offset_z, &wire.rotation_x,
                           &wire.rotation_y, &wire.rotation_z}) {
    *part = {0.0};
  }
  wire.rotation_w = {1.0};
  const auto rejectOf = [&](std::size_t sourceBytes, std::size_t nameBytes) {
    wire.source.assign(sourceBytes, 's');
    wire.names.assign(1, std::string(nameBytes, 'n'));
    RawSkeleton skeleton;
    skeleton.joints.push_back({wire.names[0], kNoParent, {0.0, 0.0, 0.0}, Quaternion::Identity()});
    wire.hash = skeletonHash(skeleton);
    SkeletonMessage message;
    return decode(lcmBytes(wire), message);
  };
  EXPECT_EQ(rejectOf(kMaxTextBytes, kMaxNameBytes), Reject::None);
  EXPECT_EQ(rejectOf(kMaxTextBytes + 1, kMaxNameBytes), Reject::Limit);
  EXPECT_EQ(rejectOf(kMaxTextBytes, kMaxNameBytes + 1), Reject::Limit);
}

TEST(CodecAgainstLcmGen, ReadsOurSolidMessages) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const SolidMessage m =
        test::randomSolidMessage(random, 1 + random.below(9), 1 + random.below(4), random.below(5));
    Bytes bytes;
    encode(m, bytes);
    solid_t w;
    ASSERT_EQ(w.decode(bytes.data(), 0, static_cast<int>(bytes.size())),
              static_cast<int>(bytes.size()));
    EXPECT_TRUE(w.version == 1 && w.avatar == m.avatar && w.sequence == m.sequence &&
                w.utime == m.utimeUs && w.avatar_hash == m.avatarHash &&
                w.state == static_cast<int>(m.state) && same(w.deviation, m.deviation) &&
                same(w.clearance, m.clearance) && w.snap_in_us == m.snapInUs &&
                same(w.times, m.times) && same(w.solid_us, m.solidUs));
    for (std::size_t i = 0; i < m.way.size(); ++i) {
      const auto rotation = [&](auto part) { return listOf(m.way[i].rotations, part); };
      EXPECT_TRUE(same(w.rotation_w[i], rotation([](const Quaternion& q) { return q.w(); })));
      EXPECT_TRUE(same(w.rotation_z[i], rotation([](const Quaternion& q) { return q.z(); })));
      EXPECT_TRUE(same(w.translation_y[i], listOf(m.way[i].translations, [](const auto& p) {
                         return static_cast<double>(p.y());
                       })));
    }
    const auto part = [&](auto field) { return listOf(m.contacts, field); };
    EXPECT_TRUE(same(w.push, part([](const ShownContact& c) { return c.contact.push; })));
    EXPECT_TRUE(same(w.others, part([](const ShownContact& c) { return c.contact.other; })));
    EXPECT_TRUE(same(w.objects, part([](const ShownContact& c) { return c.otherName; })));
    EXPECT_EQ(lcmBytes(w), bytes);
  }
}

TEST(CodecAgainstLcmGen, ReadsOurPersonMessages) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const PersonMessage m = test::randomPersonMessage(random, random.below(9), random.below(5));
    Bytes bytes;
    encode(m, bytes);
    person_t w;
    ASSERT_EQ(w.decode(bytes.data(), 0, static_cast<int>(bytes.size())),
              static_cast<int>(bytes.size()));
    EXPECT_TRUE(w.version == 1 && w.avatar == m.avatar && w.sequence == m.sequence &&
                w.utime_to == m.utimeToUs && w.bounds_hash == m.boundsHash &&
                w.between == static_cast<int>(m.model) && w.not_before == m.notBeforeUs &&
                w.ahead_us == m.aheadUs && same(w.person_us, m.personUs));
    const auto part = [&](auto field) { return listOf(m.brackets, field); };
    EXPECT_TRUE(
        same(w.possible_from, part([](const ToldBracket& t) { return t.bracket.possibleFrom; })));
    EXPECT_TRUE(
        same(w.certain_until, part([](const ToldBracket& t) { return t.bracket.certainUntil; })));
    EXPECT_TRUE(same(w.growth, part([](const ToldBracket& t) { return t.bracket.growth; })));
    EXPECT_TRUE(same(w.others, part([](const ToldBracket& t) { return t.bracket.other; })));
    EXPECT_TRUE(same(w.objects, part([](const ToldBracket& t) { return t.otherName; })));
    EXPECT_TRUE(same(w.beyond, listOf(m.broken, [](const BrokenBound& b) { return b.beyond; })));
    EXPECT_EQ(lcmBytes(w), bytes);
  }
}

// What no encoder of ours writes.
TEST(CodecAgainstLcmGen, RefusesPersonMessagesBeyondTheirLimit) {
  const auto after = [](int numBrackets) {
    PersonMessage small;
    small.verdicts = {BracketVerdict::Possible};
    small.notBeforeUs = {-1};
    Bytes bytes;
    encode(small, bytes);
    person_t w;
    EXPECT_GT(w.decode(bytes.data(), 0, static_cast<int>(bytes.size())), 0);
    const auto n = static_cast<std::size_t>(numBrackets);
    w.num_brackets = numBrackets;
    w.links.assign(n, 0);
    w.link_names.assign(n, "a");
    w.triangles.assign(n, 0);
    w.objects.assign(n, "o");
    w.others.assign(n, -1);
    w.claims.assign(n, 2);
    for (auto* const list :
         {&w.possible_from, &w.possible_until, &w.certain_from, &w.certain_until, &w.growth}) {
      list->assign(n, 0.0);
    }
    PersonMessage decoded;
    return decode(lcmBytes(w), decoded);
  };
  EXPECT_EQ(after(256), Reject::None);
  EXPECT_EQ(after(257), Reject::Limit);
}

// What no encoder of ours writes.
TEST(CodecAgainstLcmGen, RefusesSolidMessagesBeyondTheirLimits) {
  const auto after = [](int numJoints, int numPoses, int numContacts) {
    Random random(1);
    const SolidMessage small = test::randomSolidMessage(random, 1, 1, 1);
    Bytes bytes;
    encode(small, bytes);
    solid_t w;
    EXPECT_GT(w.decode(bytes.data(), 0, static_cast<int>(bytes.size())), 0);
    const auto joints = static_cast<std::size_t>(numJoints);
    const auto poses = static_cast<std::size_t>(numPoses);
    w.num_joints = numJoints;
    w.joint_states.resize(joints, 0);
    w.link_deviation.resize(joints, 0.0);
    w.num_poses = numPoses;
    w.times.clear();
    for (int i = 0; i < numPoses; ++i) w.times.push_back((i + 1.0) / numPoses);
    w.rotation_w.assign(poses, std::vector<double>(joints, 1.0));
    for (auto* const rows : {&w.rotation_x, &w.rotation_y, &w.rotation_z, &w.translation_x,
                             &w.translation_y, &w.translation_z}) {
      rows->assign(poses, std::vector<double>(joints, 0.0));
    }
    const auto contacts = static_cast<std::size_t>(numContacts);
    w.num_contacts = numContacts;
    w.links.resize(contacts, 0);
    w.link_names.resize(contacts, "a");
    w.lss.resize(contacts, 0);
    w.triangles.assign(contacts, 0);
    w.objects.resize(contacts, "o");
    w.others.assign(contacts, -1);
    for (auto* const list : {&w.point_x, &w.point_y, &w.point_z, &w.normal_x, &w.normal_y,
                             &w.normal_z, &w.gap, &w.push, &w.slip_speed}) {
      list->assign(contacts, 0.0);
    }
    SolidMessage decoded;
    return decode(lcmBytes(w), decoded);
  };
  EXPECT_EQ(after(1, 1, 1), Reject::None);
  EXPECT_EQ(after(512, 64, 256), Reject::None);
  EXPECT_EQ(after(513, 1, 0), Reject::Limit);
  EXPECT_EQ(after(0, 1, 0), Reject::Limit);
  EXPECT_EQ(after(1, 65, 0), Reject::Limit);
  EXPECT_EQ(after(1, 0, 0), Reject::Limit);
  EXPECT_EQ(after(1, 1, 257), Reject::Limit);
}

}  // namespace
}  // namespace foretouch
