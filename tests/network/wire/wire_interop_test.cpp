// Ours with liblcm and its tools: either may publish, either may receive.
#include <filesystem>
#include <lcm/lcm.h>
#include <memory>
#include <signal.h>
#include <spawn.h>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "network/wire/messages.h"
#include "tests/network/private_network.h"
#include "tests/support/temp_folder.h"

namespace foretouch {
namespace {

using namespace std::chrono_literals;
using test::patterned;

// Short ones, the sizes about which short becomes fragmented ("POSE" and its NUL count), large
// ones.
const std::vector<std::size_t> kSizes = {0,      1,       842,     65'493,  65'494,    65'495,
                                         65'496, 100'000, 130'969, 130'970, 1'000'000, 4'194'304};

class WireInterop : public test::PrivateNetwork {
 protected:
  UdpmUrl url_;
  const std::string lcmUrl_ = "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4194304";
};

struct Lcm {
  explicit Lcm(const std::string& url) : lcm(lcm_create(url.c_str()), lcm_destroy) {}
  void publish(const std::string& channel, const Bytes& payload) const {
    ASSERT_EQ(lcm_publish(lcm.get(), channel.c_str(), payload.data(),
                          static_cast<unsigned>(payload.size())),
              0);
  }
  std::unique_ptr<lcm_t, void (*)(lcm_t*)> lcm;
};

void expectMessage(const std::vector<WireMessage>& messages, std::size_t size) {
  ASSERT_EQ(messages.size(), 1u) << size;
  EXPECT_EQ(messages[0].channel, "POSE");
  EXPECT_TRUE(messages[0].payload == patterned(size, 3)) << size;
}

TEST_F(WireInterop, OursToOurs) {
  const auto receiver = test::receiverOf({"POSE"});
  const auto publisher = test::publisherTo();
  for (const std::size_t size : kSizes) {
    std::vector<WireMessage> messages;
    const auto before = std::chrono::system_clock::now().time_since_epoch() / 1us;
    ASSERT_TRUE(publisher->publish("POSE", patterned(size, 3)));
    ASSERT_TRUE(test::receiveCount(*receiver, messages, 1)) << size;
    const auto after = std::chrono::system_clock::now().time_since_epoch() / 1us;
    expectMessage(messages, size);
    EXPECT_GE(messages[0].receiveUtimeUs, before - 1);
    EXPECT_LE(messages[0].receiveUtimeUs, after);
  }
  EXPECT_EQ(receiver->counts().messages, kSizes.size());
  EXPECT_EQ(receiver->counts().kernelDrops, 0u);
}

TEST_F(WireInterop, OursToLiblcm) {
  const auto receiver = test::valueOf(openLcmReceiver(lcmUrl_, {"POSE"}));
  const auto publisher = test::publisherTo();
  for (const std::size_t size : kSizes) {
    std::vector<WireMessage> messages;
    ASSERT_TRUE(publisher->publish("POSE", patterned(size, 3)));
    ASSERT_TRUE(test::receiveCount(*receiver, messages, 1)) << size;
    expectMessage(messages, size);
  }
}

TEST_F(WireInterop, LiblcmToOurs) {
  const auto receiver = test::receiverOf({"POSE"});
  const Lcm lcm(lcmUrl_);
  for (const std::size_t size : kSizes) {
    std::vector<WireMessage> messages;
    lcm.publish("POSE", patterned(size, 3));
    ASSERT_TRUE(test::receiveCount(*receiver, messages, 1)) << size;
    expectMessage(messages, size);
  }
  const WireCounts counts = receiver->counts();
  for (std::size_t fault = 0; fault < kNumDatagramFaults; ++fault) {
    EXPECT_EQ(counts.faults[fault], 0u) << toString(static_cast<DatagramFault>(fault));
  }
}

// What we send is, byte for byte, what liblcm sends.
TEST_F(WireInterop, DatagramsAreLiblcms) {
  const internal::FileDescriptor socket = test::valueOf(openListeningSocket(url_));
  const Lcm lcm(lcmUrl_);
  std::uint32_t sequence = 0;
  for (const std::size_t size : kSizes) {
    const Bytes payload = patterned(size, 3);
    lcm.publish("POSE", payload);
    for (const Bytes& expected : datagramsOf("POSE", payload, sequence)) {
      Bytes datagram(70'000);
      ASSERT_TRUE(waitReadable(socket.get(), 5000)) << size;
      const ssize_t got = recv(socket.get(), datagram.data(), datagram.size(), 0);
      ASSERT_GE(got, 0);
      datagram.resize(static_cast<std::size_t>(got));
      ASSERT_TRUE(datagram == expected) << size;
    }
    ++sequence;
  }
}

TEST_F(WireInterop, LiblcmListensToExactlyTheChannelsAsked) {
  const auto receiver = test::valueOf(openLcmReceiver(lcmUrl_, {"A.B|C+", "POSE"}));
  const auto publisher = test::publisherTo();
  for (const char* channel : {"AxB|C+", "A.B", "C+", "CC", "POSE2", "XPOSE", "A.B|C+", "POSE"}) {
    ASSERT_TRUE(publisher->publish(channel, Bytes{1}));
  }
  std::vector<WireMessage> messages;
  ASSERT_TRUE(test::receiveCount(*receiver, messages, 2));
  ASSERT_TRUE(receiver->receive(messages, 100).ok());
  ASSERT_EQ(messages.size(), 2u);
  EXPECT_EQ(messages[0].channel, "A.B|C+");
  EXPECT_EQ(messages[1].channel, "POSE");
  EXPECT_EQ(receiver->counts().messages, 2u);
}

// liblcm aborts beyond descriptor 1024: it is refused there. Ours works, and so does a receiver of
// liblcm's that was opened before.
TEST_F(WireInterop, ManyDescriptorsAbortNothing) {
  const auto early = test::valueOf(openLcmReceiver(lcmUrl_, {"POSE"}));
  std::vector<internal::FileDescriptor> taken;
  for (int i = 0; i < 1100; ++i) taken.emplace_back(dup(0));
  if (taken.back().get() < 1024) GTEST_SKIP() << "this process may not open 1100 descriptors";
  const auto refused = openLcmReceiver(lcmUrl_, {"POSE"});
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("below descriptor 1024"), std::string::npos);
  const auto own = test::receiverOf({"POSE"});
  ASSERT_TRUE(test::publisherTo()->publish("POSE", patterned(842, 3)));
  for (Receiver* each : {early.get(), own.get()}) {
    std::vector<WireMessage> messages;
    ASSERT_TRUE(test::receiveCount(*each, messages, 1));
    expectMessage(messages, 842);
  }
}

/// A program of liblcm-bin, ended with the object.
class Tool {
 public:
  explicit Tool(std::vector<std::string> words) {
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    if (posix_spawnp(&pid_, arguments[0], nullptr, nullptr, arguments.data(), environ) != 0) {
      pid_ = -1;
    }
  }
  ~Tool() { end(); }
  [[nodiscard]] bool isRunning() const { return pid_ > 0; }
  void end() {
    if (pid_ <= 0) return;
    kill(pid_, SIGINT);
    waitpid(pid_, nullptr, 0);
    pid_ = -1;
  }

