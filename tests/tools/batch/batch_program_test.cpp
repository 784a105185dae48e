// `foretouch batch` as users run it: shards, failures, kills, full disks, two workers on one job.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/holds.h"
#include "tests/tools/batch/small_fleet.h"
#include "tests/tools/feet/planted_walk.h"

namespace foretouch::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

std::vector<Json> rowsOf(const SmallFleet& fleet, const std::string& results, int exitCode) {
  const std::string table = fleet.world.folder / "rows.jsonl";
  const Ended ended = fleet.run(results, {"--merge", "--table", table});
  EXPECT_EQ(ended.exitCode, exitCode) << ended.err;
  std::vector<Json> rows;
  std::ifstream lines(table);
  for (std::string line; std::getline(lines, line);) rows.push_back(Json::parse(line));
  return rows;
}

/// Files with this ending, at any depth.
std::vector<std::string> filesWith(const std::string& folder, const std::string& ending) {
  std::vector<std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ending) found.push_back(entry.path().string());
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Several files have no place in one stream, nor in a folder called "-".
TEST(BatchProgram, RefusesStandardOutputAsAFolder) {
  const SmallFleet fleet(1);
  const Ended batch = fleet.run("-");
  EXPECT_EQ(batch.exitCode, 2);
  EXPECT_TRUE(holds(batch.err, "--output: expected a folder for several files, found '-'"));
  const Ended certify = runForetouch({"certify", "--scene", fleet.world.folder / "wall.obj",
                                      "--avatar", fleet.world.folder / "man.json", "--motion",
                                      fleet.world.folder / "c0.bvh", "-o", "-"});
  EXPECT_EQ(certify.exitCode, 2);
  EXPECT_TRUE(holds(certify.err, "--output: expected a folder for several files, found '-'"));
  EXPECT_FALSE(fs::exists("-"));
}

