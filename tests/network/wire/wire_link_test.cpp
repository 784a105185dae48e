// Routes that are missing, links that go down and come back, interfaces that are replaced.
#include <atomic>
#include <cstdlib>
#include <future>
#include <mutex>
#include <sched.h>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "tests/network/private_network.h"

namespace foretouch {
namespace {

using namespace std::chrono_literals;

class WireLink : public test::PrivateNetwork {};

bool type(const std::string& command) {
  return std::system(command.c_str()) == 0;
}

TEST_F(WireLink, SelfTestPassesWhereMulticastWorks) {
  const auto tested = testMulticast({});
  EXPECT_TRUE(tested.ok()) << describe(tested.error());
}

TEST_F(WireLink, SelfTestDoesNotNeedThePort) {
  const auto receiver = test::receiverOf({"POSE"});
  EXPECT_TRUE(testMulticast({}).ok());
  std::vector<WireMessage> messages;
  ASSERT_TRUE(receiver->receive(messages, 20).ok());
  EXPECT_EQ(receiver->counts().datagrams, 0u);
}

TEST_F(WireLink, WithoutARouteErrorsSayWhatToType) {
  const auto publisher = test::publisherTo();
  ASSERT_TRUE(type("ip route del 224.0.0.0/4 dev lo"));
  const auto advice = [](const Error& error) { return describe(error); };
  for (const std::string& text :
       {advice(testMulticast({}).error()), advice(openUdpmReceiver({}, {"POSE"}).error()),
        advice(openLcmReceiver(kDefaultUrl, {"POSE"}).error())}) {
    EXPECT_NE(text.find("udpm://239.255.76.67:7667?ttl=0"), std::string::npos) << text;
    EXPECT_NE(text.find("ip route add 224.0.0.0/4 dev lo"), std::string::npos) << text;
    EXPECT_NE(text.find("ip link set lo multicast on"), std::string::npos) << text;
  }
  EXPECT_FALSE(publisher->publish("POSE", Bytes{1}));
  // What is advised helps, and the publisher need not be opened again.
  ASSERT_TRUE(
      type("ip link set lo up && ip link set lo multicast on && "
           "ip route add 224.0.0.0/4 dev lo"));
  EXPECT_TRUE(testMulticast({}).ok());
  const auto receiver = test::receiverOf({"POSE"});
  std::vector<WireMessage> messages;
  EXPECT_TRUE(publisher->publish("POSE", Bytes{1}));
  EXPECT_TRUE(test::receiveCount(*receiver, messages, 1));
}

/// A thread in another network namespace, as another machine at the other end of a cable, which
/// publishes at 200 Hz whenever it can.
class OtherMachine {
 public:
  OtherMachine() : thread_([this] { run(); }) { isReady_.get_future().wait(); }
  ~OtherMachine() {
    isOver_ = true;
    thread_.join();
  }
  /// Plugs a new cable in: `here` in this namespace, `there` in the other one, which then has
  /// `address`, or none if that is empty.
  bool plug(const std::string& address = "10.77.0.1/24") {
    const std::string there = std::to_string(threadId_);
    const std::string named = address.empty() ? "true" : "ip addr add " + address + " dev there";
    return isIsolated_ && type("ip link add here type veth peer name there netns " + there) &&
           type("ip addr add 10.77.0.2/24 dev here && " + std::string(kUpHere)) &&
           run(named + " && " + kSetUpThere);
  }
  bool upAgain() { return type(kUpHere); }

 private:
  static constexpr char kUpHere[] =
      "ip link set here up && ip link set here multicast on && "
      "ip route replace 239.255.76.67/32 dev here";
  static constexpr char kSetUpThere[] =
      "ip link set there up && "
      "ip link set there multicast on && ip route replace 224.0.0.0/4 dev there";

