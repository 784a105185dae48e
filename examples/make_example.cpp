// examples/make_example.cpp: writes the bundled scenes, clips and avatars: room.obj, dancer.bvh and
// dancer.avatar.json; ball.csv, a ball that the dancer throws; desk.obj, hand.bvh and
// hand.avatar.json. The same bytes on every run.
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
#include "examples/hand.h"
#include "examples/obj_writer.h"
#include "examples/posture.h"
#include "examples/room.h"
#include "examples/throw.h"

namespace foretouch::examples {
namespace {

constexpr int kFramesPerS = 60;

std::string roomText() {
  MeshBuilder mesh;
  addRoom(mesh);
  addFurniture(mesh);
  return objText(mesh.objects());
}

std::string deskText() {
  MeshBuilder mesh;
  addDesk(mesh);
  return objText(mesh.objects());
}

template <typename PoseAt>
std::string clipText(const Avatar& body, double durationS, const PoseAt& poseAt) {
  std::vector<Pose> frames;
  const auto last = std::lround(durationS * kFramesPerS);
  for (long frame = 0; frame <= last; ++frame) {
    frames.push_back(poseAt(static_cast<double>(frame) / kFramesPerS));
  }
  std::vector<Eigen::Vector3d> tips;
  for (LinkId link = 0; link < body.numLinks(); ++link) {
    tips.push_back(body.lss(link).front().b);
  }
  return bvhText(body.skeleton(), tips, frames, 1.0 / kFramesPerS);
}

std::string danceText(const Avatar& dancer) {
  const Choreography choreography;
  return clipText(dancer, Choreography::kDurationS,
                  [&](double timeS) { return poseOf(dancer.skeleton(), choreography.at(timeS)); });
}

std::string pressText(const Avatar& arm) {
  return clipText(arm, kHandDurationS,
                  [&](double timeS) { return handPoseAt(arm.skeleton(), timeS); });
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

bool writeBody(const Result<Avatar>& body, const std::string& path) {
  if (!body.ok()) {
    std::fprintf(stderr, "%s\n", describe(body.error()).c_str());
    return false;
  }
  return write(path, formatAvatar(body.value()));
}

int run(const std::string& folder) {
  const auto dancer = dancerAvatar(), arm = handAvatar();
  const bool written = writeBody(dancer, folder + "/dancer.avatar.json") &&
                       writeBody(arm, folder + "/hand.avatar.json") &&
                       write(folder + "/room.obj", roomText()) &&
                       write(folder + "/desk.obj", deskText()) &&
                       write(folder + "/dancer.bvh", danceText(dancer.value())) &&
                       write(folder + "/ball.csv", throwText(dancer.value())) &&
                       write(folder + "/hand.bvh", pressText(arm.value()));
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
