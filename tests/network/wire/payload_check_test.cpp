// Bytes that are not quite a message: whatever is wrong with them is found before anything is
// allocated for them.
#include "network/wire/payload_check.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "network/wire/codec.h"
#include "tests/network/random_messages.h"
#include "tests/support/allocation_count.h"

namespace foretouch {
namespace {

using test::Random;

/// One encoded message, and where its integers are that say how much follows.
struct Sample {
  PayloadType type = PayloadType::Pose;
  Bytes bytes;
  std::vector<std::size_t> counts, textLengths;
};

std::int32_t readInt32(const Bytes& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | bytes[at + i];
  return static_cast<std::int32_t>(value);
}

void writeInt32(Bytes& bytes, std::size_t at, std::int64_t value) {
  for (std::size_t i = 0; i < 4; ++i) {
    bytes[at + i] = static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> (24 - 8 * i));
  }
}

/// Notes a text's length at `at` and returns the place after the text.
std::size_t textAt(Sample& sample, std::size_t at) {
  sample.textLengths.push_back(at);
  return at + 4 + static_cast<std::size_t>(readInt32(sample.bytes, at));
}

std::size_t textsAt(Sample& sample, std::size_t at, int n) {
  for (int i = 0; i < n; ++i) at = textAt(sample, at);
  return at;
}

/// Notes a count at `at` and gives it.
int countAt(Sample& sample, std::size_t at) {
  sample.counts.push_back(at);
  return readInt32(sample.bytes, at);
}

// The places are reckoned from network/lcm by hand, not by the table that is tested.
constexpr std::size_t kHead = 8 + 2;  // fingerprint, version

Sample skeletonSample(Random& random) {
  Sample sample{PayloadType::Skeleton, {}, {}, {}};
  encode(test::randomSkeletonMessage(random, 1 + random.below(6)), sample.bytes);
  const std::size_t count = textAt(sample, kHead + 32) + 8;
  textsAt(sample, count + 4, countAt(sample, count));
  return sample;
}

Sample poseSample(Random& random) {
  Sample sample{PayloadType::Pose, {}, {}, {}};
  encode(test::randomPoseMessage(random, 1 + random.below(6)), sample.bytes);
  const auto numJoints = static_cast<std::size_t>(countAt(sample, kHead + 44));
  countAt(sample, kHead + 44 + 4 + numJoints * (4 + 1 + 32));
  return sample;
}

Sample contactsSample(Random& random) {
  Sample sample{PayloadType::Contacts, {}, {}, {}};
  encode(test::randomContactsMessage(random, 1 + random.below(6)), sample.bytes);
  const std::size_t links = textAt(sample, kHead + 52 + 17) + 8;
  const std::size_t contacts = links + 4 + static_cast<std::size_t>(countAt(sample, links));
  const int n = countAt(sample, contacts);
  const std::size_t bytes = static_cast<std::size_t>(n) * (1 + 12 * 8 + 4);
  textsAt(sample, textsAt(sample, contacts + 4 + 4 * static_cast<std::size_t>(n), n) + bytes, n);
  return sample;
}

Sample solidSample(Random& random) {
  Sample sample{PayloadType::Solid, {}, {}, {}};
  const int numJoints = 1 + random.below(4), numPoses = 1 + random.below(3);
  encode(test::randomSolidMessage(random, numJoints, numPoses, random.below(4)), sample.bytes);
  const auto square = [](int count, std::size_t size) {
    return static_cast<std::size_t>(count) * size;
  };
  const std::size_t joints = kHead + 28 + 25 + 32 + 36;
  const std::size_t poses = joints + 4 + square(countAt(sample, joints), 1 + 8);
  const std::size_t contacts =
      poses + 4 + square(countAt(sample, poses), 8) + square(numPoses * numJoints, 7 * 8);
  const int n = countAt(sample, contacts);
  textsAt(sample, textsAt(sample, contacts + 4 + square(n, 4), n) + square(n, 8), n);
  return sample;
}

Sample statusSample(Random& random) {
  Sample sample{PayloadType::Status, {}, {}, {}};
  encode(test::randomStatusMessage(random, 1 + random.below(6)), sample.bytes);
  const std::size_t count = textAt(sample, textAt(sample, kHead + 16)) + 8 + 48;
  textsAt(sample, count + 4, countAt(sample, count));
  return sample;
}

Sample speakerSample(Random& random) {
  Sample sample{PayloadType::Speaker, {}, {}, {}};
  encode(test::randomSpeakerMessage(random), sample.bytes);
  return sample;
}

/// A few of every type.
Sample bodySample(Random& random) {
  Sample sample{PayloadType::Body, {}, {}, {}};
  encode(test::randomBodyMessage(random, 1 + random.below(12)), sample.bytes);
  textAt(sample, kHead + 4 + 32 + 2);
  return sample;
}

Sample rigidPoseSample(Random& random) {
  Sample sample{PayloadType::RigidPose, {}, {}, {}};
  encode(test::randomRigidPoseMessage(random, 1 + random.below(6)), sample.bytes);
  countAt(sample, kHead + 32);
  return sample;
}

Sample eventsSample(Random& random) {
  Sample sample{PayloadType::Events, {}, {}, {}};
  encode(test::randomEventsMessage(random, 1 + random.below(6)), sample.bytes);
  const auto behind = [&sample](std::size_t count, std::size_t size) {
    return count + 4 + static_cast<std::size_t>(countAt(sample, count)) * size;
  };
  const std::size_t unknown = behind(kHead + 32 + 1 + 8, 4 + 8 + 1);
  const std::size_t events = behind(unknown, 2 * 4 + 1 + 2 * 8);
  countAt(sample, behind(events, 4 + 4 * 8 + 9 * 4 + 18 * 8 + 1));
  return sample;
}

Sample pushesSample(Random& random) {
  Sample sample{PayloadType::Pushes, {}, {}, {}};
  encode(test::randomPushesMessage(random, 1 + random.below(4)), sample.bytes);
  const std::size_t contacts = kHead + 4 + 5 * 8 + 1;
  const int n = countAt(sample, contacts), ids = n * 4;
  const std::size_t names = contacts + 4 + static_cast<std::size_t>(ids);
  const std::size_t crushes =
      textsAt(sample, names, n) + static_cast<std::size_t>(n * (3 * 4 + 9 * 8)) + 4;
  const int m = countAt(sample, crushes);
  textsAt(sample, crushes + 4 + static_cast<std::size_t>(2 * 4 * m), m);
  return sample;
}

Sample personSample(Random& random) {
  Sample sample{PayloadType::Person, {}, {}, {}};
  encode(test::randomPersonMessage(random, 1 + random.below(4), random.below(4)), sample.bytes);
  const auto times = [](int count, std::size_t size) {
    return static_cast<std::size_t>(count) * size;
  };
  const std::size_t links = kHead + 28 + 17 + 33;
  const std::size_t brackets = links + 4 + times(countAt(sample, links), 1 + 8) + 8;
  const int n = countAt(sample, brackets);
  const std::size_t objects = textsAt(sample, brackets + 4 + times(n, 4), n) + times(n, 4);
  countAt(sample, textsAt(sample, objects, n) + times(n, 4 + 1 + 5 * 8) + 4);
  return sample;
}

std::vector<Sample> samples() {
  std::vector<Sample> all;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    Random random(seed);
    all.push_back(skeletonSample(random));
    all.push_back(poseSample(random));
    all.push_back(contactsSample(random));
    all.push_back(solidSample(random));
    all.push_back(statusSample(random));
    all.push_back(speakerSample(random));
    all.push_back(bodySample(random));
    all.push_back(rigidPoseSample(random));
    all.push_back(eventsSample(random));
    all.push_back(pushesSample(random));
    all.push_back(personSample(random));
  }
  return all;
}

