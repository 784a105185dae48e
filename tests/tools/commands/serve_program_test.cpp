// tests/tools/commands/serve_program_test.cpp: `foretouch serve`, in networks of its own.
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <functional>
#include <linux/capability.h>
#include <map>
#include <sched.h>
#include <string>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/un.h>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>

#include "articulated/skeleton.h"
#include "assets/avatar/avatar_file.h"
#include "bench/private_network.h"
#include "network/log/event_log.h"
#include "network/service/service.h"
#include "network/wire/codec.h"
#include "network/wire/wire.h"
#include "tests/support/holds.h"
#include "tests/tools/program_run.h"
#include "tests/tools/small_world.h"
#include "tools/stream/serve_config.h"

namespace foretouch::test {
namespace {

using std::chrono::milliseconds;

template <typename Condition>
bool eventually(const Condition& isMet) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!isMet()) {
    if (std::chrono::steady_clock::now() > until) return false;
    std::this_thread::sleep_for(milliseconds(5));
  }
  return true;
}

std::vector<std::string> served(const SmallWorld& world,
                                const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"serve", "--scene", world.folder / "wall.obj", "--avatar",
                                     "3=" + world.folder / "man.json"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

enum class Network { Multicast, WithoutRoute };

/// Runs `trial` in a thread with a network of its own, which programs that it starts share; false
/// where the system gives none.
bool inNetwork(Network network, const std::function<void()>& trial) {
  bool isGiven = false;
  std::thread([&] {
    isGiven = network == Network::Multicast ? tools::enterPrivateNetwork().ok()
                                            : ::unshare(CLONE_NEWNET) == 0;
    if (isGiven) trial();
  }).join();
  return isGiven;
}

#define FORETOUCH_IN_NETWORK(network, ...)                 \
  if (!inNetwork(network, __VA_ARGS__))                    \
  GTEST_SKIP() << "the system gives no network namespace " \
                  "here"

/// A service that runs.
class Serving {
 public:
  explicit Serving(const SmallWorld& world, const std::vector<std::string>& more = {},
                   const std::vector<std::string>& environment = {})
      : out_(world.folder / ("out of run " + std::to_string(nextRun()))),
        run_(served(world, more), environment, out_) {
    EXPECT_TRUE(eventually([&] { return holds(out(), "\nready\n"); })) << out();
  }
  [[nodiscard]] std::string out() const { return contentOf(out_); }
  [[nodiscard]] pid_t id() const { return run_.id(); }
  void send(int signal) const { run_.send(signal); }
  Ended ended() { return run_.ended(); }

 private:
  static int nextRun() {
    static std::atomic<int> runs{0};
    return ++runs;
  }
  std::string out_;
  ProgramRun run_;
};

/// A sender of the small avatar, and a listener for its answers.
class Sender {
 public:
  Sender() {
    skeleton_.avatar = 3;
    skeleton_.session = 1;
    const Skeleton& skeleton = avatar_.skeleton();
    for (JointId j = 0; j < skeleton.numJoints(); ++j) {
      skeleton_.skeleton.joints.push_back(
          {skeleton.name(j), skeleton.parent(j), skeleton.restOffset(j), skeleton.restRotation(j)});
    }
    skeleton_.hash = skeletonHash(skeleton_.skeleton);
  }

  void sendSkeleton() { publish(kSkeletonChannel, skeleton_); }
  void sendPose(std::int64_t sequence, double x) {
    PoseMessage pose;
    pose.avatar = 3;
    pose.session = 1;
    pose.sequence = sequence;
    pose.utimeUs = sequence * 10'000;
    pose.skeletonHash = skeleton_.hash;
    for (std::int32_t j = 0; j < 2; ++j) {
      pose.joints.push_back({j, kJointValid | kJointTracked, Quaternion::Identity()});
    }
    pose.translations.push_back({0, {x, 0.0, 0.0}});
    publish(kPoseChannel, pose);
  }
  /// The answer to the last pose; one with sequenceTo -1 where none comes.
  ContactsMessage answer() {
    ContactsMessage message;
    message.sequenceTo = -1;
    const bool came = eventually([&] {
      std::vector<WireMessage> messages;
      EXPECT_TRUE(receiver_->receive(messages, 10).ok());
      for (const WireMessage& received : messages) {
        if (decode(received.payload, message) == Reject::None) return true;
      }
      return false;
    });
    EXPECT_TRUE(came);
    return message;
  }

 private:
  template <typename Message>
  void publish(const char* channel, const Message& message) {
    Bytes payload;
    encode(message, payload);
    EXPECT_TRUE(publisher_->publish(channel, payload));
  }

  Avatar avatar_ = parseAvatar(kManAvatar, "man.json").value();
  SkeletonMessage skeleton_;
  UdpmUrl url_ = parseUdpmUrl(kDefaultUrl).value();
  std::unique_ptr<Publisher> publisher_ = openUdpmPublisher(url_).value();
  std::unique_ptr<Receiver> receiver_ = openUdpmReceiver(url_, {kContactsChannel}).value();
};

TEST(ServeProgram, RefusesBadOptionsByName) {
  const SmallWorld world;
  const std::vector<std::pair<std::vector<std::string>, std::string>> trials = {
      {{"--workers", "0"}, "--workers: expected a whole number from 1 to 256"},
      {{"--queue", "many"}, "--queue: expected"},
      {{"--budget-us", "-3"}, "--budget-us: expected"},
      {{"--http", "9464"}, "--http: expected a host and a port"},
      {{"--view", "9465"}, "--view: expected a host and a port"},
      {{"--view=0.0.0.0:9465"}, "--view: expected localhost or an address of this machine"},
      {{"--avatar", "3=" + world.folder / "man.json"}, "--avatar: avatar 3 is used twice"},
      {{"--suffix", "a b"}, "--suffix: expected printable ASCII"},
      {{"--suffix", std::string(64, 'x')}, "--suffix: expected"},
      {{"--fidelity", "skinned"}, "--fidelity: expected link or exact"},
      {{"--receiver", "theirs"}, "--receiver: expected own or liblcm"},
      {{"--max-step", "1e9"}, "--max-step: expected"},
      {{"--tolerance", "0"}, "--tolerance: expected"},
      {{"--confirmations", "0"}, "--confirmations: expected"},
      {{"--ignore", "Nose"}, "--ignore"},
      {{"--url", "tcpq://127.0.0.1:7700"}, "tcpq://127.0.0.1:7700: expected udpm://"},
      {{"--self"}, "--self: is not possible yet: messages have no field for contacts of own links"},
      {{"--scope", "objects"}, "--scope: is not possible: of a stream every link is answered"},
      {{"--pass-separating"},
       "--pass-separating: is not possible: a stream goes from pose to pose"},
      {{"--senders", "10.0.0.7/24"}, "--senders: expected a network whose bits after the first 24"},
      {{"--senders", "::1"}, "--senders: expected an IPv4 network as 10.0.0.0/24"},
      {{"--senders", "10.0.0.0/24", "--receiver", "liblcm"}, "--senders: liblcm does not say who"},
      {{"--takeover", "-1"}, "--takeover: expected"},
      {{"--key", world.folder / "none.key"}, "none.key"},
      {{"--log-files", "0"}, "--log-files: expected"},
      {{"--vmc", "0"}, "--vmc: expected a UDP port of 1 to 65535, found '0'"},
      {{"--vmc", "VMC"}, "--vmc: expected a UDP port of 1 to 65535, found 'VMC'"},
      {{"--vmc", "9=39539"}, "--vmc: expected an avatar that is served, found 9"},
      {{"--vmc", "3=39539"}, "--vmc: avatar 3: is no humanoid"},
      {{"--vmc", "3=39539", "--key", world.folder / "none.key"}, "--vmc: VMC has no signatures"},
      {{"--vmc-bones", "theirs"}, "--vmc-bones: expected original or normalized"},
      {{"--config", world.folder / "none.toml"}, "none.toml"},
  };
  for (const auto& [options, expected] : trials) {
    const Ended ended = runForetouch(served(world, options));
    EXPECT_EQ(ended.exitCode, 2) << options[0];
    EXPECT_TRUE(holds(ended.err, expected)) << ended.err;
    EXPECT_EQ(ended.out, "");
  }
  EXPECT_TRUE(holds(runForetouch({"serve"}).err, "--scene: expected a scene"));
  EXPECT_TRUE(
      holds(runForetouch({"serve", "--scene", "x.obj"}).err, "--avatar: expected at least"));
}

TEST(ServeProgram, RefusesABadConfigurationByItsLine) {
  const SmallWorld world;
  const std::string path =
      world.folder.write("service.toml", "[service]\nworkers = 1\nworkres = 2\n");
  const Ended ended = runForetouch({"serve", "--config", path});
  EXPECT_EQ(ended.exitCode, 2);
  EXPECT_TRUE(holds(ended.err, "service.toml:3")) << ended.err;
  EXPECT_TRUE(holds(ended.err, "workres")) << ended.err;
}

TEST(ServeProgram, SaysWhatToTypeWhereThereIsNoRoute) {
  const SmallWorld world;
  FORETOUCH_IN_NETWORK(Network::WithoutRoute, [&] {
    const Ended ended = runForetouch(served(world));
    EXPECT_EQ(ended.exitCode, 2);
    EXPECT_TRUE(holds(ended.err, "ip route add 224.0.0.0/4 dev lo")) << ended.err;
    EXPECT_FALSE(holds(ended.out, "ready"));
  });
}

TEST(ServeProgram, AnswersPosesAndEndsInOrder) {
  const SmallWorld world;
  FORETOUCH_IN_NETWORK(Network::Multicast, [&] {
    for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
      const std::string log = world.folder / ("log" + std::to_string(signal));
      Serving serving(world, {"--log", log});
      Sender sender;
      sender.sendSkeleton();
      sender.sendPose(1, -0.5);
      EXPECT_EQ(sender.answer().kind, StepKind::First);
      sender.sendPose(2, 0.5);  // through the wall at x = 0
      const ContactsMessage answer = sender.answer();
      EXPECT_EQ(answer.sequenceTo, 2);
      EXPECT_EQ(answer.avatar, 3);
      EXPECT_EQ(answer.verdicts, (std::vector<Verdict>{Verdict::Contact, Verdict::Contact}));
      ASSERT_EQ(answer.contacts.size(), 2u);
      EXPECT_EQ(answer.contacts[0].objectName, "wall");
      EXPECT_NEAR(answer.contacts[0].contact.toi, 0.4, 2e-3);
      EXPECT_GE(answer.sendUtimeUs, answer.receiveUtimeUs);
      serving.send(signal);
      EXPECT_EQ(serving.ended().exitCode, 0) << signal;
      EXPECT_TRUE(holds(serving.out(), "2 poses: 2 answered, 0 refused, 0 lost")) << serving.out();

      std::map<std::string, int> events;
      auto reader = EventLogReader::open(log);
      ASSERT_TRUE(reader.ok());
      for (LogEvent event; reader.value().next(event).value();) ++events[event.channel];
      EXPECT_EQ(events[kSkeletonChannel], 1);
      EXPECT_EQ(events[kPoseChannel], 2);
      EXPECT_EQ(events[kContactsChannel], 2);
      EXPECT_GE(events[kStatusChannel], 1);
    }
  });
}

