// VMC over real sockets: three encoders say the same, senders are admitted as all are, and a
// service answers what they say without claiming more than it can.
#include <arpa/inet.h>
#include <cmath>
#include <cstdlib>
#include <map>
#include <netinet/in.h>
#include <sys/socket.h>
#include <thread>

#include <gtest/gtest.h>

#include "network/service/service.h"
#include "network/stream/stream_solver.h"
#include "network/vmc/vmc_receiver.h"
#include "network/vmc/vmc_stream.h"
#include "network/wire/messages.h"
#include "tests/assets/humanoid_body.h"
#include "tests/network/private_network.h"
#include "tests/network/service/service_fakes.h"
#include "tests/network/small_stream.h"
#include "tests/network/vmc/performer.h"
#include "tests/support/temp_folder.h"

namespace foretouch::test {
namespace {

constexpr std::uint16_t kPort = 39539;

/// As a float and back, which is what every encoder sends.
double single(double number) {
  return static_cast<double>(static_cast<float>(number));
}
RigidPose single(const RigidPose& pose) {
  const Quaternion& q = pose.rotation;
  const Eigen::Vector3d& p = pose.translation;
  return {Quaternion(single(q.w()), single(q.x()), single(q.y()), single(q.z())),
          {single(p.x()), single(p.y()), single(p.z())}};
}

Skeleton humanoid() {
  Random random(5);
  return test::body(&Part::bone, Eigen::Matrix3d::Identity(), false, random);
}

/// Some whole numbers among them, which node-osc sends as integers.
VmcWords wordsOf(std::uint64_t seed) {
  Random random(seed);
  VmcWords words;
  words.root = {Quaternion(1, 0, 0, 0), {1, 0, single(0.1 * static_cast<double>(seed))}};
  for (const Part& part : parts()) {
    words.bones.emplace_back(unityName(part.bone),
                             single(RigidPose{random.rotation(), random.inBox(1.0)}));
  }
  return words;
}

std::string numbersOf(const RigidPose& pose) {
  const Quaternion& q = pose.rotation;
  std::string text;
  for (const double n : {pose.translation.x(), pose.translation.y(), pose.translation.z(), q.x(),
                         q.y(), q.z(), q.w()}) {
    char digits[64];
    std::snprintf(digits, sizeof digits, ", %.17g", n);
    text += digits;
  }
  return text;
}

/// `isSplit`: a packet for each message.
std::string jsonOf(int frames, bool isSplit) {
  std::string packets;
  for (int k = 0; k < frames; ++k) {
    const VmcWords words = wordsOf(static_cast<std::uint64_t>(k));
    std::vector<std::string> messages{"[\"/VMC/Ext/Root/Pos\", \"root\"" + numbersOf(words.root) +
                                      "]"};
    for (const auto& [name, pose] : words.bones) {
      messages.push_back("[\"/VMC/Ext/Bone/Pos\", \"" + name + "\"" + numbersOf(pose) + "]");
    }
    messages.push_back("[\"/VMC/Ext/T\", " + std::to_string(k) + ".5]");
    std::string packet;
    for (const std::string& message : messages) {
      packet += (packet.empty() ? "" : isSplit ? "], [" : ", ") + message;
    }
    packets += (packets.empty() ? "[" : ", [") + packet + "]";
  }
  return "{\"port\": " + std::to_string(kPort) + ", \"packets\": [" + packets + "]}";
}

class VmcWire : public PrivateNetwork {
 protected:
  static std::unique_ptr<Receiver> receiver(std::unique_ptr<Receiver> other = nullptr,
                                            const VmcOptions& options = {}) {
    std::vector<VmcPort> ports;
    ports.push_back({kPort, valueOf(VmcBody::make(1, humanoid(), VmcBones::Original))});
    return valueOf(openVmcReceiver(std::move(other), std::move(ports), options));
  }
};

class Performer {
 public:
  explicit Performer(const char* from = "127.0.0.1")
      : socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in own{};
    own.sin_family = AF_INET;
    inet_pton(AF_INET, from, &own.sin_addr);
    EXPECT_EQ(bind(socket_.get(), reinterpret_cast<const sockaddr*>(&own), sizeof own), 0);
  }
  void send(const Bytes& bytes, const char* to = "127.0.0.1") const {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(kPort);
    inet_pton(AF_INET, to, &address.sin_addr);
    EXPECT_EQ(sendto(socket_.get(), bytes.data(), bytes.size(), 0,
                     reinterpret_cast<const sockaddr*>(&address), sizeof address),
              static_cast<ssize_t>(bytes.size()));
  }

