// tests/network/vmc/performer.h: a performer of VMC: OSC packets by the specification's own words,
// apart from the reader under test.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "articulated/skeleton.h"
#include "network/wire/codec.h"

namespace foretouch::test {

inline void addWord(Bytes& bytes, std::uint32_t word) {
  for (int shift = 24; shift >= 0; shift -= 8) {
    bytes.push_back(static_cast<std::uint8_t>(word >> shift));
  }
}
inline void addText(Bytes& bytes, const std::string& text) {
  bytes.insert(bytes.end(), text.begin(), text.end());
  do bytes.push_back(0);
  while (bytes.size() % 4 != 0);
}
inline void addFloat(Bytes& bytes, double number) {
  const float single = static_cast<float>(number);
  std::uint32_t word = 0;
  std::memcpy(&word, &single, sizeof word);
  addWord(bytes, word);
}

inline Bytes oscPlace(const std::string& address, const std::string& name, const RigidPose& place) {
  Bytes bytes;
  addText(bytes, address);
  addText(bytes, ",sfffffff");
  addText(bytes, name);
  const Quaternion& q = place.rotation;
  for (const double n : {place.translation.x(), place.translation.y(), place.translation.z(), q.x(),
                         q.y(), q.z(), q.w()}) {
    addFloat(bytes, n);
  }
  return bytes;
}
inline Bytes oscTime(double time) {
  Bytes bytes;
  addText(bytes, "/VMC/Ext/T");
  addText(bytes, ",f");
  addFloat(bytes, time);
  return bytes;
}
inline Bytes oscState(const std::vector<std::uint32_t>& numbers) {
  Bytes bytes;
  addText(bytes, "/VMC/Ext/OK");
  addText(bytes, "," + std::string(numbers.size(), 'i'));
  for (const std::uint32_t number : numbers) addWord(bytes, number);
  return bytes;
}
inline Bytes oscBundle(const std::vector<Bytes>& elements) {
  Bytes bytes;
  addText(bytes, "#bundle");
  addWord(bytes, 0);
  addWord(bytes, 1);  // now
  for (const Bytes& element : elements) {
    addWord(bytes, static_cast<std::uint32_t>(element.size()));
    bytes.insert(bytes.end(), element.begin(), element.end());
  }
  return bytes;
}

/// "leftUpperArm" as Unity has it.
inline std::string unityName(std::string bone) {
  bone[0] = static_cast<char>(bone[0] - 'a' + 'A');
  return bone;
}

/// What a performer says of one instant, in Unity's axes.
struct VmcWords {
  RigidPose root;
  std::vector<std::pair<std::string, RigidPose>> bones;  ///< By Unity's names.

  [[nodiscard]] std::vector<Bytes> packets() const {
    std::vector<Bytes> all{oscPlace("/VMC/Ext/Root/Pos", "root", root)};
    for (const auto& [name, place] : bones) {
      all.push_back(oscPlace("/VMC/Ext/Bone/Pos", name, place));
    }
    return all;
  }
  [[nodiscard]] Bytes bundle(double time) const {
    std::vector<Bytes> all = packets();
    all.push_back(oscTime(time));
    return oscBundle(all);
  }
};

}  // namespace foretouch::test