/// By the whole decoder.
Reject decodeAny(PayloadType type, ByteView bytes) {
  static SkeletonMessage skeleton;
  static PoseMessage pose;
  static ContactsMessage contacts;
  static SolidMessage solid;
  static StatusMessage status;
  static SpeakerMessage speaker;
  static BodyMessage body;
  static RigidPoseMessage rigidPose;
  static EventsMessage events;
  static PushesMessage pushes;
  static PersonMessage person;
  switch (type) {
    case PayloadType::Skeleton: return decode(bytes, skeleton);
    case PayloadType::Pose: return decode(bytes, pose);
    case PayloadType::Contacts: return decode(bytes, contacts);
    case PayloadType::Solid: return decode(bytes, solid);
    case PayloadType::Status: return decode(bytes, status);
    case PayloadType::Speaker: return decode(bytes, speaker);
    case PayloadType::Body: return decode(bytes, body);
    case PayloadType::RigidPose: return decode(bytes, rigidPose);
    case PayloadType::Events: return decode(bytes, events);
    case PayloadType::Pushes: return decode(bytes, pushes);
    case PayloadType::Person: return decode(bytes, person);
  }
  return Reject::Length;
}

/// In memory of exactly its size, so that a sanitizer sees the first byte read beyond it.
Reject decodeAlone(PayloadType type, const std::uint8_t* first, std::size_t size) {
  const Bytes exact(first, first + size);
  return decodeAny(type, exact);
}