TEST(BatchProgram, AnswersAsReplayDoes) {
  const SmallFleet fleet(6);
  const std::string results = fleet.world.folder / "results";
  const Ended ended = fleet.run(results, {"--threads", "2", "--json"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  const Json tally = Json::parse(ended.out);
  EXPECT_EQ(tally["jobs"], 6);
  EXPECT_EQ(tally["done"], 6);
  const auto rows = rowsOf(fleet, results, 0);
  ASSERT_EQ(rows.size(), 6u);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string clip = "c" + std::to_string(i) + ".bvh";
    EXPECT_EQ(rows[i]["options"]["motion"], clip);
    const Ended bare = runForetouch(fleet.world.replay(
        {"--json", "--output", fleet.world.folder / "bare.jsonl"}, "wall.obj", "man.json", clip));
    Json summary = Json::parse(bare.out);
    for (const char* const key : {"motion", "scene", "latency_us", "threads", "output"}) {
      summary.erase(key);
    }
    EXPECT_EQ(rows[i]["summary"], summary);
    EXPECT_EQ(summary["steps_with_contact"] > 0, i % 3 != 1) << i;
    const std::string name = rows[i]["name"];
    const std::string kept = contentOf(results + "/" + name.substr(0, 2) + "/" + name + ".jsonl");
    EXPECT_EQ(std::count(kept.begin(), kept.end(), '\n'), [](const std::string& text) {
      return std::count(text.begin(), text.end(), '\n');
    }(contentOf(fleet.world.folder / "bare.jsonl")));
  }
}

/// Clips whose left foot slides by so many millimetres, and one that is not there.
TEST(BatchProgram, RanksFeetTheWorstClipFirstWithItsPlot) {
  const TempFolder folder;
  folder.write("walker.json", kWalkerAvatar);
  std::string text = "foretouch-batch 1\nall --avatar walker.json --rate 100\n";
  for (const int slide : {4, 30, 0, 12}) {
    PlantedFoot left, right;
    left.stances = {{{0, 0, 0}, {0, 0, 1e-3 * slide}, 0.0, 1.0}};
    right.stances = {{{0, 0, 0.2}, {0, 0, 0.2}, 0.0, 1.0}};
    std::vector<Place> leftSoles, rightSoles;
    for (int frame = 0; frame <= 100; ++frame) {
      leftSoles.push_back(left.soleAt(0.01 * frame));
      rightSoles.push_back(right.soleAt(0.01 * frame));
    }
    const std::string name = "slides" + std::to_string(slide) + ".bvh";
    folder.write(name, walkBvh(leftSoles, rightSoles, 0.01));
    text += "job --motion " + name + "\n";
  }
  const std::string manifest = folder.write("feet.batch", text + "job --motion gone.bvh\n");
  const std::vector<std::string> words{"batch", manifest, "--output", folder / "results", "--feet"};
  EXPECT_EQ(runForetouch(words).exitCode, 1) << "one is not there";
  std::vector<std::string> merge = words;
  merge.insert(merge.end(), {"--merge", "--table", folder / "t.jsonl"});
  const Ended merged = runForetouch(merge);
  EXPECT_EQ(merged.exitCode, 1) << merged.err;
  const std::string page = contentOf(folder / "results" + "/feet_report.html");
  std::size_t last = page.find("gone.bvh");
  ASSERT_NE(last, std::string::npos) << page;
  for (const char* const clip : {"slides30", "slides12", "slides4", "slides0"}) {
    const std::size_t at = page.find(clip);
    ASSERT_NE(at, std::string::npos) << clip;
    EXPECT_GT(at, last) << clip;
    last = at;
  }
  EXPECT_EQ(filesWith(folder / "results", ".csv").size(), 4u) << "stances of each";
  for (const std::string& plot : filesWith(folder / "results", ".html")) {
    const std::string place = plot.substr((folder / "results").size() + 1);
    if (place == "feet_report.html") continue;
    EXPECT_NE(page.find("<a href=\"./" + place + "\">plot</a>"), std::string::npos) << place;
  }
  std::ifstream lines(folder / "t.jsonl");
  std::string first;
  std::getline(lines, first);
  EXPECT_NEAR(Json::parse(first)["summary"]["worst_slide"].get<double>(), 0.004, 0.001);
}

TEST(BatchProgram, WhatIsDoneIsNotDoneAgain) {
  const SmallFleet fleet(4);
  const std::string results = fleet.world.folder / "results";
  ASSERT_EQ(fleet.run(results).exitCode, 0);
  const auto records = filesWith(results, ".json"), lines = filesWith(results, ".jsonl");
  ASSERT_EQ(records.size(), 4u);
  ASSERT_EQ(lines.size(), 4u);
  std::vector<fs::file_time_type> times;
  for (const std::string& path : lines) times.push_back(fs::last_write_time(path));
  Json tally = Json::parse(fleet.run(results, {"--json"}).out);
  EXPECT_EQ(tally["kept"], 4);
  EXPECT_EQ(tally["done"], 0);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    EXPECT_EQ(fs::last_write_time(lines[i]), times[i]);
  }
  // A record that is cut, results that are cut, and results that are gone.
  fs::resize_file(records[0], fs::file_size(records[0]) - 1);
  fs::resize_file(lines[1], fs::file_size(lines[1]) - 10);
  fs::remove(lines[2]);
  tally = Json::parse(fleet.run(results, {"--json"}).out);
  EXPECT_EQ(tally["kept"], 1);
  EXPECT_EQ(tally["done"], 3);
}

