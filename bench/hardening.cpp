#include "bench/hardening.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <dlfcn.h>
#include <filesystem>
#include <foretouch/foretouch.h>
#include <memory>
#include <system_error>
#include <utility>
#include <vector>

#include "articulated/try.h"
#include "bench/service_process.h"
#include "bench/stream.h"
#include "bench/timing.h"
#include "lss/index.h"

namespace foretouch::tools {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double kSenderHz = 1000.0;
constexpr char kLibrary[] = "bindings/c/libforetouch.so";

/// Of this program: build/release/bin/foretouch-bench lies in build/release.
std::string ownFolder() {
  std::error_code unknown;
  return fs::read_symlink("/proc/self/exe", unknown).parent_path().parent_path().string();
}

Error failedIn(const std::string& path, const std::string& why) {
  return Error::in(path, ErrorCode::DeviceFailed, why);
}

/// The functions of one libforetouch.so among several.
struct Library {
  std::string path;
  std::unique_ptr<void, int (*)(void*)> handle{nullptr, ::dlclose};
  decltype(&ft_scene_arrays_init) sceneArraysInit = nullptr;
  decltype(&ft_scene_create) sceneCreate = nullptr;
  decltype(&ft_scene_destroy) sceneDestroy = nullptr;
  decltype(&ft_avatar_create_from_file) avatarCreate = nullptr;
  decltype(&ft_avatar_destroy) avatarDestroy = nullptr;
  decltype(&ft_query_create) queryCreate = nullptr;
  decltype(&ft_query_destroy) queryDestroy = nullptr;
  decltype(&ft_query_step) step = nullptr;
  decltype(&ft_query_links) links = nullptr;
  decltype(&ft_pose_init) poseInit = nullptr;
  decltype(&ft_check_abi) checkAbi = nullptr;
  decltype(&ft_last_error) lastError = nullptr;

  [[nodiscard]] Error failed() const { return failedIn(path, lastError()); }
};

template <typename Function>
bool find(const Library& library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(::dlsym(library.handle.get(), name));
  return function != nullptr;
}

Result<Library> load(const std::string& folder) {
  Library library;
  library.path = (fs::path(folder) / kLibrary).string();
  // Apart from the other one, which has the same names.
  library.handle.reset(::dlopen(library.path.c_str(), RTLD_NOW | RTLD_LOCAL));
  const char* const why = library.handle ? nullptr : ::dlerror();
  if (why != nullptr) return failedIn(library.path, why);
  const bool isWhole = find(library, "ft_scene_arrays_init", library.sceneArraysInit) &&
                       find(library, "ft_scene_create", library.sceneCreate) &&
                       find(library, "ft_scene_destroy", library.sceneDestroy) &&
                       find(library, "ft_avatar_create_from_file", library.avatarCreate) &&
                       find(library, "ft_avatar_destroy", library.avatarDestroy) &&
                       find(library, "ft_query_create", library.queryCreate) &&
                       find(library, "ft_query_destroy", library.queryDestroy) &&
                       find(library, "ft_query_step", library.step) &&
                       find(library, "ft_query_links", library.links) &&
                       find(library, "ft_pose_init", library.poseInit) &&
                       find(library, "ft_check_abi", library.checkAbi) &&
                       find(library, "ft_last_error", library.lastError);
  if (!isWhole) return failedIn(library.path, "lacks a function of foretouch.h");
  if (library.checkAbi(FT_ABI_VERSION) != FT_OK) return library.failed();
  return library;
}

/// Of a scene, as ft_scene_arrays takes them.
struct SceneNumbers {
  explicit SceneNumbers(const RawScene& raw) {
    for (const Triangle& triangle : raw.triangles) {
      for (const Eigen::Vector3d& corner : triangle.vertices) {
        indices.push_back(static_cast<std::uint32_t>(indices.size()));
        positions.insert(positions.end(), {corner.x(), corner.y(), corner.z()});
      }
    }
  }
  std::vector<double> positions;
  std::vector<std::uint32_t> indices;
};

/// One library's query, and its time for each step.
class LibraryQuery {
 public:
  static Result<std::unique_ptr<LibraryQuery>> make(const std::string& folder,
                                                    const SceneNumbers& numbers,
                                                    const std::string& avatarPath) {
    FORETOUCH_TRY(auto library, load(folder));
    std::unique_ptr<LibraryQuery> made(new LibraryQuery(std::move(library)));
    const Library& loaded = made->library_;
    ft_scene_arrays arrays{};
    loaded.sceneArraysInit(&arrays, sizeof arrays);
    arrays.positions = numbers.positions.data();
    arrays.vertex_count = numbers.indices.size();
    arrays.indices = numbers.indices.data();
    arrays.triangle_count = numbers.indices.size() / 3;
    const bool isMade =
        loaded.sceneCreate(&arrays, &made->scene_) == FT_OK &&
        loaded.avatarCreate(avatarPath.c_str(), nullptr, &made->avatar_) == FT_OK &&
        loaded.queryCreate(made->scene_, made->avatar_, nullptr, &made->query_) == FT_OK;
    if (!isMade) return loaded.failed();
    return made;
  }
  LibraryQuery(const LibraryQuery&) = delete;
  LibraryQuery& operator=(const LibraryQuery&) = delete;
  ~LibraryQuery() {
    library_.queryDestroy(query_);
    library_.avatarDestroy(avatar_);
    library_.sceneDestroy(scene_);
  }