  /// In the other namespace.
  bool run(const std::string& command) {
    std::promise<bool> done;
    {
      const std::lock_guard lock(mutex_);
      command_ = command;
      done_ = &done;
    }
    return done.get_future().get();
  }
  void run() {
    threadId_ = gettid();
    isIsolated_ = unshare(CLONE_NEWNET) == 0;
    UdpmUrl url;
    url.ttl = 1;
    const auto publisher = test::publisherTo(url);
    isReady_.set_value();
    while (!isOver_) {
      {
        const std::lock_guard lock(mutex_);
        if (done_ != nullptr) std::exchange(done_, nullptr)->set_value(type(command_));
      }
      publisher->publish("POSE", Bytes{1});
      publisher->publish("SKELETON", Bytes(100'000));
      std::this_thread::sleep_for(5ms);
    }
  }

  std::promise<void> isReady_;
  std::atomic<bool> isOver_{false}, isIsolated_{false};
  pid_t threadId_ = 0;
  std::mutex mutex_;
  std::string command_;
  std::promise<bool>* done_ = nullptr;
  std::thread thread_;
};

TEST_F(WireLink, AReceiverOutlivesItsLinkAndItsInterface) {
  OtherMachine other;
  if (!other.plug()) GTEST_SKIP() << "no veth links here";
  UdpmUrl url;
  url.ttl = 1;
  const auto receiver = test::receiverOf({"POSE", "SKELETON"}, url);
  const auto comes = [&](const char* when) {
    std::vector<WireMessage> messages;
    EXPECT_TRUE(test::receiveCount(*receiver, messages, 20)) << when;
  };
  const auto nothingComes = [&](const char* when) {
    std::vector<WireMessage> messages;
    for (int i = 0; i < 3; ++i) {
      messages.clear();
      ASSERT_TRUE(receiver->receive(messages, 100).ok()) << when;
    }
    EXPECT_TRUE(messages.empty()) << when;
  };
  comes("at first");
  ASSERT_TRUE(type("ip link set here down"));
  nothingComes("with the link down");
  ASSERT_TRUE(other.upAgain());
  comes("with the link up again");
  for (int round = 0; round < 2; ++round) {
    ASSERT_TRUE(type("ip link del here"));
    nothingComes("without the interface");
    ASSERT_TRUE(other.plug());
    comes("with another interface");
  }
  type("ip link del here");
}

/// What came, by who is heard.
struct Came {
  std::size_t messages = 0;
  std::uint64_t foreign = 0;
};

/// Waits until enough came or was refused.
Came cameTo(Receiver& receiver) {
  constexpr std::uint64_t kEnough = 20;
  std::vector<WireMessage> messages;
  const auto deadline = test::Clock::now() + test::kPatience;
  while (messages.size() + receiver.counts().foreign < kEnough && test::Clock::now() < deadline) {
    EXPECT_TRUE(receiver.receive(messages, 20).ok());
  }
  return {messages.size(), receiver.counts().foreign};
}

// The default address is this machine's own affair, whatever its route for multicast is.
TEST_F(WireLink, AtTtl0NobodyElseIsHeard) {
  for (const std::string address : {"10.77.0.1/24", "10.77.0.2/24", ""}) {
    SCOPED_TRACE(address);
    OtherMachine other;
    if (!other.plug(address)) GTEST_SKIP() << "no veth links here";
    const auto receiver = test::receiverOf({"POSE"});
    const auto own = test::publisherTo();
    ASSERT_TRUE(own->publish("POSE", Bytes{2}));
    std::vector<WireMessage> messages;
    ASSERT_TRUE(test::receiveCount(*receiver, messages, 1));
    EXPECT_EQ(messages.size(), 1U);
    EXPECT_EQ(messages[0].payload, Bytes{2});
    messages.clear();
    for (int i = 0; i < 20; ++i) ASSERT_TRUE(receiver->receive(messages, 20).ok());
    EXPECT_TRUE(messages.empty());
    // Under our own address or none, the system itself refuses it.
    if (address == "10.77.0.1/24") {
      EXPECT_GE(receiver->counts().foreign, 20U);
      EXPECT_EQ(receiver->counts().datagrams, receiver->counts().foreign + 1);
    }
    type("ip link del here");
  }
}

TEST_F(WireLink, HearsTheNetworksThatAreNamed) {
  OtherMachine other;
  if (!other.plug()) GTEST_SKIP() << "no veth links here";
  UdpmUrl away;
  away.ttl = 1;
  const auto heard = [&](const UdpmUrl& url, const std::string& network) {
    const auto receiver =
        test::valueOf(openUdpmReceiver(url, {"POSE"}, {test::valueOf(parseNetwork(network))}));
    return cameTo(*receiver);
  };
  for (const UdpmUrl& url : {UdpmUrl(), away}) {
    for (const std::string network : {"10.77.0.0/24", "10.77.0.1", "0.0.0.0/0"}) {
      SCOPED_TRACE(network);
      const Came came = heard(url, network);
      EXPECT_GE(came.messages, 20U);
      EXPECT_EQ(came.foreign, 0U);
    }
    for (const std::string network : {"10.77.1.0/24", "10.77.0.0/32", "10.77.0.2"}) {
      SCOPED_TRACE(network);
      const Came came = heard(url, network);
      EXPECT_EQ(came.messages, 0U);
      EXPECT_GE(came.foreign, 20U);
    }
  }
  type("ip link del here");
}

}  // namespace
}  // namespace foretouch
