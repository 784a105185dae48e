// verdicts CASES: what every link meets in every step of every case (cases.h), through the C
// library alone and without the importer, on standard output. compare.py holds two machines'
// answers against each other, judge_verdicts judges each.
//   case NUMBER
//   pose FRAME rotations translations     of all joints
//   link LINK VERDICT toi free_until separation penetration lss triangle scene[3] link[3] normal[3]
// Numbers are written to the last bit. A pose ends the step that the lines of links behind it tell
// of.
#include <cinttypes>
#include <cstdio>
#include <exception>
#include <foretouch/foretouch.h>
#include <stdexcept>
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

  void stepTo(std::size_t frame) {
    must(ft_clip_pose(clip_, frame, rotations_.data(), translations_.data(), joints_, nullptr));
    must(ft_query_step(query_, frame == 0 ? &pose_ : nullptr, &pose_));
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

void answer(const std::vector<CrossCase>& cases) {
  must(FT_CHECK_ABI());
  ft_scene* scene = nullptr;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (i == 0 || cases[i].scene != cases[i - 1].scene) {
      ft_scene_destroy(scene);
      scene = sceneOf(cases[i].scene);
    }
    std::printf("case %zu\n", i);
    Played played(cases[i], scene);
    const std::size_t frames = played.numFrames();
    for (std::size_t frame = 0; frame < frames;
         frame += static_cast<std::size_t>(cases[i].stride)) {
      played.stepTo(frame);
    }
  }
  ft_scene_destroy(scene);
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr, "verdicts CASES\n");
    return 2;
  }
  try {
    answer(foretouch::test::readCases(arguments[1]));
  } catch (const std::exception& failed) {
    std::fprintf(stderr, "verdicts: %s\n", failed.what());
    return 1;
  }
  return 0;
}