 private:
  internal::FileDescriptor socket_;
};

std::vector<PoseMessage> posesIn(const std::vector<WireMessage>& messages) {
  std::vector<PoseMessage> poses;
  for (const WireMessage& message : messages) {
    if (message.channel != kPoseChannel) continue;
    EXPECT_EQ(decode(message.payload, poses.emplace_back()), Reject::None);
  }
  return poses;
}

/// What is said by our own encoder, without a socket.
std::vector<PoseMessage> expectedOf(int frames) {
  static const VmcBody body = valueOf(VmcBody::make(1, humanoid(), VmcBones::Original));
  VmcStream stream(body);
  std::vector<VmcStream::Said> said;
  for (int k = 0; k < frames; ++k) {
    EXPECT_TRUE(stream.take(wordsOf(static_cast<std::uint64_t>(k)).bundle(k + 0.5), k + 1, said));
  }
  std::vector<PoseMessage> poses;
  for (const VmcStream::Said& each : said) poses.push_back(each.pose);
  return poses;
}

void expectSame(const std::vector<PoseMessage>& poses, const std::vector<PoseMessage>& expected) {
  ASSERT_EQ(poses.size(), expected.size());
  for (std::size_t k = 0; k < poses.size(); ++k) {
    ASSERT_EQ(poses[k].joints.size(), expected[k].joints.size());
    for (std::size_t j = 0; j < poses[k].joints.size(); ++j) {
      EXPECT_EQ(poses[k].joints[j].rotation.coeffs(), expected[k].joints[j].rotation.coeffs());
      EXPECT_EQ(poses[k].joints[j].flags, expected[k].joints[j].flags);
    }
    ASSERT_EQ(poses[k].translations.size(), 1u);
    EXPECT_EQ(poses[k].translations[0].translation, expected[k].translations[0].translation);
  }
}

TEST_F(VmcWire, ThreeEncodersSayTheSame) {
  constexpr int kFrames = 20;
  const std::string here = FORETOUCH_VMC_ENCODERS;
  const std::map<std::string, std::string> encoders{
      {"node-osc", "test -d " + here + "/node_modules/node-osc && node " + here + "/send_osc.mjs "},
      {"liblo", "/usr/bin/python3 -c 'import liblo' 2>/dev/null && /usr/bin/python3 " + here +
                    "/send_osc.py "}};
  const std::vector<PoseMessage> expected = expectedOf(kFrames);
  ASSERT_EQ(expected.size(), static_cast<std::size_t>(kFrames));
  std::string absent;
  for (const auto& [name, command] : encoders) {
    for (const bool isSplit : {false, true}) {
      SCOPED_TRACE(name);
      const TempFolder folder;
      const std::string words = folder.write("words.json", jsonOf(kFrames, isSplit));
      const auto vmc = receiver();
      if (std::system((command + words).c_str()) != 0) {
        absent += " " + name;
        break;
      }
      std::vector<WireMessage> messages;
      ASSERT_TRUE(receiveUntil(*vmc, messages, [&] {
        return posesIn(messages).size() >= static_cast<std::size_t>(kFrames);
      }));
      expectSame(posesIn(messages), expected);
      EXPECT_EQ(vmc->counts().faults[static_cast<std::size_t>(DatagramFault::Osc)], 0u);
    }
  }
  if (!absent.empty()) GTEST_SKIP() << "absent, or it failed:" << absent;
}

TEST_F(VmcWire, ComesBesideLcmAndStrangersAreCounted) {
  const auto vmc = receiver(receiverOf({"POSE"}));
  const Performer performer;
  const auto publisher = publisherTo();
  performer.send(wordsOf(1).bundle(1.0));
  performer.send(wordsOf(2).bundle(1.1));
  performer.send(Bytes{'n', 'o', ' ', '!'});
  ASSERT_TRUE(publisher->publish("POSE", patterned(10, 1)));
  std::vector<WireMessage> messages;
  ASSERT_TRUE(receiveCount(*vmc, messages, 4));  // a skeleton, two poses, and what LCM brought
  EXPECT_EQ(posesIn(messages).size(), 2u);
  ASSERT_TRUE(receiveUntil(*vmc, messages, [&] {
    return vmc->counts().faults[static_cast<std::size_t>(DatagramFault::Osc)] == 1;
  }));
  const UdpmSender nobody;
  for (const WireMessage& message : messages) EXPECT_NE(message.sender, nobody);
}

TEST_F(VmcWire, HearsThisMachineAloneUnlessANetworkIsNamed) {
  // 127.0.0.1 alone is bound: what goes to another of this machine's addresses does not arrive.
  ASSERT_EQ(std::system("ip address add 10.9.8.7/24 dev lo"), 0);
  const Performer performer;
  {
    const auto vmc = receiver();
    performer.send(wordsOf(1).bundle(1.0), "10.9.8.7");
    std::vector<WireMessage> messages;
    ASSERT_TRUE(vmc->receive(messages, 50).ok());
    EXPECT_EQ(vmc->counts().datagrams, 0u);
  }
  VmcOptions options;
  options.senders = {valueOf(parseNetwork("10.1.0.0/16"))};
  const auto vmc = receiver(nullptr, options);
  performer.send(wordsOf(1).bundle(1.0), "10.9.8.7");
  std::vector<WireMessage> messages;
  ASSERT_TRUE(receiveUntil(*vmc, messages, [&] { return vmc->counts().datagrams == 1; }));
  EXPECT_EQ(vmc->counts().foreign, 0u);
}

TEST_F(VmcWire, ACrowdOfSendersTakesNobodysPlace) {
  const auto vmc = receiver();
  std::vector<WireMessage> messages;
  std::vector<Performer> crowd(kMaxVmcSenders + 3);
  for (int k = 0; k < 3; ++k) {
    for (const Performer& one : crowd) one.send(wordsOf(1).bundle(1.0 + 0.1 * k));
  }
  ASSERT_TRUE(receiveUntil(*vmc, messages, [&] {
    return posesIn(messages).size() == 3 * kMaxVmcSenders && vmc->counts().foreign == 9;
  }));
}

TEST_F(VmcWire, APortThatIsTakenIsNamed) {
  const auto vmc = receiver();
  std::vector<VmcPort> ports;
  ports.push_back({kPort, valueOf(VmcBody::make(1, humanoid(), VmcBones::Original))});
  const auto second = openVmcReceiver(nullptr, std::move(ports), {});
  ASSERT_FALSE(second.ok());
  EXPECT_EQ(second.error().file, "UDP port 39539");
}

TEST_F(VmcWire, AServiceAnswersEveryFrameAndCallsNoStepFree) {
  const Lss bone{{0, 0, 0}, {0, 0.1, 0}, 0.05};
  const Skeleton skeleton = humanoid();
  const Avatar avatar =
      Avatar::build(skeleton, std::vector<std::vector<Lss>>(
                                  static_cast<std::size_t>(skeleton.numJoints()), {bone}))
          .value();
  std::vector<StreamSolver> solvers;
  solvers.push_back(StreamSolver::make(1, avatar, farWall(), {}, {}).value());
  ASSERT_TRUE(solvers.back().makeSolid({}).ok());
  auto outbox = std::make_shared<Outbox>();
  ServiceParts around;
  around.receiver = receiver();
  around.publisher = std::make_unique<FakePublisher>(outbox);
  auto service = Service::start(std::move(solvers), std::move(around), {});
  ASSERT_TRUE(service.ok());
  // A body at rest goes from one side of the wall at x = 1 to the other and back.
  constexpr int kFrames = 30;
  VmcWords words;
  for (const Part& part : parts()) {
    const Eigen::Vector3d place = part.bone == "hips" ? part.place : Eigen::Vector3d::Zero();
    words.bones.emplace_back(unityName(part.bone), RigidPose{Quaternion(1, 0, 0, 0), place});
  }
  const Performer performer;
  for (int k = 0; k <= kFrames; ++k) {
    words.root.translation = {1.0 + 0.8 * std::cos(0.3 * k), 0.0, 0.0};
    performer.send(words.bundle(10.0 + 0.01 * k));
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  ASSERT_TRUE(eventually([&] { return service.value().counts().answered == kFrames + 1; }));
  service.value().stop();
  int across = 0, touching = 0;
  for (const Bytes& payload : outbox->on(kContactsChannel)) {
    ContactsMessage answer;
    ASSERT_EQ(decode(payload, answer), Reject::None);
    EXPECT_EQ(answer.lost, 0);
    if (answer.kind == StepKind::First) continue;
    EXPECT_EQ(answer.kind, StepKind::AcrossGap);
    ++across;
    bool isTouching = false;
    for (const Verdict verdict : answer.verdicts) {
      EXPECT_NE(verdict, Verdict::Clear);
      isTouching = isTouching || verdict == Verdict::Contact;
    }
    touching += isTouching ? 1 : 0;
  }
  EXPECT_EQ(across, kFrames);
  EXPECT_GT(touching, 3);
  EXPECT_EQ(outbox->on(kSolidChannel).size(), std::size_t{kFrames} + 1);
}

}  // namespace
}  // namespace foretouch::test
