// examples/make_example.cpp: writes the bundled scene, clip and avatar: room.obj, dancer.bvh and
// dancer.avatar.json. The same bytes on every run.
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "assets/avatar/avatar_file.h"
#include "examples/bvh_writer.h"
#include "examples/choreography.h"
#include "examples/dancer_body.h"
#include "examples/furniture.h"
#include "examples/obj_writer.h"
#include "examples/posture.h"
#include "examples/room.h"

namespace foretouch::examples {
namespace {

constexpr int kFramesPerS = 60;

std::string roomText() {
  MeshBuilder mesh;
  addRoom(mesh);
  addFurniture(mesh);
  return objText(mesh.objects());
}

std::string clipText(const Avatar& dancer) {
  const Choreography choreography;
  std::vector<Pose> frames;
  const auto last = std::lround(Choreography::kDurationS * kFramesPerS);
  for (long frame = 0; frame <= last; ++frame) {
    const double timeS = static_cast<double>(frame) / kFramesPerS;
    frames.push_back(poseOf(dancer.skeleton(), choreography.at(timeS)));
  }
  std::vector<Eigen::Vector3d> tips;
  for (LinkId link = 0; link < dancer.numLinks(); ++link) {
    tips.push_back(dancer.lss(link).front().b);
  }
  return bvhText(dancer.skeleton(), tips, frames, 1.0 / kFramesPerS);
}

bool write(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) {
    std::fprintf(stderr, "%s: cannot be written\n", path.c_str());
  }
  return static_cast<bool>(file);
}

int run(const std::string& folder) {
  const auto dancer = dancerAvatar();
  if (!dancer.ok()) {
    std::fprintf(stderr, "%s\n", describe(dancer.error()).c_str());
    return 1;
  }
  const bool written = write(folder + "/room.obj", roomText()) &&
                       write(folder + "/dancer.bvh", clipText(dancer.value())) &&
                       write(folder + "/dancer.avatar.json", formatAvatar(dancer.value()));
  return written ? 0 : 1;
}

}  // namespace
}  // namespace foretouch::examples

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: make_example FOLDER\nwrites the example's files into FOLDER\n");
    return 2;
  }
  return foretouch::examples::run(argv[1]);
}