TEST(BatchProgram, ResultsThatSayOtherThingsAreDoneAgain) {
  const SmallFleet fleet(4);
  const std::string results = fleet.world.folder / "results";
  ASSERT_EQ(fleet.run(results).exitCode, 0);
  const std::string table = fleet.merged(results);
  const auto lines = filesWith(results, ".jsonl");
  ASSERT_EQ(lines.size(), 4u);
  // As many lines: with zeros after a loss of power, and with another name.
  const std::string first = contentOf(lines[0]), second = contentOf(lines[1]);
  std::string zeroed = first;
  for (std::size_t i = zeroed.size() / 2; i < zeroed.size(); ++i) {
    if (zeroed[i] != '\n') zeroed[i] = '\0';
  }
  std::ofstream(lines[0], std::ios::binary) << zeroed;
  std::string renamed = second;
  renamed.replace(renamed.find("foretouch"), 9, "somebody!");
  std::ofstream(lines[1], std::ios::binary) << renamed;
  // Something that nobody will ever write to.
  fs::remove(lines[2]);
  ASSERT_EQ(::mkfifo(lines[2].c_str(), 0600), 0);
  Json tally = Json::parse(fleet.run(results, {"--json"}).out);
  EXPECT_EQ(tally["kept"], 1);
  EXPECT_EQ(tally["done"], 3);
  EXPECT_EQ(contentOf(lines[0]).find('\0'), std::string::npos);
  EXPECT_EQ(contentOf(lines[1]).find("somebody!"), std::string::npos);
  EXPECT_EQ(fleet.merged(results), table);
}

TEST(BatchProgram, ShardsShareTheJobsAndMergeIntoTheSame) {
  const SmallFleet fleet(7);
  const std::string one = fleet.world.folder / "one", three = fleet.world.folder / "three";
  ASSERT_EQ(fleet.run(one).exitCode, 0);
  for (const char* const shard : {"3/3", "1/3", "2/3"}) {
    const Ended ended = fleet.run(three, {"--shard", shard, "--threads", "1", "--json"});
    ASSERT_EQ(ended.exitCode, 0) << ended.err;
    EXPECT_EQ(Json::parse(ended.out)["done"], shard[0] == '1' ? 3 : 2);
  }
  EXPECT_EQ(fleet.merged(one), fleet.merged(three));
  const Ended none = fleet.run(three, {"--shard", "9/9", "--json"});
  EXPECT_EQ(none.exitCode, 0);
  EXPECT_EQ(Json::parse(none.out)["jobs"], 0);
  for (const char* const wrong : {"0/3", "4/3", "1", "1/", "a/b", "1/3x", "-1/3"}) {
    const Ended ended = fleet.run(three, {"--shard", wrong});
    EXPECT_EQ(ended.exitCode, 2) << wrong;
    EXPECT_TRUE(holds(ended.err, "--shard: expected i/n")) << ended.err;
  }
}

TEST(BatchProgram, AJobThatFailsFailsByNameAndOthersFinish) {
  const SmallFleet fleet(5, {1});
  fleet.world.folder.write("c3.bvh", "HIERARCHY\nROOT nonsense");
  const std::string results = fleet.world.folder / "results";
  const Ended ended = fleet.run(results, {"--json"});
  EXPECT_EQ(ended.exitCode, 1);
  const Json tally = Json::parse(ended.out);
  EXPECT_EQ(tally["done"], 3);
  EXPECT_EQ(tally["failed"], 2);
  EXPECT_TRUE(holds(ended.err, "fleet.batch:4: job 2: c1.bvh: ")) << ended.err;
  EXPECT_TRUE(holds(ended.err, "fleet.batch:6: job 4: c3.bvh:")) << ended.err;
  const auto rows = rowsOf(fleet, results, 1);
  EXPECT_EQ(rows[1]["state"], "failed");
  EXPECT_TRUE(holds(rows[1]["error"].get<std::string>(), "c1.bvh")) << rows[1];
  EXPECT_EQ(rows[2]["state"], "done");
  // The file is there now: it is another job, and is done.
  fleet.world.folder.write("c1.bvh", fleetClip(1));
  EXPECT_EQ(Json::parse(fleet.run(results, {"--json"}).out)["done"], 1);
}

/// A program that dies on one clip and is foretouch otherwise.
std::string crashingProgram(const SmallFleet& fleet, const std::string& clip,
                            const std::string& death) {
  return fleet.world.folder.script("crashing", "case \"$*\" in *" + clip + "*) " + death +
                                                   ";; esac\nexec " FORETOUCH_PROGRAM " \"$@\"");
}

