// The corpus of VMC's datagrams, and mutations of what a performer says: 100,000 datagrams, or as
// many as FORETOUCH_VMC_DATAGRAMS says.
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "tests/fuzz/replay_corpus.h"
#include "tests/fuzz/vmc_inputs.h"
#include "tests/network/vmc/performer.h"
#include "tests/support/random_geometry.h"

namespace foretouch::fuzz {
namespace {

using test::Random;

test::VmcWords wordsOf(Random& random) {
  test::VmcWords words;
  words.root = {random.rotation(), random.inBox(1.0)};
  for (const char* const name :
       {"Hips", "Spine", "Head", "LeftUpperArm", "RightHand", "LastBone"}) {
    words.bones.emplace_back(name, RigidPose{random.rotation(), random.inBox(1.0)});
  }
  return words;
}

void mutate(Random& random, Bytes& bytes) {
  const auto at = [&] {
    return static_cast<std::size_t>(random.below(static_cast<int>(bytes.size())));
  };
  for (int n = random.below(4); n > 0 && !bytes.empty(); --n) {
    switch (random.below(5)) {
      case 0: bytes[at()] = static_cast<std::uint8_t>(random.below(256)); break;
      case 1: bytes[at()] ^= static_cast<std::uint8_t>(1 << random.below(8)); break;
      case 2: bytes.resize(at() / 4 * 4); break;
      case 3: {  // four bytes that are large, small, or not a number
        const std::uint32_t words[] = {0x7fffffff, 0xffffffff, 0x7fc00000, 0x7f800000,
                                       0,          4,          16,         20};
        Bytes word;
        test::addWord(word, words[random.below(8)]);
        const std::size_t place = at() / 4 * 4;
        std::copy(word.begin(), word.end(), bytes.begin() + static_cast<std::ptrdiff_t>(place));
        break;
      }
      default: {  // a part twice
        const std::size_t from = at() / 4 * 4;
        const Bytes part(bytes.begin() + static_cast<std::ptrdiff_t>(from), bytes.end());
        bytes.insert(bytes.end(), part.begin(), part.end());
      }
    }
  }
}

void append(Bytes& input, const Bytes& datagram) {
  input.push_back(static_cast<std::uint8_t>(datagram.size() >> 8));
  input.push_back(static_cast<std::uint8_t>(datagram.size()));
  input.insert(input.end(), datagram.begin(), datagram.end());
}

TEST(FuzzCorpus, VmcKeepsThePromises) {
  const CorpusCounts counts = replayCorpus("vmc", feedVmc, AlsoFeed::EveryBeginning);
  EXPECT_GE(counts.accepted, 4);
  EXPECT_GE(counts.refused, 2);
}

TEST(Vmc, MutatedDatagramsKeepThePromises) {
  const char* const given = std::getenv("FORETOUCH_VMC_DATAGRAMS");
  const long datagrams = given == nullptr ? 100'000 : std::atol(given);
  constexpr int kAtOnce = 20;
  long said = 0, silent = 0;
  for (long n = 0; n < datagrams; n += kAtOnce) {
    Random random(static_cast<std::uint64_t>(n));
    Bytes input;
    for (int k = 0; k < kAtOnce; ++k) {
      const test::VmcWords words = wordsOf(random);
      Bytes datagram = random.chance(0.7)
                           ? words.bundle(0.1 * k + random.uniform(0.0, 0.2))
                           : words.packets()[static_cast<std::size_t>(random.below(7))];
      mutate(random, datagram);
      append(input, datagram);
    }
    (feedVmc(input.data(), input.size()) ? said : silent) += 1;
  }
  EXPECT_GT(said, silent);  // most of them say something after all
}

}  // namespace
}  // namespace foretouch::fuzz
