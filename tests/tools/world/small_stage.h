// tests/tools/world/small_stage.h: world files about the small world's man, small enough to compute
// by hand.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/tools/small_world.h"
#include "tools/world/load_world.h"
#include "tools/world/world_windows.h"

namespace foretouch::test {

/// The man's hips are at x = -0.75 + 5 t from 0 to 0.3 s: a ball of 0.1 m.
inline const std::string kManWalks =
    "[[body]]\nname = \"man\"\navatar = \"man.json\"\n[body.clip]\nfile = \"clip.bvh\"\n";

inline std::string sphereNamed(const std::string& name, const std::string& rest,
                               double radius = 0.05) {
  return "[[body]]\nname = \"" + name + "\"\nsphere = " + std::to_string(radius) + "\n" + rest;
}

/// A body's pose as a table of the file.
inline std::string poseAt(double timeS, const std::string& position) {
  return "[[body.pose]]\ntime = " + std::to_string(timeS) + "\nposition = [" + position + "]\n";
}

/// World files beside the small world's own files.
class SmallStage : public SmallWorld {
 public:
  static constexpr int kHeadLines = 2;
  [[nodiscard]] std::string write(const std::string& bodies) const {
    return folder.write("world.toml", "format = \"foretouch-world\"\nversion = 1\n" + bodies);
  }

  [[nodiscard]] Result<tools::LoadedWorld> load(const std::string& bodies) const {
    auto file = tools::readWorldFile(write(bodies));
    if (!file.ok()) return file.error();
    return tools::loadWorld(std::move(file).value());
  }

  /// The contacts of all windows.
  [[nodiscard]] std::vector<WorldContact> contactsOf(
      const tools::LoadedWorld& world, const tools::WindowRequest& request = {}) const {
    std::vector<WorldContact> contacts;
    const auto cuts = tools::windowsOf(world, request);
    EXPECT_TRUE(cuts.ok()) << describe(cuts.error());
    const auto done = tools::replayWorld(world, cuts.value(), [&](const tools::WorldStep& step) {
      const auto& found = step.answer.contacts;
      contacts.insert(contacts.end(), found.begin(), found.end());
      return true;
    });
    EXPECT_TRUE(done.ok()) << describe(done.error());
    return contacts;
  }
};

inline double secondsOf(const WorldTime& time) {
  return (static_cast<double>(time.us) + time.fraction) * 1e-6;
}

}  // namespace foretouch::test