TEST(BatchProgram, AJobThatCrashesFailsByName) {
  const SmallFleet fleet(4);
  const std::string results = fleet.world.folder / "results";
  const std::string program = crashingProgram(fleet, "c2.bvh", "kill -SEGV $$");
  const Ended ended = fleet.run(results, {"--program", program, "--json"});
  EXPECT_EQ(ended.exitCode, 1);
  EXPECT_EQ(Json::parse(ended.out)["done"], 3);
  EXPECT_TRUE(holds(ended.err, "job 3: was ended by signal 11")) << ended.err;
  // It is tried again, and does not crash any more.
  EXPECT_EQ(Json::parse(fleet.run(results, {"--json"}).out)["done"], 1);
  EXPECT_EQ(rowsOf(fleet, results, 0).size(), 4u);
}

TEST(BatchProgram, AJobThatHangsFailsAtItsTime) {
  const SmallFleet fleet(3);
  const std::string results = fleet.world.folder / "results";
  const std::string program = crashingProgram(fleet, "c1.bvh", "sleep 60");
  const Ended ended = fleet.run(results, {"--program", program, "--job-seconds", "20", "--json"});
  EXPECT_EQ(ended.exitCode, 1);
  EXPECT_EQ(Json::parse(ended.out)["done"], 2) << ended.err;
  EXPECT_TRUE(holds(ended.err, "job 2: took longer than 20 s")) << ended.err;
}

TEST(BatchProgram, RefusesWhatIsNoProgramAndNoFolder) {
  const SmallFleet fleet(1);
  const std::string results = fleet.world.folder / "results";
  Ended ended = fleet.run(results, {"--program", "/bin/false"});
  EXPECT_EQ(ended.exitCode, 2);
  EXPECT_TRUE(holds(ended.err, "/bin/false: expected the program foretouch")) << ended.err;
  ended = fleet.run(results, {"--program", "/no/such"});
  EXPECT_EQ(ended.exitCode, 2);
  ended = fleet.run("/proc/none");
  EXPECT_EQ(ended.exitCode, 2);
  EXPECT_TRUE(holds(ended.err, "/proc/none: cannot be made a folder")) << ended.err;
}

TEST(BatchProgram, TwoWorkersOnTheSameJobsDoNoHarm) {
  const SmallFleet fleet(8);
  const std::string alone = fleet.world.folder / "alone", shared = fleet.world.folder / "shared";
  ASSERT_EQ(fleet.run(alone).exitCode, 0);
  ProgramRun first(fleet.words(shared)), second(fleet.words(shared));
  EXPECT_EQ(first.ended().exitCode, 0);
  EXPECT_EQ(second.ended().exitCode, 0);
  EXPECT_EQ(fleet.merged(alone), fleet.merged(shared));
  EXPECT_EQ(filesWith(shared, ".jsonl").size(), 8u);
}

TEST(BatchProgram, KilledAtRandomInstantsItEndsAsIfItHadNotBeen) {
  const SmallFleet fleet(12, {5});
  const std::string alone = fleet.world.folder / "alone", killed = fleet.world.folder / "killed";
  ASSERT_EQ(fleet.run(alone).exitCode, 1);
  std::mt19937 random(7);
  int kills = 0;
  for (; kills < 8; ++kills) {
    ProgramRun run(fleet.words(killed));
    std::this_thread::sleep_for(std::chrono::milliseconds(5 + random() % 200));
    run.send(SIGKILL);
    if (run.ended().signal != SIGKILL) break;  // it was done before
  }
  EXPECT_GT(kills, 0);
  EXPECT_EQ(fleet.run(killed).exitCode, 1);
  EXPECT_EQ(fleet.merged(alone), fleet.merged(killed));
  for (const auto& entry : fs::directory_iterator(killed)) {
    EXPECT_NE(entry.path().filename().string().rfind(".work-", 0), 0u) << "a leftover";
  }
}