TEST(ServeProgram, ReadsItsConfigurationAndLetsOptionsReplaceIt) {
  const SmallWorld world;
  const std::string path = world.folder.write("service.toml",
                                              "[service]\nworkers = 2\nsuffix = \"_LAB\"\n"
                                              "[scene]\nfile = \"wall.obj\"\n"
                                              "[[avatar]]\nid = 3\nfile = \"man.json\"\n");
  FORETOUCH_IN_NETWORK(Network::Multicast, [&] {
    const std::string out = world.folder / "out";
    ProgramRun run({"serve", "--config", path, "--suffix", "_HALL", "--budget-us", "100"}, {}, out);
    EXPECT_TRUE(eventually([&] { return holds(contentOf(out), "\nready\n"); }));
    EXPECT_TRUE(holds(contentOf(out), "2 workers"));
    EXPECT_TRUE(holds(contentOf(out), "suffix _HALL"));
    run.send(SIGTERM);
    EXPECT_EQ(run.ended().exitCode, 0);
  });
}

TEST(ServeProgram, OverwritesNoLogAndGivesAFolderOneForEveryRun) {
  const SmallWorld world;
  const std::string taken = world.folder.write("taken.lcmlog", "something else");
  const std::string folder = world.folder / "logs";
  std::filesystem::create_directory(folder);
  FORETOUCH_IN_NETWORK(Network::Multicast, [&] {
    const Ended refused = runForetouch(served(world, {"--log", taken}));
    EXPECT_EQ(refused.exitCode, 2);
    EXPECT_TRUE(holds(refused.err, "taken.lcmlog")) << refused.err;
    EXPECT_EQ(contentOf(taken), "something else");
    for (int i = 0; i < 2; ++i) {
      Serving serving(world, {"--log", folder});
      serving.send(SIGTERM);
      EXPECT_EQ(serving.ended().exitCode, 0);
    }
    int logs = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      logs += entry.path().extension() == ".lcmlog";
    }
    EXPECT_EQ(logs, 2);
  });
}

