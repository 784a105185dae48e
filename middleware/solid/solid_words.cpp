// The names of a solid avatar's states, and what links are by their names.
#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>

#include "lss/index.h"
#include "middleware/solid/solid_options.h"
#include "middleware/solid/solid_tick.h"

namespace foretouch {
namespace {

constexpr double kHandVisibility = 4.0, kTrunkVisibility = 100.0;

constexpr std::array<std::string_view, 9> kHandWords = {
    "hand", "wrist", "palm", "finger", "thumb", "index", "middle", "ring", "pinky"};
constexpr std::array<std::string_view, 11> kTrunkWords = {
    "hip", "pelvis", "spine", "chest", "torso", "head", "neck", "abdomen", "waist", "back", "root"};
constexpr std::array<std::string_view, 4> kFootWords = {"foot", "toe", "ankle", "heel"};
constexpr std::array<std::string_view, 1> kHeadWords = {"head"};

template <std::size_t N>
bool hasAny(const std::string& name, const std::array<std::string_view, N>& words) {
  std::string lower = name;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view word) { return lower.find(word) != std::string::npos; });
}

template <std::size_t N>
std::vector<bool> linksNamed(const Avatar& avatar, const std::array<std::string_view, N>& words) {
  std::vector<bool> links;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    links.push_back(hasAny(avatar.skeleton().name(link), words));
  }
  return links;
}

}  // namespace

const char* toString(FloorPolicy floor) {
  return floor == FloorPolicy::Lift ? "lift" : "hold";
}

const char* toString(SolidState state) {
  constexpr std::array<const char*, kNumSolidStates> kWords = {
      "placing", "equal", "following", "sliding", "held", "around", "snapped"};
  return kWords[static_cast<std::size_t>(state)];
}

const char* toString(SolidJointState state) {
  constexpr std::array<const char*, kNumSolidJointStates> kWords = {"free", "sliding", "held",
                                                                    "lost"};
  return kWords[static_cast<std::size_t>(state)];
}

const char* toString(SolidLimit limit) {
  constexpr std::array<const char*, kNumSolidLimits> kWords = {"none", "budget", "catch-up",
                                                               "inside"};
  return kWords[static_cast<std::size_t>(limit)];
}

std::vector<double> visibilityByName(const Avatar& avatar) {
  std::vector<double> visibility;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    const std::string& name = avatar.skeleton().name(link);
    // "RightHandIndex" is a hand; "Hips" and "Spine1" are trunk.
    visibility.push_back(hasAny(name, kHandWords)    ? kHandVisibility
                         : hasAny(name, kTrunkWords) ? kTrunkVisibility
                                                     : 1.0);
  }
  return visibility;
}

std::vector<bool> feetByName(const Avatar& avatar) {
  return linksNamed(avatar, kFootWords);
}

std::vector<bool> headsByName(const Avatar& avatar) {
  return linksNamed(avatar, kHeadWords);
}

}  // namespace foretouch