 private:
  pid_t pid_ = -1;
};

struct LoggedEvent {
  std::string channel;
  Bytes payload;
};

std::vector<LoggedEvent> eventsOf(const std::string& path) {
  std::vector<LoggedEvent> events;
  lcm_eventlog_t* log = lcm_eventlog_create(path.c_str(), "r");
  if (log == nullptr) return events;
  while (lcm_eventlog_event_t* event = lcm_eventlog_read_next_event(log)) {
    const auto* data = static_cast<const std::uint8_t*>(event->data);
    events.push_back({std::string(event->channel, static_cast<std::size_t>(event->channellen)),
                      Bytes(data, data + event->datalen)});
    lcm_eventlog_free_event(event);
  }
  lcm_eventlog_destroy(log);
  return events;
}

TEST_F(WireInterop, LcmLoggerRecordsUs) {
  const test::TempFolder folder;
  const std::string path = folder / "recorded.lcmlog";
  Tool logger({"lcm-logger", "--lcm-url=" + lcmUrl_, path});
  if (!logger.isRunning()) GTEST_SKIP() << "lcm-logger is not installed";
  const auto publisher = test::publisherTo();
  const auto waitFor = [&](const auto& isThere) {
    for (const auto deadline = test::Clock::now() + test::kPatience; !isThere();) {
      if (test::Clock::now() > deadline) return false;
      std::this_thread::sleep_for(50ms);
    }
    return true;
  };
  ASSERT_TRUE(waitFor([&] {
    publisher->publish("HELLO", Bytes{1});
    return !eventsOf(path).empty();
  }));
  const std::vector<std::size_t> sizes = {10, 842, 65'494, 65'495, 1'000'000};
  for (const std::size_t size : sizes) {
    ASSERT_TRUE(publisher->publish("POSE", patterned(size, 3)));
  }
  const auto recorded = [&] {
    std::vector<Bytes> payloads;
    for (LoggedEvent& event : eventsOf(path)) {
      if (event.channel == "POSE") payloads.push_back(std::move(event.payload));
    }
    return payloads;
  };
  ASSERT_TRUE(waitFor([&] {
    publisher->publish("HELLO", Bytes{1});  // lcm-logger flushes when the next one comes
    return recorded().size() >= sizes.size();
  }));
  logger.end();
  const auto payloads = recorded();
  ASSERT_EQ(payloads.size(), sizes.size());
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    EXPECT_TRUE(payloads[i] == patterned(sizes[i], 3)) << sizes[i];
  }
}

TEST_F(WireInterop, LcmLogplayerFeedsUs) {
  const test::TempFolder folder;
  const std::string path = folder / "written.lcmlog";
  const std::vector<std::size_t> sizes = {10, 842, 65'494, 65'495, 1'000'000};
  {
    lcm_eventlog_t* log = lcm_eventlog_create(path.c_str(), "w");
    ASSERT_NE(log, nullptr);
    std::string channel = "POSE";
    for (std::size_t i = 0; i < 200; ++i) {
      Bytes payload = patterned(sizes[i % sizes.size()], static_cast<std::uint32_t>(i));
      lcm_eventlog_event_t event{};
      event.timestamp = 1'000'000 + 5'000 * static_cast<std::int64_t>(i);
      event.channellen = static_cast<std::int32_t>(channel.size());
      event.datalen = static_cast<std::int32_t>(payload.size());
      event.channel = channel.data();
      event.data = payload.data();
      ASSERT_EQ(lcm_eventlog_write_event(log, &event), 0);
    }
    lcm_eventlog_destroy(log);
  }
  const auto receiver = test::receiverOf({"POSE"});
  Tool player({"lcm-logplayer", "--lcm-url=" + lcmUrl_, path});
  if (!player.isRunning()) GTEST_SKIP() << "lcm-logplayer is not installed";
  std::vector<WireMessage> messages;
  ASSERT_TRUE(test::receiveCount(*receiver, messages, 200));
  for (std::size_t i = 0; i < 200; ++i) {
    EXPECT_TRUE(messages[i].payload ==
                patterned(sizes[i % sizes.size()], static_cast<std::uint32_t>(i)))
        << i;
  }
}

}  // namespace
}  // namespace foretouch