/// Of this thread, and of all that it starts: they are as other users' programs are.
bool giveUpTracing() {
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  __user_cap_data_struct sets[2];
  if (::prctl(PR_CAPBSET_DROP, CAP_SYS_PTRACE, 0, 0, 0) != 0) return false;
  if (::syscall(SYS_capget, &header, sets) != 0) return false;
  sets[0].effective = sets[0].permitted = sets[0].permitted & ~(1u << CAP_SYS_PTRACE);
  return ::syscall(SYS_capset, &header, sets) == 0;
}

/// Whether the kernel lets this thread look into the process.
bool maySee(pid_t process) {
  std::error_code refused;
  return !std::filesystem::read_symlink("/proc/" + std::to_string(process) + "/exe", refused)
              .empty();
}

TEST(ServeProgram, KeepsItsMemoryFromProgramsOfTheSameUser) {
  const SmallWorld world;
  bool isGivenUp = false;
  FORETOUCH_IN_NETWORK(Network::Multicast, [&] {
    isGivenUp = giveUpTracing();
    if (!isGivenUp) return;
    ProgramRun other({"listen", "--timeout", "600"});
    EXPECT_TRUE(eventually([&] { return maySee(other.id()); }));
    Serving serving(world);
    EXPECT_FALSE(maySee(serving.id()));
    other.send(SIGTERM);
    serving.send(SIGTERM);
    EXPECT_EQ(serving.ended().exitCode, 0);
  });
  if (!isGivenUp) GTEST_SKIP() << "the system lets nobody give up a capability here";
}