  /// Microseconds.
  Result<double> step(const ft_pose& from, const ft_pose& to) {
    const auto begin = Clock::now();
    const ft_status status = library_.step(query_, &from, &to);
    const std::chrono::duration<double, std::micro> taken = Clock::now() - begin;
    if (status != FT_OK) return library_.failed();
    return taken.count();
  }
  /// Verdict and time of impact of every link, of the last step.
  Result<std::vector<std::pair<std::int32_t, double>>> answer(std::size_t numLinks) {
    std::vector<ft_contact> links(numLinks);
    links.front().size = sizeof(ft_contact);
    std::size_t count = 0;
    if (library_.links(query_, links.data(), links.size(), &count) != FT_OK) {
      return library_.failed();
    }
    std::vector<std::pair<std::int32_t, double>> answers;
    for (const ft_contact& link : links) answers.emplace_back(link.verdict, link.toi);
    return answers;
  }
  [[nodiscard]] const Library& library() const { return library_; }

 private:
  explicit LibraryQuery(Library library) : library_(std::move(library)) {}
  Library library_;
  ft_scene* scene_ = nullptr;
  ft_avatar* avatar_ = nullptr;
  ft_query* query_ = nullptr;
};

/// A pose as ft_pose points to it.
struct PoseNumbers {
  explicit PoseNumbers(const Pose& pose) {
    for (const Quaternion& q : pose.rotations) {
      rotations.insert(rotations.end(), {q.w(), q.x(), q.y(), q.z()});
    }
    for (const Eigen::Vector3d& p : pose.translations) {
      translations.insert(translations.end(), {p.x(), p.y(), p.z()});
    }
  }
  [[nodiscard]] ft_pose view(const Library& library) const {
    ft_pose pose{};
    library.poseInit(&pose, sizeof pose);
    pose.joint_count = static_cast<std::uint32_t>(translations.size() / 3);
    pose.rotations = rotations.data();
    pose.translations = translations.data();
    return pose;
  }
  std::vector<double> rotations, translations;
};

BenchTable ratioTable(const char* name, const char* title, const char* unit,
                      std::vector<double> plain, std::vector<double> hardened,
                      std::vector<double> ratios) {
  const auto count = static_cast<std::int64_t>(ratios.size());
  return {name,
          title,
          {{"count", unit, 0},
           {"plain_us", "without, p50 (us)", 2},
           {"hardened_us", "with, p50 (us)", 2},
           {"ratio", "median of the ratios", 4}},
          {{count, percentilesOf(std::move(plain)).p50, percentilesOf(std::move(hardened)).p50,
            percentilesOf(std::move(ratios)).p50}}};
}

Result<ServiceProcess> serve(const BenchInputs& inputs, int avatar, const std::string& program) {
  return ServiceProcess::start({"--scene", inputs.files.scenePath, "--workers", "1", "--avatar",
                                std::to_string(avatar) + "=" + inputs.files.avatarPath},
                               program);
}

}  // namespace

