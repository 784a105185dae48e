// Manifests of `foretouch batch`: which jobs they mean, and what is refused, where.
#include "tools/batch/manifest.h"

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/holds.h"
#include "tests/support/temp_folder.h"
#include "tools/batch/job_name.h"
#include "tools/batch/job_record.h"
#include "tools/batch/manifest_words.h"
#include "tools/commands/replay_command.h"
#include "tools/settings/file_mark.h"

namespace foretouch::test {
namespace {

using namespace foretouch::tools;
using Words = std::vector<std::string>;

constexpr char kFirst[] = "foretouch-batch 1\n";
constexpr char kWhole[] = "foretouch-batch 1\nall --scene s.obj --avatar a.json\n";

Result<BatchManifest> parsed(const std::string& text, const std::string& path = "jobs.batch") {
  Command replay = replayCommand();
  return parseManifest(text, path, replay.settings);
}

std::string errorOf(const std::string& text) {
  const auto manifest = parsed(text);
  return manifest.ok() ? "none" : describe(manifest.error());
}

std::vector<Words> jobsOf(const std::string& text, const std::string& path = "jobs.batch") {
  const auto manifest = parsed(text, path);
  EXPECT_TRUE(manifest.ok()) << (manifest.ok() ? "" : describe(manifest.error()));
  std::vector<Words> jobs;
  if (!manifest.ok()) return jobs;
  for (const BatchJob& job : manifest.value().jobs) jobs.push_back(job.words());
  return jobs;
}

TEST(BatchManifest, AJobIsTheWordsOfAReplay) {
  const auto jobs = jobsOf(
      "# dances\n\nforetouch-batch 1\n"
      "job --scene room.obj --avatar=a.json --motion 'my clip.bvh' --rate 10 --self "
      "--ignore \"*:floor\" --ignore L  # the rest is a remark\n");
  ASSERT_EQ(jobs.size(), 1u);
  EXPECT_EQ(jobs[0], (Words{"--scene=room.obj", "--avatar=a.json", "--motion=my clip.bvh",
                            "--rate=10", "--ignore=*:floor", "--ignore=L", "--self"}));
}

TEST(BatchManifest, RepeatedOptionsMakeEveryCombination) {
  const auto jobs = jobsOf(std::string(kWhole) +
                           "job --motion x.bvh --motion y.bvh --tolerance 0.001 --tolerance 0.01\n"
                           "job --motion z.bvh --scene other.obj\n");
  ASSERT_EQ(jobs.size(), 5u);
  const Words expected[] = {
      {"--scene=s.obj", "--avatar=a.json", "--motion=x.bvh", "--tolerance=0.001"},
      {"--scene=s.obj", "--avatar=a.json", "--motion=x.bvh", "--tolerance=0.01"},
      {"--scene=s.obj", "--avatar=a.json", "--motion=y.bvh", "--tolerance=0.001"},
      {"--scene=s.obj", "--avatar=a.json", "--motion=y.bvh", "--tolerance=0.01"},
      {"--scene=other.obj", "--avatar=a.json", "--motion=z.bvh"}};
  for (std::size_t i = 0; i < jobs.size(); ++i) EXPECT_EQ(jobs[i], expected[i]) << i;
}

TEST(BatchManifest, PatternsStandForFilesInTheOrderOfTheirBytes) {
  const TempFolder folder;
  for (const char* const name : {"b.bvh", "a.bvh", "B.bvh", "c.txt", "[x].bvh"}) {
    folder.write(name, "");
  }
  const std::string path = folder.write("jobs.batch", "");
  const auto jobs = jobsOf(std::string(kWhole) +
                               "job --motion *.bvh\njob --motion [x].bvh\n"
                               "job --motion [ab].bvh\n",
                           path);
  ASSERT_EQ(jobs.size(), 7u);
  const std::string motions[] = {"B.bvh",   "[x].bvh", "a.bvh", "b.bvh",
                                 "[x].bvh",  // a file of this name is no pattern
                                 "a.bvh",   "b.bvh"};
  for (std::size_t i = 0; i < jobs.size(); ++i) EXPECT_EQ(jobs[i][2], "--motion=" + motions[i]);
}

TEST(BatchManifest, RefusesWithLineAndExpectation) {
  const struct {
    std::string text, error;
  } cases[] = {
      {"", "jobs.batch: expected the line foretouch-batch 1 first"},
      {kFirst, "jobs.batch: expected at least one line that begins with job"},
      {"foretouch-batch 2\n", "jobs.batch:1: expected the line foretouch-batch 1 first, found"},
      {"job --motion x\n", "jobs.batch:1: expected the line foretouch-batch 1 first"},
      {std::string(kWhole) + "jab --motion x\n", "jobs.batch:3: expected job or all, found 'jab'"},
      {std::string(kWhole) + "job\n", "jobs.batch:3: expected --motion in each job"},
      {std::string(kWhole) + "job --motion\n", "jobs.batch:3: --motion: expected a value"},
      {std::string(kWhole) + "job --motin x\n", "did you mean '--motion'"},
      {std::string(kWhole) + "job x.bvh\n", "jobs.batch:3: expected an option of foretouch replay"},
      {std::string(kWhole) + "job --motion x --rate fast\n", "jobs.batch:3: --rate: expected"},
      {std::string(kWhole) + "job --motion x --rate -1\n", "jobs.batch:3: --rate: expected"},
      {std::string(kWhole) + "job --motion x --self=1\n", "--self: expected no value"},
      {std::string(kWhole) + "job --motion x --output y\n", "--output: expected none here"},
      {std::string(kWhole) + "job --motion x -o y\n", "--output: expected none here"},
      {std::string(kWhole) + "job --motion x --threads 4\n", "--threads: expected none here"},
      {std::string(kWhole) + "job --motion x --leaves cubics\n", "is gone"},
      {std::string(kWhole) + "job --motion none/*.bvh\n",
       "jobs.batch:3: --motion: expected a file like 'none/*.bvh', found none"},
      {std::string(kWhole) + "job --motion 'x\n", "jobs.batch:3: expected a second '"},
      {std::string(kWhole) + std::string("job --motion x\0y\n", 17), "no control characters"},
      {std::string(kWhole) + "job --motion \x1b[2J\n", "no control characters"},
      {std::string(kWhole) + "job --motion " + std::string(70000, 'x') + "\n",
       "jobs.batch:3: expected at most 65536 bytes in a line"},
  };
  for (const auto& one : cases) {
    EXPECT_TRUE(holds(errorOf(one.text), one.error)) << errorOf(one.text) << "\n" << one.error;
  }
}

TEST(BatchManifest, RefusesMoreJobsThanAMillion) {
  std::string line = "job --motion x";
  for (int i = 0; i < 101; ++i) line += " --tolerance 0.0" + std::to_string(100 + i);
  for (int i = 0; i < 100; ++i) line += " --rate " + std::to_string(i + 1);
  for (int i = 0; i < 100; ++i) line += " --clip-scale " + std::to_string(i + 1);
  EXPECT_TRUE(holds(errorOf(kWhole + line + "\n"), "jobs.batch:3: expected at most 1000000 jobs"))
      << errorOf(kWhole + line);
}

/// A folder with a scene, an avatar with a mesh, and clips.
struct NamedFiles {
  NamedFiles() {
    folder.write("s.obj", "v 0 0 0\n");
    folder.write("a.json", R"({"mesh":{"file":"body.glb"}})");
    folder.write("body.glb", "triangles");
    folder.write("x.bvh", "HIERARCHY");
  }
  [[nodiscard]] std::string nameOf(const std::string& words, const std::string& version = "1") {
    FileMarks marks(folder.path());
    const auto manifest = parsed(kWhole + ("job " + words + "\n"), folder / "jobs.batch");
    EXPECT_TRUE(manifest.ok());
    return jobName(manifest.value().jobs.front(), version, marks);
  }
  TempFolder folder;
};

TEST(JobName, DependsOnAllThatTheResultDependsOn) {
  NamedFiles files;
  const std::string name = files.nameOf("--motion x.bvh");
  EXPECT_EQ(name.size(), 32u);
  EXPECT_EQ(files.nameOf("--motion x.bvh --tolerance 1e-3"), name) << "as by default";
  EXPECT_EQ(files.nameOf("--rate 10 --motion x.bvh"), files.nameOf("--motion=x.bvh --rate 10.0"));
  EXPECT_NE(files.nameOf("--motion x.bvh --rate 10"), name);
  EXPECT_NE(files.nameOf("--motion x.bvh --self"), name);
  EXPECT_NE(files.nameOf("--motion x.bvh --ignore L"), name);
  EXPECT_NE(files.nameOf("--motion x.bvh", "2"), name);
  EXPECT_NE(files.nameOf("--motion gone.bvh"), name);
  files.folder.write("x.bvh", "HIERARCHZ");
  EXPECT_NE(files.nameOf("--motion x.bvh"), name);
  files.folder.write("x.bvh", "HIERARCHY");
  EXPECT_EQ(files.nameOf("--motion x.bvh"), name);
  files.folder.write("body.glb", "trianglez");  // which the avatar names
  EXPECT_NE(files.nameOf("--motion x.bvh"), name);
}

TEST(JobName, OneCacheSeesThatAFileHasChanged) {
  NamedFiles files;
  FileMarks marks(files.folder.path());
  const std::string before = marks.of("a.json");
  EXPECT_EQ(marks.of("a.json"), before);
  files.folder.write("body.glb", "other triangles");
  EXPECT_NE(marks.of("a.json"), before);
}

TEST(JobName, FilesNamedInATextAreFound) {
  EXPECT_EQ(namesIn(R"({"uri": "a.bin", "file": "m/b.obj", "name": "hips", "u": "a.bin"})"),
            (Words{"a.bin", "m/b.obj"}));
  EXPECT_EQ(namesIn("<mesh filename=\"package://panda/meshes/hand.stl\"/>"),
            (Words{"meshes/hand.stl"}));
  EXPECT_EQ(namesIn("\"unended.bin"), Words{});
}

TEST(JobRecord, EveryDamageMakesItNoRecord) {
  JobRecord record;
  record.name = std::string(32, 'a');
  record.isDone = true;
  record.mark = "0123456789abcdef";
  record.summary = R"({"steps":4})";
  const std::string line = recordLine(record);
  const auto read = parseRecord(line, record.name);
  ASSERT_TRUE(read.has_value());
  EXPECT_TRUE(read->isDone);
  EXPECT_EQ(read->mark, record.mark);
  EXPECT_EQ(read->summary, record.summary);
  EXPECT_FALSE(parseRecord(line, std::string(32, 'b')).has_value()) << "another job's";
  for (std::size_t end = 0; end < line.size(); ++end) {
    EXPECT_FALSE(parseRecord(line.substr(0, end), record.name).has_value()) << end;
  }
  for (std::size_t i = 0; i < line.size(); ++i) {
    std::string damaged = line;
    damaged[i] = static_cast<char>(damaged[i] ^ 1);
    EXPECT_FALSE(parseRecord(damaged, record.name).has_value()) << i;
  }
}

/// Workers whose results differ, as those of two runs do: their file's name stands in them.
TEST(JobRecord, OfWorkersAtOneJobOnePutsItsResultsAndTheRecordOfThem) {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "aa");
  const ResultFolder results(folder.path());
  constexpr int kRounds = 200, kWorkers = 4;
  for (int round = 0; round < kRounds; ++round) {
    const std::string name = "aa" + std::to_string(round);
    std::atomic<int> placed = 0;
    std::vector<std::thread> workers;
    for (int worker = 0; worker < kWorkers; ++worker) {
      const std::string scratch = folder / ("scratch" + std::to_string(worker));
      std::filesystem::create_directory(scratch);
      JobRecord record;
      record.name = name;
      record.isDone = true;
      record.summary = R"({"steps":4})";
      record.mark =
          markOfFile(folder.write("scratch" + std::to_string(worker) + "/" + name + ".jsonl",
                                  "worker " + std::to_string(worker)))
              .value();
      workers.emplace_back([&results, &placed, record, scratch] {
        const auto put = results.put(record, scratch, {".jsonl"});
        EXPECT_TRUE(put.ok());
        placed += put.ok() && put.value() ? 1 : 0;
      });
    }
    for (std::thread& worker : workers) worker.join();
    EXPECT_EQ(placed, 1) << round;
    const auto found = results.find(name);
    ASSERT_TRUE(found.has_value()) << round;
    EXPECT_TRUE(found->isDone);
  }
}

TEST(JobRecord, ASummaryKeepsWhatASecondRunRepeats) {
  EXPECT_EQ(lastingSummary(R"({"motion":"/a/x.bvh","steps":3,"rate":0.1,"latency_us":{"p50":1.5},)"
                           R"("threads":1,"output":"o"})"),
            R"({"steps":3,"rate":0.1})");
  EXPECT_FALSE(lastingSummary("").has_value());
  EXPECT_FALSE(lastingSummary("[1]").has_value());
  EXPECT_FALSE(lastingSummary("note\n{}").has_value());
}

}  // namespace
}  // namespace foretouch::test
