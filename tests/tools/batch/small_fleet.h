// tests/tools/batch/small_fleet.h: a folder of short clips before one wall, and its manifest.
#pragma once

#include <string>
#include <vector>

#include "tests/tools/program_run.h"
#include "tests/tools/small_world.h"

namespace foretouch::test {

/// Clip i jumps through the wall, stands before it, or goes along it.
inline std::string fleetClip(int i) {
  const double lead = 0.001 * i;
  switch (i % 3) {
    case 0: return clipAlongX({-0.75 - lead, -0.25, 0.25, 0.75 + lead});
    case 1: return clipAlongX({-0.75 - lead, -0.5, -0.75 - lead});
    default: return clipAlongX({-0.5 - lead, -0.05, -0.5 - lead, 0.5, -0.5});
  }
}

/// The clips c0.bvh, c1.bvh...; `broken`: numbers of clips that are named and are not there.
class SmallFleet {
 public:
  explicit SmallFleet(int clips, const std::vector<int>& broken = {}) {
    world.folder.write("clips.txt", "");
    std::string text = "foretouch-batch 1\nall --scene wall.obj --avatar man.json\n";
    for (int i = 0; i < clips; ++i) {
      const std::string name = "c" + std::to_string(i) + ".bvh";
      bool isBroken = false;
      for (const int gone : broken) isBroken = isBroken || gone == i;
      if (!isBroken) world.folder.write(name, fleetClip(i));
      text += "job --motion " + name + "\n";
    }
    manifest = world.folder.write("fleet.batch", text);
  }

  [[nodiscard]] std::vector<std::string> words(const std::string& results,
                                               const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all{"batch", manifest, "--output", results};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  [[nodiscard]] Ended run(const std::string& results,
                          const std::vector<std::string>& more = {}) const {
    return runForetouch(words(results, more));
  }
  /// The table and the report, as one text.
  [[nodiscard]] std::string merged(const std::string& results) const {
    const Ended ended = run(results, {"--merge", "--table", world.folder / "t.jsonl", "--report",
                                      world.folder / "r.html"});
    EXPECT_LE(ended.exitCode, 1) << ended.err;
    const Ended csv = run(results, {"--merge", "--table", world.folder / "t.csv", "--report",
                                    world.folder / "r.html"});
    EXPECT_LE(csv.exitCode, 1) << csv.err;
    std::string page = contentOf(world.folder / "r.html");
    // Links lead to the folder that was asked for.
    const std::string name = results.substr(results.rfind('/') + 1) + "/";
    for (std::size_t at = page.find(name); at != std::string::npos; at = page.find(name, at)) {
      page.replace(at, name.size(), "RESULTS/");
    }
    return contentOf(world.folder / "t.jsonl") + contentOf(world.folder / "t.csv") + page;
  }

  SmallWorld world;
  std::string manifest;
};

}  // namespace foretouch::test
