// Writes the valid messages that the corpora of message_inputs.h start from: write_message_seeds
// CORPUS_FOLDER. Run by hand when a type changes.
#include <cstdio>
#include <fstream>
#include <string>

#include "network/wire/codec.h"
#include "tests/network/random_messages.h"

namespace {

using foretouch::Bytes;
using foretouch::test::Random;

bool write(const std::string& path, const Bytes& bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  return static_cast<bool>(file.flush());
}

/// Three messages of so many elements.
template <typename Draw>
bool writeSeeds(const std::string& folder, Draw draw) {
  for (const int n : {1, 4, 12}) {
    Random random(static_cast<std::uint64_t>(n));
    Bytes bytes;
    encode(draw(random, n), bytes);
    if (!write(folder + "/valid_" + std::to_string(n), bytes)) return false;
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace foretouch::test;  // NOLINT
  if (argc != 2) {
    std::fprintf(stderr, "usage: write_message_seeds CORPUS_FOLDER\n");
    return 2;
  }
  const std::string corpus = argv[1];
  const bool written =
      writeSeeds(corpus + "/skeleton_message", randomSkeletonMessage) &&
      writeSeeds(corpus + "/pose_message", randomPoseMessage) &&
      writeSeeds(corpus + "/contacts_message", randomContactsMessage) &&
      writeSeeds(
          corpus + "/solid_message",
          [](Random& random, int n) { return randomSolidMessage(random, n, n / 2 + 1, n); }) &&
      writeSeeds(corpus + "/person_message",
                 [](Random& random, int n) { return randomPersonMessage(random, n, n); }) &&
      writeSeeds(corpus + "/speaker_message",
                 [](Random& random, int) { return randomSpeakerMessage(random); }) &&
      writeSeeds(corpus + "/status_message", randomStatusMessage) &&
      writeSeeds(corpus + "/body_message", randomBodyMessage) &&
      writeSeeds(corpus + "/rigid_pose_message", randomRigidPoseMessage) &&
      writeSeeds(corpus + "/events_message", randomEventsMessage) &&
      writeSeeds(corpus + "/pushes_message", randomPushesMessage);
  if (!written) std::fprintf(stderr, "write_message_seeds: cannot write below %s\n", argv[1]);
  return written ? 0 : 1;
}
