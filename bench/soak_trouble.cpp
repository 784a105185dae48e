#include "bench/soak_trouble.h"

#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <optional>
#include <spawn.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "bench/event_readers.h"
#include "bench/garbage.h"

namespace foretouch::tools {
namespace {

namespace fs = std::filesystem;

// In a private network, where they are free.
constexpr std::uint16_t kTroubleHttpPort = 9464, kTroubleViewPort = 9465;
constexpr int kTroubleViewers = 4;
constexpr double kFloodPerSecond = 20'000.0, kFloodSeconds = 5.0;
// In seconds: half a minute sees each of these, but for a full disk.
constexpr int kFloodEvery = 30, kRestartEvery = 20, kSilence = 3;
constexpr int kFillEvery = 300, kFullFor = 60;
constexpr std::size_t kFillerBytes = std::size_t{1} << 20;

/// Runs `foretouch publish`, and kills it at its own end.
class RestartedSender {
 public:
  explicit RestartedSender(const TroubleRequest& request) : request_(request) {}
  RestartedSender(const RestartedSender&) = delete;
  RestartedSender& operator=(const RestartedSender&) = delete;
  ~RestartedSender() { kill(); }
  [[nodiscard]] bool isThere() const { return child_ > 0; }

  void start() {
    std::error_code unknown;
    const std::string program =
        fs::read_symlink("/proc/self/exe", unknown).replace_filename("foretouch");
    std::vector<std::string> words = {program,
                                      "publish",
                                      request_.files.motionPath,
                                      "--avatar",
                                      request_.files.avatarPath,
                                      "--id",
                                      std::to_string(request_.avatar),
                                      "--loop",
                                      "-q"};
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    if (::posix_spawn(&child_, program.c_str(), &actions, nullptr, argv.data(), environ) != 0) {
      child_ = -1;
    }
    ::posix_spawn_file_actions_destroy(&actions);
  }
  void kill() {
    if (child_ <= 0) return;
    ::kill(child_, SIGKILL);
    ::waitpid(child_, nullptr, 0);
    child_ = -1;
  }

 private:
  const TroubleRequest& request_;
  pid_t child_ = -1;
};

/// Takes all room on a disk, some megabytes at a time.
class Filler {
 public:
  explicit Filler(const std::string& folder) : path_(folder + "/filler") {}
  Filler(const Filler&) = delete;
  Filler& operator=(const Filler&) = delete;
  ~Filler() { empty(); }
  void fill() const {
    std::ofstream file(path_, std::ios::binary | std::ios::app);
    const std::string bytes(kFillerBytes, '\0');
    for (int i = 0; i < 64 && file.write(bytes.data(), kFillerBytes).flush(); ++i) {
    }
  }
  void empty() const {
    std::error_code gone;
    fs::remove(path_, gone);
  }

 private:
  std::string path_;
};

}  // namespace

struct SoakTrouble::Impl {
  Impl(const TroubleRequest& given, EventReaders viewers)
      : request(given), readers(std::move(viewers)), sender(request), filler(given.logFolder) {}

  void second() {
    if (now % kFloodEvery == kFloodEvery / 3) flood();
    if (now % kRestartEvery == 0) restart();
    if (now % kRestartEvery == kSilence && !sender.isThere()) sender.start();
    if (request.fillsDisk) fillOrEmpty();
    ++now;
  }
  void flood() {
    endFlood();
    running.emplace(request.url, noiseDatagrams(static_cast<std::uint64_t>(now)), kFloodPerSecond,
                    kFloodSeconds);
    ++counts.floods;
  }
  void endFlood() {
    if (running) counts.floodDatagrams += running->wait();
    running.reset();
  }
  void restart() {
    counts.restarts += sender.isThere() ? 1 : 0;
    sender.kill();
  }
  void fillOrEmpty() {
    const int phase = now % kFillEvery;
    if (phase == 0) counts.timesFull += now > 0 ? 1 : 0;
    if (phase < kFullFor && now >= kFillEvery) filler.fill();
    if (phase == kFullFor) filler.empty();
  }

  const TroubleRequest request;
  EventReaders readers;
  RestartedSender sender;
  Filler filler;
  std::optional<Flood> running;
  TroubleCounts counts;
  int now = 0;
};

std::vector<std::string> SoakTrouble::arguments(const std::string& logFolder) {
  return {"--http",
          fmt::format("127.0.0.1:{}", kTroubleHttpPort),
          fmt::format("--view=127.0.0.1:{}", kTroubleViewPort),
          "--log",
          logFolder,
          "--log-bytes",
          "8000000",
          "--log-files",
          "4"};
}

SoakTrouble::SoakTrouble(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
SoakTrouble::SoakTrouble(SoakTrouble&&) noexcept = default;
SoakTrouble::~SoakTrouble() = default;

Result<SoakTrouble> SoakTrouble::start(const TroubleRequest& request) {
  FORETOUCH_TRY(auto readers, EventReaders::start(kTroubleViewers, kTroubleViewPort));
  return SoakTrouble(std::make_unique<Impl>(request, std::move(readers)));
}

void SoakTrouble::everySecond() {
  impl_->second();
}

TroubleCounts SoakTrouble::stop() {
  impl_->endFlood();
  impl_->sender.kill();
  impl_->filler.empty();
  impl_->counts.viewersLetGo = impl_->readers.stop();
  return impl_->counts;
}

}  // namespace foretouch::tools
