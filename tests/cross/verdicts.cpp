// verdicts CASES [--times]: what every link meets in every step of every case (cases.h), through
// the C library alone and without the importer, on standard output. compare.py holds two machines'
// answers against each other, judge_verdicts judges each.
//   case NUMBER
//   pose FRAME rotations translations     of all joints
//   link LINK VERDICT toi free_until separation penetration lss triangle scene[3] link[3] normal[3]
// Numbers are written to the last bit. A pose ends the step that the lines of links behind it tell
// of. With --times instead: how long the steps took.
#include <algorithm>
#include <chrono>
#include <cinttypes>
#include <cstdio>
#include <exception>
#include <foretouch/foretouch.h>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/cross/cases.h"

namespace {

using foretouch::test::CrossCase;
using foretouch::test::ObjScene;

void must(ft_status status) {
  if (status != FT_OK) throw std::runtime_error(ft_last_error());
}

template <typename Numbers>
void print(const Numbers& numbers) {
  for (const double x : numbers) std::printf(" %a", x);
}

ft_scene* sceneOf(const std::string& path) {
  const ObjScene read = foretouch::test::readObj(path);
  ft_scene_arrays arrays;
  must(ft_scene_arrays_init(&arrays, sizeof arrays));
  arrays.positions = read.positions.data();
  arrays.vertex_count = read.positions.size() / 3;
  arrays.indices = read.indices.data();
  arrays.triangle_count = read.indices.size() / 3;
  ft_scene* scene = nullptr;
  must(ft_scene_create(&arrays, &scene));
  return scene;
}

/// A clip that plays in a scene, a step at a time. What it makes lives as long as the program,
/// which ends where something fails.
class Played {
 public:
  explicit Played(const CrossCase& asked, const ft_scene* scene) {
    must(ft_avatar_create_from_file(asked.avatar.c_str(), nullptr, &avatar_));
    ft_clip_options options;
    must(ft_clip_options_init(&options, sizeof options));
    options.scale = asked.scale;
    options.yaw_deg = asked.yawDeg;
    for (std::size_t axis = 0; axis < 3; ++axis) options.origin[axis] = asked.origin[axis];
    must(ft_clip_create_from_file(asked.clip.c_str(), avatar_, &options, &clip_));
    must(ft_query_create(scene, avatar_, nullptr, &query_));
    must(ft_avatar_joint_count(avatar_, &joints_));
    rotations_.resize(4 * joints_);
    translations_.resize(3 * joints_);
    links_.resize(joints_);
    must(ft_pose_init(&pose_, sizeof pose_));
    pose_.joint_count = static_cast<std::uint32_t>(joints_);
    pose_.rotations = rotations_.data();
    pose_.translations = translations_.data();
  }
  Played(const Played&) = delete;
  Played& operator=(const Played&) = delete;
  ~Played() {
    ft_query_destroy(query_);
    ft_clip_destroy(clip_);
    ft_avatar_destroy(avatar_);
  }

  [[nodiscard]] std::size_t numFrames() const {
    ft_clip_info info{};
    info.size = sizeof info;
    must(ft_clip_get_info(clip_, &info));
    return static_cast<std::size_t>(info.frame_count);
  }

  /// Returns how long it took (s).
  double stepTo(std::size_t frame) {
    must(ft_clip_pose(clip_, frame, rotations_.data(), translations_.data(), joints_, nullptr));
    const auto begin = std::chrono::steady_clock::now();
    must(ft_query_step(query_, frame == 0 ? &pose_ : nullptr, &pose_));
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }

  void tellOf(std::size_t frame) {
    std::printf("pose %zu", frame);
    print(rotations_);
    print(translations_);
    std::printf("\n");
    if (frame == 0) return;
    links_[0].size = sizeof links_[0];
    std::size_t answered = 0;
    must(ft_query_links(query_, links_.data(), joints_, &answered));
    for (std::size_t i = 0; i < answered; ++i) printLink(links_[i]);
  }

 private:
  static void printLink(const ft_contact& c) {
    std::printf("link %" PRId32 " %" PRId32 " %a %a %a %a %" PRId32 " %" PRId32, c.link, c.verdict,
                c.toi, c.free_until, c.separation, c.penetration, c.lss, c.triangle);
    print(c.point_scene);
    print(c.point_link);
    print(c.normal);
    std::printf("\n");
  }

  ft_avatar* avatar_ = nullptr;
  ft_clip* clip_ = nullptr;
  ft_query* query_ = nullptr;
  std::size_t joints_ = 0;
  std::vector<double> rotations_, translations_;
  std::vector<ft_contact> links_;
  ft_pose pose_{};
};

/// What `answer` does with each case's steps, in the cases' order.
template <typename Answer>
void play(const std::vector<CrossCase>& cases, const Answer& answer) {
  must(FT_CHECK_ABI());
  ft_scene* scene = nullptr;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (i == 0 || cases[i].scene != cases[i - 1].scene) {
      ft_scene_destroy(scene);
      scene = sceneOf(cases[i].scene);
    }
    Played played(cases[i], scene);
    const std::size_t frames = played.numFrames();
    for (std::size_t frame = 0; frame < frames;
         frame += static_cast<std::size_t>(cases[i].stride)) {
      answer(i, frame, played);
    }
  }
  ft_scene_destroy(scene);
}

void answer(std::size_t number, std::size_t frame, Played& played) {
  if (frame == 0) std::printf("case %zu\n", number);
  played.stepTo(frame);
  played.tellOf(frame);
}

void tellTimes(const std::vector<CrossCase>& cases) {
  std::vector<double> times;
  play(cases, [&](std::size_t, std::size_t frame, Played& played) {
    const double time = played.stepTo(frame);
    if (frame != 0) times.push_back(1e6 * time);
  });
  if (times.empty()) throw std::runtime_error("the cases have no steps");
  std::sort(times.begin(), times.end());
  double sum = 0.0;
  for (const double time : times) sum += time;
  const auto count = static_cast<double>(times.size());
  std::printf("%zu steps: mean %.1f us, median %.1f us, 99 %% within %.1f us\n", times.size(),
              sum / count, times[times.size() / 2], times[times.size() * 99 / 100]);
}

}  // namespace

int main(int count, char** arguments) {
  const bool isTimed = count == 3 && std::string(arguments[2]) == "--times";
  if (count != 2 && !isTimed) {
    std::fprintf(stderr, "verdicts CASES [--times]\n");
    return 2;
  }
  try {
    const auto cases = foretouch::test::readCases(arguments[1]);
    if (isTimed) {
      tellTimes(cases);
    } else {
      play(cases, answer);
    }
  } catch (const std::exception& failed) {
    std::fprintf(stderr, "verdicts: %s\n", failed.what());
    return 1;
  }
  return 0;
}