constexpr std::int64_t kEvil[] = {-1,
                                  std::numeric_limits<std::int32_t>::min(),
                                  std::numeric_limits<std::int32_t>::max(),
                                  0x40000001,
                                  100'000'000,
                                  0x10000000,
                                  65536};

TEST(PayloadCheck, AcceptsTheSamples) {
  for (const Sample& sample : samples()) {
    EXPECT_EQ(checkPayload(sample.type, sample.bytes), Reject::None);
    EXPECT_EQ(decodeAny(sample.type, sample.bytes), Reject::None);
  }
}

TEST(PayloadCheck, RefusesEveryPrefix) {
  for (const Sample& sample : samples()) {
    for (std::size_t size = 0; size < sample.bytes.size(); ++size) {
      ASSERT_EQ(decodeAlone(sample.type, sample.bytes.data(), size), Reject::Length) << size;
    }
  }
  EXPECT_EQ(decodeAny(PayloadType::Pose, ByteView()), Reject::Length);
}

TEST(PayloadCheck, RefusesEveryByteAfterTheEnd) {
  for (const Sample& sample : samples()) {
    for (int extra = 0; extra < 256; ++extra) {
      Bytes longer = sample.bytes;
      longer.push_back(static_cast<std::uint8_t>(extra));
      ASSERT_EQ(decodeAny(sample.type, longer), Reject::Length) << extra;
    }
  }
}

TEST(PayloadCheck, RefusesEveryWrongCount) {
  for (const Sample& sample : samples()) {
    for (const std::size_t at : sample.counts) {
      Bytes bytes = sample.bytes;
      for (const std::int64_t evil : kEvil) {
        writeInt32(bytes, at, evil);
        EXPECT_EQ(decodeAny(sample.type, bytes), Reject::Limit) << at << ": " << evil;
      }
      const std::int32_t right = readInt32(sample.bytes, at);
      for (const std::int32_t wrong : {right + 1, kMaxListed}) {
        writeInt32(bytes, at, wrong);
        EXPECT_NE(decodeAny(sample.type, bytes), Reject::None) << at << ": " << wrong;
      }
    }
  }
}

TEST(PayloadCheck, RefusesEveryWrongTextLength) {
  for (const Sample& sample : samples()) {
    for (const std::size_t at : sample.textLengths) {
      Bytes bytes = sample.bytes;
      for (const std::int64_t evil : kEvil) {
        writeInt32(bytes, at, evil);
        EXPECT_EQ(decodeAny(sample.type, bytes), evil < 1 ? Reject::Length : Reject::Limit);
      }
      const std::int32_t right = readInt32(sample.bytes, at);
      for (const std::int32_t wrong : {0, right - 1, right + 1}) {
        writeInt32(bytes, at, wrong);
        EXPECT_NE(decodeAny(sample.type, bytes), Reject::None) << at << ": " << wrong;
      }
    }
  }
}

TEST(PayloadCheck, RefusesTextsWithoutTheirEndOrWithOneInside) {
  for (const Sample& sample : samples()) {
    for (const std::size_t at : sample.textLengths) {
      const auto length = static_cast<std::size_t>(readInt32(sample.bytes, at));
      Bytes bytes = sample.bytes;
      bytes[at + 4 + length - 1] = 'x';
      EXPECT_EQ(decodeAny(sample.type, bytes), Reject::Length);
      if (length < 2) continue;
      bytes = sample.bytes;
      bytes[at + 4] = 0;
      EXPECT_EQ(decodeAny(sample.type, bytes), Reject::Length);
    }
  }
}