Result<BenchTable> hardenedQueries(const HardeningRequest& request, const BenchInputs& inputs,
                                   const Placement& place) {
  const SceneNumbers numbers(inputs.raw);
  FORETOUCH_TRY(const auto plain,
                LibraryQuery::make(ownFolder(), numbers, inputs.files.avatarPath));
  FORETOUCH_TRY(const auto hardened,
                LibraryQuery::make(request.folder, numbers, inputs.files.avatarPath));
  std::vector<PoseNumbers> poses;
  for (std::size_t frame = 0; frame < inputs.clip.frames.size(); ++frame) {
    poses.emplace_back(placedPose(inputs, place, static_cast<std::int64_t>(frame)));
  }
  if (poses.size() < 2) return failedIn(inputs.files.motionPath, "expected two frames");
  LibraryQuery* const both[] = {plain.get(), hardened.get()};
  std::vector<double> times[2], ratios;
  const std::size_t numLinks = countOf(inputs.avatar.numLinks());
  const auto until = Clock::now() + std::chrono::duration<double>(request.seconds);
  for (std::size_t i = 0; Clock::now() < until; ++i) {
    const std::size_t at = i % (poses.size() - 1);
    double us[2] = {};
    for (const std::size_t which : {i % 2, 1 - i % 2}) {
      const Library& library = both[which]->library();
      const ft_pose from = poses[at].view(library), to = poses[at + 1].view(library);
      FORETOUCH_TRY(us[which], both[which]->step(from, to));
    }
    // Once for each step: the same answers, bit for bit.
    if (i < poses.size()) {
      FORETOUCH_TRY(const auto expected, plain->answer(numLinks));
      FORETOUCH_TRY(const auto found, hardened->answer(numLinks));
      if (expected != found) return failedIn(hardened->library().path, "answers otherwise");
    }
    for (const std::size_t which : {0, 1}) times[which].push_back(us[which]);
    ratios.push_back(us[1] / us[0]);
  }
  return ratioTable("hardened_queries", "A step of the C library with and without hardening",
                    "steps", std::move(times[0]), std::move(times[1]), std::move(ratios));
}

Result<BenchTable> hardenedServices(const HardeningRequest& request, const BenchInputs& inputs,
                                    const LoadTrack& track) {
  // Rounds: a service may have the better place in memory for as long as it lives.
  constexpr int kRounds = 5;
  std::vector<double> times[2], ratios;
  for (int round = 0; round < kRounds; ++round) {
    FORETOUCH_TRY(auto plain, serve(inputs, 1, ownFolder() + "/bin/foretouch"));
    FORETOUCH_TRY(auto hardened, serve(inputs, 2, request.folder + "/bin/foretouch"));
    LoadRequest load;
    load.senders = {{1, kSenderHz}, {2, kSenderHz}};
    load.durationS = request.seconds / kRounds;
    const double before[] = {plain.processorSeconds(), hardened.processorSeconds()};
    FORETOUCH_TRY(const auto outcome, runLoad(track, load));
    const double after[] = {plain.processorSeconds(), hardened.processorSeconds()};
    plain.stop();
    hardened.stop();
    const double poses = 0.5 * static_cast<double>(outcome.sent);
    for (const std::size_t which : {0, 1}) {
      times[which].push_back(1e6 * (after[which] - before[which]) / poses);
    }
    ratios.push_back(times[1].back() / times[0].back());
  }
  return ratioTable("hardened_services",
                    "Processor time of a service per pose at 1 kHz, with and without hardening",
                    "rounds", std::move(times[0]), std::move(times[1]), std::move(ratios));
}

}  // namespace foretouch::tools