/// What a service manager hears.
class NotifySocket {
 public:
  explicit NotifySocket(const std::string& path) : socket_(::socket(AF_UNIX, SOCK_DGRAM, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
    const timeval patience{60, 0};  // only a test that fails waits for so long
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    EXPECT_EQ(::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  ~NotifySocket() { ::close(socket_); }
  std::string next() {
    char text[4096];
    const ssize_t got = ::recv(socket_, text, sizeof text, 0);
    return got > 0 ? std::string(text, static_cast<std::size_t>(got)) : "";
  }

 private:
  int socket_;
};

TEST(ServeProgram, TellsItsManagerHowItIs) {
  const SmallWorld world;
  FORETOUCH_IN_NETWORK(Network::Multicast, [&] {
    NotifySocket manager(world.folder / "notify");
    Serving serving(world, {},
                    {"NOTIFY_SOCKET=" + world.folder / "notify", "WATCHDOG_USEC=200000"});
    EXPECT_EQ(manager.next().rfind("READY=1\nSTATUS=serving ", 0), 0u);
    EXPECT_EQ(manager.next(), "WATCHDOG=1");
    EXPECT_EQ(manager.next(), "WATCHDOG=1");
    serving.send(SIGTERM);
    std::string last;
    do {
      last = manager.next();
    } while (last == "WATCHDOG=1");
    EXPECT_EQ(last, "STOPPING=1");
    EXPECT_EQ(serving.ended().exitCode, 0);
  });
}

TEST(ServeProgram, EndsAtOnceByASecondSignalAndNeverHangs) {
  const SmallWorld world;
  FORETOUCH_IN_NETWORK(Network::Multicast, [&] {
    Serving serving(world);
    for (int i = 0; i < 20; ++i) serving.send(SIGTERM);
    const Ended ended = serving.ended();
    EXPECT_TRUE(ended.exitCode == 0 || ended.signal == SIGTERM);
  });
}

std::string readFile(const std::string& name) {
  return contentOf(std::string(FORETOUCH_SOURCE_DIR) + "/examples/systemd/" + name);
}

TEST(ServeProgram, ShipsAConfigurationThatIsLegal) {
  const auto config = tools::parseServeConfig(readFile("service.toml"), "service.toml");
  ASSERT_TRUE(config.ok()) << describe(config.error());
  EXPECT_EQ(config.value().service.workers, 2);
}

TEST(ServeProgram, ShipsAUnitThatSystemdAccepts) {
  if (std::system("command -v systemd-analyze >/dev/null") != 0) {
    GTEST_SKIP() << "systemd-analyze is missing";
  }
  std::string unit = readFile("foretouch.service.in");
  const std::string program = "@CMAKE_INSTALL_FULL_BINDIR@/foretouch";
  unit.replace(unit.find(program), program.size(), FORETOUCH_PROGRAM);
  const std::string data = "@CMAKE_INSTALL_FULL_DATADIR@";
  for (auto at = unit.find(data); at != std::string::npos; at = unit.find(data)) {
    unit.replace(at, data.size(), "/usr/share");
  }
  const TempFolder folder;
  const std::string path = folder.write("foretouch.service", unit);
  const std::string said = folder / "said";
  EXPECT_EQ(
      std::system(("systemd-analyze verify --man=no " + path + " >" + said + " 2>&1").c_str()), 0);
  EXPECT_FALSE(holds(contentOf(said), "foretouch.service")) << contentOf(said);
}

}  // namespace
}  // namespace foretouch::test
