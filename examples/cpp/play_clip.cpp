// Plays a clip in a scene, and prints what each link of the avatar meets first in every step.
//   play_clip SCENE AVATAR CLIP [FRAMES_PER_STEP]
#include <cstdio>
#include <cstdlib>
#include <foretouch/foretouch.hpp>
#include <iostream>
#include <utility>

using namespace foretouch;

/// The value; or the program ends, and says which file, where in it, and what was expected there.
template <typename T>
T need(Result<T> result) {
  if (!result.ok()) {
    std::cerr << describe(result.error()) << '\n';
    std::exit(1);
  }
  return std::move(result).value();
}

int main(int count, char** arguments) {
  const int stride = count == 5 ? std::atoi(arguments[4]) : 1;
  if (count < 4 || count > 5 || stride < 1) {
    std::cerr << "play_clip SCENE AVATAR CLIP [FRAMES_PER_STEP]\n";
    return 2;
  }
  // Read and checked once. Files in centimetres with z up: readScene(file, {0.01, UpAxis::Z}).
  const Scene scene = need(readScene(arguments[1])).scene;
  const Avatar avatar = need(readAvatarFile(arguments[2]));
  const Clip clip = need(readBvhFile(arguments[3]));
  const Skeleton& skeleton = avatar.skeleton();
  const JointMatch match = need(matchJoints(skeleton, clip.skeleton));
  const Query query = need(Query::build(avatar, scene));
  const auto poseAt = [&](std::size_t frame) {
    return need(validatedPose(skeleton, poseOfAvatar(skeleton, clip, match, frame)));
  };

  // One of each per thread: their memory serves every step.
  ChainMotion motion;
  Scratch scratch;
  StepContacts step;
  int steps = 0, contacts = 0;
  Pose earlier = poseAt(0);
  for (std::size_t frame = stride; frame < clip.frames.size(); frame += stride, ++steps) {
    Pose later = poseAt(frame);
    motion.assign(skeleton, earlier, later);
    query.answer(motion, scratch, step);  // cannot fail
    for (const LinkContact& contact : step.links) {
      if (contact.verdict != Verdict::Contact) continue;
      const char* link = skeleton.name(contact.link).c_str();
      const char* object = scene.objectNames()[scene.object(contact.triangle)].c_str();
      std::printf("step %d: %s meets %s at t = %.4f\n", steps, link, object, contact.toi);
      ++contacts;
    }
    earlier = std::move(later);
  }
  std::printf("%d contacts in %d steps\n", contacts, steps);
}