TEST(BatchProgram, AnInterruptEndsItsChildrenAndLeavesNothing) {
  const SmallFleet fleet(3);
  const std::string results = fleet.world.folder / "results";
  const std::string program =
      crashingProgram(fleet, "c0.bvh", "echo $$ > " + fleet.world.folder / "id" + "; sleep 60");
  ProgramRun run(fleet.words(results, {"--program", program, "--threads", "1"}));
  const std::string id = fleet.world.folder / "id";
  for (int i = 0; i < 600 && contentOf(id).empty(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  ASSERT_FALSE(contentOf(id).empty());
  run.send(SIGTERM);
  EXPECT_EQ(run.ended().signal, SIGTERM);
  EXPECT_NE(::kill(std::stoi(contentOf(id)), 0), 0) << "the child lives";
  for (const auto& entry : fs::directory_iterator(results)) {
    EXPECT_NE(entry.path().filename().string().rfind(".work-", 0), 0u) << "a leftover";
  }
}

TEST(BatchProgram, AFullDiskEndsTheRunAndRoomLetsItFinish) {
  const SmallFleet fleet(6);
  const std::string alone = fleet.world.folder / "alone", small = fleet.world.folder / "small";
  ASSERT_EQ(fleet.run(alone).exitCode, 0);
  fs::create_directory(small);
  if (::mount("none", small.c_str(), "tmpfs", 0, "size=64k") != 0) {
    GTEST_SKIP() << "no file system can be mounted here";
  }
  fleet.world.folder.write("small/ballast", std::string(std::size_t{52} << 10, 'x'));
  const Ended full = fleet.run(small, {"--threads", "1"});
  EXPECT_EQ(full.exitCode, 2);
  EXPECT_TRUE(holds(full.err, "No space left on device")) << full.err;
  EXPECT_FALSE(holds(full.err, "job ")) << full.err;  // it is no job's fault
  fs::remove(small + "/ballast");
  EXPECT_EQ(::mount("none", small.c_str(), nullptr, MS_REMOUNT, "size=16m"), 0);
  EXPECT_EQ(fleet.run(small).exitCode, 0);
  EXPECT_EQ(fleet.merged(alone), fleet.merged(small));
  EXPECT_EQ(::umount(small.c_str()), 0);
}

TEST(BatchProgram, TheReportHasTheWorstFirst) {
  const SmallFleet fleet(4, {3});
  const std::string results = fleet.world.folder / "results";
  EXPECT_EQ(fleet.run(results, {"--reports"}).exitCode, 1);
  EXPECT_EQ(fleet.run(results, {"--merge"}).exitCode, 1);
  const std::string page = contentOf(results + "/report.html");
  const std::size_t failed = page.find("<td>c3.bvh</td>"), twice = page.find("<td>c2.bvh</td>"),
                    once = page.find("<td>c0.bvh</td>"), none = page.find("<td>c1.bvh</td>");
  EXPECT_LT(failed, twice);
  EXPECT_LT(twice, once);
  EXPECT_LT(once, none);
  EXPECT_EQ(filesWith(results, ".html").size(), 4u) << "three of jobs, and this one";
  EXPECT_TRUE(holds(page, ">report</a>"));
  EXPECT_TRUE(holds(contentOf(results + "/table.csv"), "job,name,state,error,scene,avatar,motion"));
}

TEST(BatchProgram, ListsTheJobsOfAShard) {
  const SmallFleet fleet(5);
  const Ended ended = fleet.run(fleet.world.folder / "none", {"--list", "--shard", "2/2"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_EQ(std::count(ended.out.begin(), ended.out.end(), '\n'), 2);
  EXPECT_TRUE(holds(ended.out, "--scene=wall.obj --avatar=man.json --motion=c1.bvh")) << ended.out;
  EXPECT_FALSE(fs::exists(fleet.world.folder / "none"));
}

}  // namespace
}  // namespace foretouch::test
