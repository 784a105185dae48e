// tests/tools/commands/objects_program_test.cpp: what `foretouch replay` finds at and after the
// first contact: --scope objects and --pass-separating.
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/holds.h"
#include "tests/tools/program_run.h"
#include "tests/tools/report/view_reading.h"
#include "tests/tools/small_world.h"
#include "tests/tools/stream/stream_lines.h"

namespace foretouch::test {
namespace {

using nlohmann::json;

/// A table at y = 0, and the side of a cup at x = 0.5.
constexpr char kTableAndCup[] =
    "o table\nv -2 0 -2\nv 2 0 -2\nv 2 0 2\nv -2 0 2\nf 1 2 3\nf 1 3 4\n"
    "o cup\nv 0.5 0 -0.2\nv 0.5 0 0.2\nv 0.5 0.4 0\nf 5 6 7\n";
constexpr char kHand[] =
    R"({"format":"foretouch-avatar","version":1,"links":[{"name":"Hand","parent":null,)"
    R"("offset":[0,0,0],"lss":[{"a":[0,0,0],"b":[0,0,0],"radius":0.05}]}]})";

/// Down to a fifth of a millimetre above the table, along it through the cup, and up again.
constexpr char kRest[] =
    "HIERARCHY\nROOT Hand\n{\n  OFFSET 0 0 0\n"
    "  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
    "  End Site\n  {\n    OFFSET 0 0.1 0\n  }\n}\nMOTION\nFrames: 4\nFrame Time: 0.1\n"
    "0 0.3 0 0 0 0\n0 0.0502 0 0 0 0\n1 0.0502 0 0 0 0\n1 0.3 0 0 0 0\n";

class TableAndCup : public SmallWorld {
 public:
  TableAndCup() {
    folder.write("table.obj", kTableAndCup);
    folder.write("hand.json", kHand);
    folder.write("rest.bvh", kRest);
  }
  [[nodiscard]] std::vector<std::string> replayed(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = replay(more, "table.obj", "hand.json", "rest.bvh");
    arguments.insert(arguments.end(), {"--output", out});
    return arguments;
  }
  /// The lines of a replay that must succeed.
  [[nodiscard]] std::vector<json> linesOf(const std::vector<std::string>& more) const {
    const Ended ended = runForetouch(replayed(more));
    EXPECT_EQ(ended.exitCode, 0) << ended.err;
    std::vector<json> lines;
    std::istringstream stream(contentOf(out));
    for (std::string line; std::getline(stream, line);) {
      if (!isOfTouches(line)) lines.push_back(json::parse(line));
    }
    EXPECT_EQ(lines.size(), 4u);
    return lines;
  }
  std::string out = folder / "out.jsonl";
};

std::vector<std::string> objectsIn(const json& contacts) {
  std::vector<std::string> names;
  for (const json& contact : contacts) names.push_back(contact["object"]);
  return names;
}

using Names = std::vector<std::string>;

/// The hand, of 5 cm, meets the cup at x = 0.45 on its way from 0 to 1.
void expectCup(const json& contact) {
  EXPECT_EQ(contact["link"], "Hand");
  EXPECT_EQ(contact["object"], "cup");
  EXPECT_EQ(contact["verdict"], "contact");
  EXPECT_LE(contact["toi"].get<double>(), 0.45 + 1e-12);
  EXPECT_GE(contact["toi"].get<double>(), 0.45 - 1.001e-3);
  EXPECT_NEAR(contact["normal"][0].get<double>(), -1.0, 1e-9);
}

TEST(ObjectsReplay, ListsWhatARestingHandMeetsBesides) {
  const TableAndCup world;
  const std::vector<json> lines = world.linesOf({"--scope", "objects"});
  EXPECT_EQ(lines[0]["scope"], "objects");
  EXPECT_EQ(lines[0].count("pass_separating"), 0u);
  EXPECT_EQ(objectsIn(lines[1]["objects"]), Names({"table"}));
  EXPECT_EQ(objectsIn(lines[2]["objects"]), Names({"table", "cup"}));
  EXPECT_EQ(objectsIn(lines[2]["contacts"]), Names({"table"}));
  EXPECT_EQ(lines[2]["objects"][0], lines[2]["contacts"][0]);
  expectCup(lines[2]["objects"][1]);
  EXPECT_NEAR(lines[2]["objects"][1]["time"].get<double>(), 0.145, 2e-4);
  EXPECT_EQ(objectsIn(lines[3]["objects"]), Names({"table"}));
}

TEST(ObjectsReplay, LetsWhatSeparatesGoOn) {
  const TableAndCup world;
  const std::vector<json> held = world.linesOf({});
  EXPECT_EQ(objectsIn(held[2]["contacts"]), Names({"table"}));
  EXPECT_EQ(objectsIn(held[3]["contacts"]), Names({"table"}));
  const std::vector<json> free = world.linesOf({"--pass-separating"});
  EXPECT_EQ(free[0]["pass_separating"], true);
  EXPECT_EQ(free[0].count("scope"), 0u);
  EXPECT_EQ(free[1]["contacts"], held[1]["contacts"]);  // down it is held
  ASSERT_EQ(free[2]["contacts"].size(), 1u);
  expectCup(free[2]["contacts"][0]);
  EXPECT_EQ(free[3]["contacts"].size(), 0u);  // and up it is free
  const std::vector<json> both = world.linesOf({"--pass-separating", "--scope", "objects"});
  EXPECT_EQ(both[2]["objects"], free[2]["contacts"]);
}

TEST(ObjectsReplay, ChangesNothingElse) {
  const TableAndCup world;
  const std::vector<json> without = world.linesOf({});
  std::vector<json> with = world.linesOf({"--scope", "objects"});
  with[0].erase("scope");
  EXPECT_EQ(with[0], without[0]);
  for (std::size_t i = 1; i < with.size(); ++i) {
    EXPECT_EQ(without[i].count("objects"), 0u);
    EXPECT_EQ(with[i].erase("objects"), 1u);
    with[i]["latency_us"] = without[i]["latency_us"];
    EXPECT_EQ(with[i], without[i]);
  }
}

TEST(ObjectsReplay, IsSummedUpAndReported) {
  const TableAndCup world;
  const std::string page = world.folder / "report.html";
  const Ended ended = runForetouch(world.replayed({"--scope", "objects", "--report", page}));
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_TRUE(holds(ended.out, "by object: contacts            4\n")) << ended.out;
  EXPECT_TRUE(holds(ended.out, "\nHand                     cup                               1"))
      << ended.out;
  EXPECT_TRUE(holds(ended.out, "\nHand                     table                             3"))
      << ended.out;
  const json document = json::parse(documentIn(contentOf(page)));
  const json& contacts = document["avatars"][0]["contacts"];
  EXPECT_EQ(objectsIn(contacts), Names({"table", "table", "cup", "table"}));
  EXPECT_TRUE(holds(document["settings"].dump(), "objects"));
  EXPECT_TRUE(holds(document["summary"].dump(), "by object: contacts"));
  const std::string passing = world.folder / "passing.html";
  ASSERT_EQ(runForetouch(world.replayed({"--pass-separating", "--report", passing})).exitCode, 0);
  EXPECT_TRUE(
      holds(json::parse(documentIn(contentOf(passing)))["settings"].dump(), "what separates"));
}

TEST(ObjectsReplay, WritesTheSameBytesForAnyThreads) {
  const TableAndCup world;
  std::string first;
  for (const char* threads : {"1", "2", "4"}) {
    std::string text;
    for (json line : world.linesOf({"--scope", "objects", "--threads", threads})) {
      line.erase("latency_us");
      text += line.dump() + "\n";
    }
    if (first.empty()) first = text;
    EXPECT_EQ(text, first) << threads;
  }
}

TEST(ObjectsReplay, RefusesByNameWhatCannotBeHonoured) {
  const TableAndCup world;
  const std::vector<std::pair<std::vector<std::string>, std::string>> trials = {
      {{"--scope", "object"},
       "--scope: expected links, avatar or objects, found 'object'; did you mean 'objects'?"},
      {{"--scope", "objects", "--fidelity", "skinned", "--skin", "x.glb"},
       "--scope objects: expected --fidelity link or exact, found skinned"},
      {{"--scope", "objects", "--budget-us", "100"},
       "--scope objects: expected no --budget-us, found 100"},
      {{"--pass-separating", "--fidelity", "skinned", "--skin", "x.glb"},
       "--pass-separating: expected --fidelity link or exact, found skinned"},
  };
  for (const auto& [options, expected] : trials) {
    const Ended ended = runForetouch(world.replayed(options));
    EXPECT_EQ(ended.exitCode, 2) << options.back();
    EXPECT_TRUE(holds(ended.err, expected)) << ended.err;
  }
}

// Beyond that many LSS each link is answered by the scalar form, which knows neither.
TEST(ObjectsReplay, RefusesAvatarsOfTooManyLss) {
  const TableAndCup world;
  constexpr int kLinks = 17, kLss = 4096;  // one link more than there is room for
  std::string lss, links;
  for (int i = 0; i < kLss; ++i) {
    lss += std::string(i == 0 ? "" : ",") + R"({"a":[0,0,0],"b":[0,0,0],"radius":0.05})";
  }
  for (int i = 0; i < kLinks; ++i) {
    const std::string parent = i == 0 ? "null" : R"("Hand")";
    links += std::string(i == 0 ? "" : ",") + R"({"name":"Hand)" +
             (i == 0 ? "" : std::to_string(i)) + R"(","parent":)" + parent +
             R"(,"offset":[0,0,0],"lss":[)" + lss + "]}";
  }
  world.folder.write("many.json",
                     R"({"format":"foretouch-avatar","version":1,"links":[)" + links + "]}");
  for (const auto& [options, expected] :
       std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"--scope", "objects", "--output", world.out}, "--scope: expected"},
           {{"--pass-separating", "--output", world.out}, "--pass-separating: expected"}}) {
    const Ended ended = runForetouch(world.replay(options, "table.obj", "many.json", "rest.bvh"));
    EXPECT_EQ(ended.exitCode, 2) << ended.out;
    EXPECT_TRUE(holds(ended.err, expected)) << ended.err;
  }
}

}  // namespace
}  // namespace foretouch::test
