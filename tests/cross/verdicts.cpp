// verdicts SCENE.obj AVATAR CLIP.bvh FRAMES_PER_STEP: what every link meets in every step, a line
// each, through the C library alone, and without the importer. compare.py holds two machines' lines
// against each other.
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <foretouch/foretouch.h>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace {

void must(ft_status status) {
  if (status == FT_OK) return;
  std::fprintf(stderr, "verdicts: %s\n", ft_last_error());
  std::exit(1);
}

/// Of the triangles and polygons (as fans) of an OBJ file; no name, no normal is read.
ft_scene* sceneOf(const char* path) {
  std::vector<double> positions;
  std::vector<std::uint32_t> indices;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "v") {
      for (int axis = 0; axis < 3; ++axis) {
        words >> word;
        positions.push_back(std::strtod(word.c_str(), nullptr));
      }
    } else if (word == "f") {
      std::vector<std::uint32_t> corners;
      while (words >> word) {
        corners.push_back(static_cast<std::uint32_t>(std::strtoul(word.c_str(), nullptr, 10)) - 1);
      }
      for (std::size_t i = 2; i < corners.size(); ++i) {
        indices.insert(indices.end(), {corners[0], corners[i - 1], corners[i]});
      }
    }
  }
  ft_scene_arrays arrays;
  must(ft_scene_arrays_init(&arrays, sizeof arrays));
  arrays.positions = positions.data();
  arrays.vertex_count = positions.size() / 3;
  arrays.indices = indices.data();
  arrays.triangle_count = indices.size() / 3;
  ft_scene* scene = nullptr;
  must(ft_scene_create(&arrays, &scene));
  return scene;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 5 || std::atoi(arguments[4]) < 1) {
    std::fprintf(stderr, "verdicts SCENE.obj AVATAR CLIP.bvh FRAMES_PER_STEP\n");
    return 2;
  }
  must(FT_CHECK_ABI());
  ft_scene* const scene = sceneOf(arguments[1]);
  ft_avatar* avatar = nullptr;
  ft_clip* clip = nullptr;
  ft_query* query = nullptr;
  std::size_t joints = 0;
  ft_clip_info info{};
  info.size = sizeof info;
  must(ft_avatar_create_from_file(arguments[2], nullptr, &avatar));
  must(ft_clip_create_from_file(arguments[3], avatar, nullptr, &clip));
  must(ft_query_create(scene, avatar, nullptr, &query));
  must(ft_avatar_joint_count(avatar, &joints));
  must(ft_clip_get_info(clip, &info));

  std::vector<double> rotations(4 * joints), translations(3 * joints);
  std::vector<ft_contact> links(joints);
  ft_pose pose;
  must(ft_pose_init(&pose, sizeof pose));
  pose.joint_count = static_cast<std::uint32_t>(joints);
  pose.rotations = rotations.data();
  pose.translations = translations.data();
  const auto stride = static_cast<std::size_t>(std::atoi(arguments[4]));
  for (std::size_t frame = 0; frame < info.frame_count; frame += stride) {
    must(ft_clip_pose(clip, frame, rotations.data(), translations.data(), joints, nullptr));
    must(ft_query_step(query, frame == 0 ? &pose : nullptr, &pose));
    links[0].size = sizeof links[0];
    std::size_t answered = 0;
    must(ft_query_links(query, links.data(), joints, &answered));
    for (std::size_t i = 0; i < answered; ++i) {
      std::printf("%zu %" PRId32 " %" PRId32 " %.9g %.9g\n", frame, links[i].link, links[i].verdict,
                  links[i].toi, links[i].separation);
    }
  }
  ft_query_destroy(query);
  ft_clip_destroy(clip);
  ft_avatar_destroy(avatar);
  ft_scene_destroy(scene);
  return 0;
}