TEST(PayloadCheck, RefusesForeignFingerprintsAndVersions) {
  for (const Sample& sample : samples()) {
    for (std::size_t i = 0; i < kHead; ++i) {
      Bytes bytes = sample.bytes;
      bytes[i] ^= 0x10;
      EXPECT_EQ(decodeAny(sample.type, bytes), i < 8 ? Reject::Fingerprint : Reject::Version);
    }
    for (const PayloadType other : {PayloadType::Skeleton, PayloadType::Pose, PayloadType::Contacts,
                                    PayloadType::Status, PayloadType::Speaker}) {
      if (other == sample.type) continue;
      EXPECT_EQ(decodeAny(other, sample.bytes), Reject::Fingerprint);
    }
  }
}

TEST(PayloadCheck, RefusesMessagesThatAreTooLarge) {
  Random random(3);
  Bytes bytes = poseSample(random).bytes;
  bytes.resize(kMaxMessageBytes);
  EXPECT_EQ(decodeAny(PayloadType::Pose, bytes), Reject::Length);
  bytes.push_back(0);
  EXPECT_EQ(decodeAny(PayloadType::Pose, bytes), Reject::Limit);
}

TEST(PayloadCheck, AllocatesNothingForWhatIsRefused) {
  if (!test::countsAllocations()) GTEST_SKIP() << "this build has an allocator of its own";
  std::vector<Sample> all = samples();
  decodeAny(PayloadType::Pose, ByteView());  // makes the messages that it decodes into
  const auto refused = [](PayloadType type, ByteView bytes) {
    const std::uint64_t before = test::numAllocations();
    const Reject reject = decodeAny(type, bytes);
    const std::uint64_t made = test::numAllocations() - before;
    return reject != Reject::None && made == 0;
  };
  for (Sample& sample : all) {
    std::vector<std::size_t> places = sample.counts;
    places.insert(places.end(), sample.textLengths.begin(), sample.textLengths.end());
    for (const std::size_t at : places) {
      const std::int32_t right = readInt32(sample.bytes, at);
      for (const std::int64_t evil : kEvil) {
        writeInt32(sample.bytes, at, evil);
        EXPECT_TRUE(refused(sample.type, sample.bytes)) << at << ": " << evil;
      }
      writeInt32(sample.bytes, at, right);
    }
    for (std::size_t size = 0; size < sample.bytes.size(); ++size) {
      EXPECT_TRUE(refused(sample.type, ByteView(sample.bytes.data(), size))) << size;
    }
  }
}

// Wherever it stands, no integer makes a decoder read beyond the end, allocate much or not return.
TEST(PayloadCheck, SurvivesEveryIntegerAnywhere) {
  for (const Sample& sample : samples()) {
    for (std::size_t at = 0; at + 4 <= sample.bytes.size(); ++at) {
      Bytes bytes = sample.bytes;
      for (const std::int64_t evil : kEvil) {
        writeInt32(bytes, at, evil);
        static_cast<void>(decodeAlone(sample.type, bytes.data(), bytes.size()));
      }
    }
  }
}

// What is accepted after random damage is a message like any other: it is written as it was read.
TEST(PayloadCheck, SurvivesRandomDamage) {
  int accepted = 0;
  for (std::uint64_t seed = 0; seed < 20'000; ++seed) {
    Random random(seed);
    Bytes bytes = poseSample(random).bytes;
    for (int i = 0; i <= random.below(3); ++i) {
      bytes[static_cast<std::size_t>(random.below(static_cast<int>(bytes.size())))] ^=
          static_cast<std::uint8_t>(1 << random.below(8));
    }
    PoseMessage pose, again;
    if (decode(bytes, pose) != Reject::None) continue;
    ++accepted;
    encode(pose, bytes);
    ASSERT_EQ(decode(bytes, again), Reject::None) << seed;
    Bytes rewritten;
    encode(again, rewritten);
    ASSERT_EQ(rewritten, bytes) << seed;
  }
  EXPECT_GT(accepted, 2'000);
  EXPECT_LT(accepted, 18'000);
}

}  // namespace
}  // namespace foretouch
