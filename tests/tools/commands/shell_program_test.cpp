// tests/tools/commands/shell_program_test.cpp: what a shell gets of the program: completions that
// real shells take, manual pages that man reads, JSON, "-" and --quiet.
#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "network/service/service.h"
#include "tests/support/holds.h"
#include "tests/tools/feet/planted_walk.h"
#include "tests/tools/program_run.h"
#include "tests/tools/small_world.h"
#include "tools/console.h"

namespace foretouch::test {
namespace {

using Json = nlohmann::json;

bool isInstalled(const std::string& program) {
  return ProgramRun({"-c", "command -v " + program}, {}, "", "sh").ended().exitCode == 0;
}

std::vector<std::string> sortedLines(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  std::sort(lines.begin(), lines.end());
  return lines;
}

/// What bash offers for the last of these words, in this folder.
std::vector<std::string> offersOfBash(const TempFolder& folder, const std::string& words) {
  const std::string script = folder.write(
      "try.sh", "cd \"$(dirname \"$0\")\"; source <(\"$1\" completion bash)\nCOMP_WORDS=(" + words +
                    ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _foretouch\n"
                    "for reply in \"${COMPREPLY[@]}\"; do echo \"$reply\"; done\n");
  const Ended ended = ProgramRun({script, FORETOUCH_PROGRAM}, {}, "", "bash").ended();
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_EQ(ended.err, "");
  return sortedLines(ended.out);
}

using Offers = std::vector<std::string>;

TEST(Completion, OffersCommandsOptionsWordsAndFilesInBash) {
  const TempFolder folder;
  folder.write("room.obj", "");
  folder.write("walk.BVH", "");
  folder.write("notes.txt", "");
  EXPECT_EQ(offersOfBash(folder, "foretouch re"), (Offers{"repair", "replay"}));
  EXPECT_EQ(offersOfBash(folder, "foretouch avatar ''"),
            (Offers{"bvh", "check", "colliders", "mesh", "pairs", "urdf"}));
  EXPECT_EQ(offersOfBash(folder, "foretouch avatar check --clip-s"), Offers{"--clip-scale"});
  EXPECT_EQ(offersOfBash(folder, "foretouch replay --fidelity l"), Offers{"link"});
  EXPECT_EQ(offersOfBash(folder, "foretouch serve --fidelity ''"), (Offers{"exact", "link"}));
  EXPECT_EQ(offersOfBash(folder, "foretouch replay --scene ''"), Offers{"room.obj"});
  EXPECT_EQ(offersOfBash(folder, "foretouch replay --motion ''"), Offers{"walk.BVH"});
  EXPECT_EQ(offersOfBash(folder, "foretouch scene check r"), Offers{"room.obj"});
  EXPECT_EQ(offersOfBash(folder, "foretouch replay --place ''"), Offers{});
  EXPECT_EQ(offersOfBash(folder, "foretouch completion f"), Offers{"fish"});
  EXPECT_EQ(offersOfBash(folder, "foretouch help re"), (Offers{"repair", "replay"}));
  // Former names work, and are not offersOfBash.
  EXPECT_EQ(offersOfBash(folder, "foretouch replay --up"), Offers{});
}

TEST(Completion, IsTakenByZsh) {
  if (!isInstalled("zsh")) GTEST_SKIP() << "no zsh here";
  const TempFolder folder;
  const std::string script = folder.write(
      "try.zsh",
      "autoload -U compinit; compinit -u -d \"${0:h}/dump\"\nsource <(\"$1\" completion zsh)\n"
      "_describe() { local list=${@[-1]}; print -l -- ${(P)list} }\n"
      "words=(foretouch avatar ''); CURRENT=3; _foretouch\n");
  const Ended ended = ProgramRun({"-f", script, FORETOUCH_PROGRAM}, {}, "", "zsh").ended();
  EXPECT_EQ(ended.err, "");
  EXPECT_TRUE(holds(ended.out, "check:Measure an avatar")) << ended.out;
  EXPECT_FALSE(holds(ended.out, "replay:")) << ended.out;
}

TEST(Completion, IsTakenByFish) {
  if (!isInstalled("fish")) GTEST_SKIP() << "no fish here";
  const TempFolder folder;
  const std::string script =
      folder.write("try.fish", std::string("\"") + FORETOUCH_PROGRAM +
                                   "\" completion fish | source\n"
                                   "complete -C 'foretouch avatar '\n"
                                   "complete -C 'foretouch replay --fidelity l'\n");
  const Ended ended =
      ProgramRun({"--no-config", script}, {"HOME=" + (folder / ".")}, "", "fish").ended();
  EXPECT_EQ(ended.err, "");
  EXPECT_TRUE(holds(ended.out, "check\tMeasure an avatar")) << ended.out;
  EXPECT_TRUE(holds(ended.out, "\nlink")) << ended.out;
  EXPECT_FALSE(holds(ended.out, "\nserve")) << ended.out;
}

TEST(Completion, RefusesOtherShells) {
  const Ended none = runForetouch({"completion"});
  EXPECT_EQ(none.exitCode, 2);
  EXPECT_TRUE(holds(none.err, "completion: expected a shell: bash, zsh or fish")) << none.err;
  const Ended near = runForetouch({"completion", "bsh"});
  EXPECT_EQ(near.exitCode, 2);
  EXPECT_TRUE(holds(near.err, "did you mean 'bash'")) << near.err;
}

TEST(ManPages, AreOfEveryCommandAndReadByMan) {
  const TempFolder folder;
  ASSERT_EQ(runForetouch({"man", "--folder", folder / "."}).exitCode, 0);
  const auto names = folder.names();
  for (const char* const name :
       {"foretouch.1", "foretouch-replay.1", "foretouch-avatar-check.1", "foretouch-log-info.1",
        "foretouch-completion.1", "foretouch-man.1"}) {
    EXPECT_EQ(names.count(name), 1u) << name;
  }
  EXPECT_EQ(runForetouch({"man", "replay"}).out, contentOf(folder / "foretouch-replay.1"));
  if (!isInstalled("man")) GTEST_SKIP() << "no man here";
  for (const auto& name : names) {
    const Ended read =
        ProgramRun({"--warnings", "-l", folder / name}, {"MANPAGER=cat", "MANWIDTH=200"}, "", "man")
            .ended();
    EXPECT_EQ(read.exitCode, 0) << name;
    EXPECT_EQ(read.err, "") << name;
    EXPECT_TRUE(holds(read.out, "SYNOPSIS")) << name;
  }
}

TEST(ManPages, SayWhatHelpSays) {
  const std::string page = runForetouch({"man", "replay"}).out;
  for (const char* const part : {".TH FORETOUCH\\-REPLAY 1", ".SH INPUT", "\\-\\-clip\\-scale",
                                 "(required)", ".BR foretouch (1)", "contacts.jsonl"}) {
    EXPECT_TRUE(holds(page, part)) << part;
  }
  EXPECT_FALSE(holds(page, "\\-\\-motion\\-up"));
  const std::string program = runForetouch({"man"}).out;
  EXPECT_TRUE(holds(program, ".SH EXIT CODES")) << program;
  const Ended unknown = runForetouch({"man", "replya"});
  EXPECT_EQ(unknown.exitCode, 2);
  EXPECT_TRUE(holds(unknown.err, "did you mean 'replay'?")) << unknown.err;
}

TEST(ExitCodes, AreToldInOnePlaceByHelpAndDocuments) {
  const std::string help = runForetouch({"--help"}).out;
  const std::string document =
      contentOf(std::string(FORETOUCH_SOURCE_DIR) + "/docs/troubleshooting.md");
  for (const tools::ExitMeaning& meaning : tools::kExitMeanings) {
    const std::string code = std::to_string(static_cast<int>(meaning.code));
    EXPECT_TRUE(holds(document, "| " + code + " | " + meaning.text + " |")) << code;
    EXPECT_TRUE(holds(help, "\n  " + code + "   ")) << help;
  }
}

TEST(Help, ShowsTheDefaultsThatHold) {
  const std::string queue = "[" + std::to_string(ServiceOptions().queue) + "]";
  EXPECT_TRUE(holds(runForetouch({"serve", "--help"}).out, queue));
}

TEST(JsonAnswers, SayWhatTheTextsSay) {
  const SmallWorld world;
  const Ended scene = runForetouch({"scene", "check", world.folder / "wall.obj", "--json"});
  ASSERT_EQ(scene.exitCode, 0) << scene.err;
  const Json room = Json::parse(scene.out);
  EXPECT_EQ(room["triangles"], 4);
  EXPECT_EQ(room["objects"].size(), 2u);
  EXPECT_EQ(room["doubts"].size(), 0u);
  const Ended small = runForetouch(
      {"scene", "check", world.folder / "wall.obj", "--scene-scale", "0.001", "--json"});
  EXPECT_EQ(small.exitCode, 1);
  EXPECT_EQ(Json::parse(small.out)["doubts"].size(), 1u);

  const std::string man = world.folder / "man.json", clip = world.folder / "clip.bvh";
  const Json avatar =
      Json::parse(runForetouch({"avatar", "check", man, "--motion", clip, "--json"}).out);
  EXPECT_EQ(avatar["links"], 2);
  EXPECT_EQ(avatar["link_list"][1]["name"], "Arm");
  EXPECT_EQ(avatar["link_list"][1]["parent"], "Hips");
  EXPECT_EQ(avatar["match"]["joints"], 2);
  EXPECT_EQ(avatar["match"]["at_rest"].size(), 0u);

  std::string three = kManAvatar;
  three.insert(three.rfind("\n]}"),
               R"(,
{"name":"Foot","parent":"Hips","offset":[0,-1,0],"lss":[{"a":[0,0,0],"b":[0,0,0],"radius":0.1}]})");
  world.folder.write("three.json", three);
  const Json pairs =
      Json::parse(runForetouch({"avatar", "pairs", world.folder / "three.json", "--json"}).out);
  EXPECT_EQ(pairs["pairs"], 3);
  EXPECT_EQ(pairs["asked"], 1);
  EXPECT_EQ(pairs["left_out"].size(), 2u);
  EXPECT_EQ(pairs["left_out"][0]["reason"], "adjacent");

  const std::string out = world.folder / "out.jsonl", mesh = world.folder / "out.obj";
  const Json replay = Json::parse(runForetouch(world.replay({"-o", out, "--json"})).out);
  EXPECT_EQ(replay["contacts"].get<int>(), 2);
  EXPECT_EQ(replay["missed_by_poses"].get<int>(), 2);
  EXPECT_EQ(replay["output"], out);
  const Json sweep = Json::parse(
      runForetouch({"sweep", "--avatar", man, "--motion", clip, "-o", mesh, "--json"}).out);
  EXPECT_GT(sweep["triangles"].get<int>(), 100);
  EXPECT_EQ(sweep["output"], mesh);

  const std::string log = world.folder / "out.lcmlog";
  const Json converted =
      Json::parse(runForetouch({"log", "convert", clip, "--avatar", man, "-o", log, "--json"}).out);
  EXPECT_EQ(converted["poses"], 4);
  const Json recovered =
      Json::parse(runForetouch({"log", "recover", log, "-o", log + "2", "--json"}).out);
  EXPECT_EQ(recovered["bytes_lost"], 0);
  EXPECT_EQ(recovered["events"], 4 + converted["skeletons"].get<int>());
}

TEST(StandardOutput, TakesEveryOutputThatIsADash) {
  const SmallWorld world;
  const auto before = world.folder.names();
  const std::string man = world.folder / "man.json", clip = world.folder / "clip.bvh";
  const std::string file = world.folder / "out.jsonl";
  const Ended replay = runForetouch(world.replay({"--output", "-"}));
  ASSERT_EQ(replay.exitCode, 0) << replay.err;
  EXPECT_EQ(replay.out.rfind("{\"format\":\"foretouch-results\"", 0), 0u) << replay.out;
  EXPECT_TRUE(holds(replay.err, "steps with contact")) << replay.err;
  const Ended made = runForetouch({"avatar", "bvh", clip, "-o", "-"});
  EXPECT_EQ(Json::parse(made.out)["format"], "foretouch-avatar");
  const Ended swept = runForetouch({"sweep", "--avatar", man, "--motion", clip, "-o", "-"});
  EXPECT_TRUE(holds(swept.out, "\nv ")) << swept.out.substr(0, 200);
  EXPECT_TRUE(holds(swept.err, "triangles")) << swept.err;
  const Ended log =
      runForetouch({"publish", clip, "--avatar", man, "-o", world.folder / "a.lcmlog"});
  ASSERT_EQ(log.exitCode, 0) << log.err;
  const Ended told = runForetouch({"log", "convert", world.folder / "a.lcmlog", "-o", "-"});
  EXPECT_EQ(told.out.front(), '{') << told.err;
  // A log cannot go through a pipe: its end is written at its beginning.
  EXPECT_EQ(runForetouch({"publish", clip, "--avatar", man, "-o", "-"}).exitCode, 2);
  EXPECT_EQ(runForetouch({"avatar", "mesh", clip, "-o", "-"}).exitCode, 2);
  auto expected = before;
  expected.insert("a.lcmlog");
  EXPECT_EQ(world.folder.names(), expected);
}

TEST(StandardOutput, IsAppendedToAsTheShellOpenedIt) {
  const SmallWorld world;
  const std::string kept = world.folder.write("kept.txt", "before\n");
  const Ended ended = ProgramRun({"-c", "\"$0\" avatar bvh \"$1\" -o - >> \"$2\"",
                                  FORETOUCH_PROGRAM, world.folder / "clip.bvh", kept},
                                 {}, "", "sh")
                          .ended();
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_EQ(contentOf(kept).rfind("before\n{", 0), 0u) << contentOf(kept);
}

TEST(Quiet, LeavesOutNotesAndNothingElse) {
  const SmallWorld world;
  const std::vector<std::string> arguments =
      world.replay({"-o", world.folder / "out.jsonl", "--clip-scale", "0.01"});
  std::vector<std::string> quiet = arguments;
  quiet.emplace_back("-q");
  EXPECT_TRUE(holds(runForetouch(arguments).err, "note: "));
  const Ended ended = runForetouch(quiet);
  EXPECT_EQ(ended.exitCode, 0);
  EXPECT_EQ(ended.err, "");
  EXPECT_TRUE(holds(ended.out, "steps with contact")) << ended.out;
  quiet.back() = "--scene-scale=0";
  quiet.emplace_back("--quiet");
  EXPECT_TRUE(holds(runForetouch(quiet).err, "foretouch: --scene-scale: "));
}

std::string withoutDigits(std::string text) {
  text.erase(std::remove_if(text.begin(), text.end(),
                            [](char c) { return (c >= '0' && c <= '9') || c == ' ' || c == '.'; }),
             text.end());
  return text;
}

/// Every line that is no note.
std::string withoutNotes(const std::string& text) {
  std::istringstream lines(text);
  std::string rest;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("note: ", 0) != 0) rest += line + "\n";
  }
  return rest;
}

/// "Usage: foretouch avatar check AVATAR": the words before the arguments of each.
std::set<std::string> commandsOfHelp() {
  std::set<std::string> commands;
  std::istringstream lines(runForetouch({"--help-all"}).out);
  for (std::string line, word; std::getline(lines, line);) {
    if (line.rfind("Usage: foretouch ", 0) != 0 || holds(line, " COMMAND ")) continue;
    std::string command;
    for (std::istringstream words(line.substr(17)); words >> word;) {
      if (word.find_first_not_of("abcdefghijklmnopqrstuvwxyz") != std::string::npos) break;
      command += (command.empty() ? "" : " ") + word;
    }
    commands.insert(command);
  }
  return commands;
}

/// One meaning in every command: no notes, no progress, and all else as it is.
TEST(Quiet, MeansTheSameToEveryCommand) {
  const SmallWorld world;
  const TempFolder& folder = world.folder;
  const std::string wall = folder / "wall.obj", man = folder / "man.json";
  const std::string clip = folder / "clip.bvh", log = folder / "a.lcmlog";
  const std::string out = folder / "out.", shown = folder / "shown.jsonl";
  const std::string stage = folder.write(
      "stage.toml",
      "format = \"foretouch-world\"\nversion = 1\n[scene]\nfile = \"wall.obj\"\n[[body]]\n"
      "name = \"man\"\navatar = \"man.json\"\nclip = { file = \"clip.bvh\" }\n");
  const std::string robot = folder.write(
      "arm.urdf",
      "<robot name='a'><link name='base'><collision><geometry><sphere radius='0.1'/></geometry>"
      "</collision></link></robot>");
  const std::string fleet =
      folder.write("b.batch",
                   "foretouch-batch 1\njob --scene wall.obj --avatar man.json --motion "
                   "clip.bvh\n");
  const std::string walker = folder.write("walker.json", kWalkerAvatar);
  const std::string walk = folder.write("walk.bvh", walkBvh({{}, {}}, {{}, {}}, 0.1));
  ASSERT_EQ(runForetouch({"publish", clip, man, "-o", log}).exitCode, 0);
  ASSERT_EQ(runForetouch(world.replay({"-o", shown, "--solid"})).exitCode, 0);
  const std::vector<std::vector<std::string>> lines{
      {"setup", wall, clip},
      {"view", wall, man, clip, "--clip-scale", "0.01", "-o", out + "html"},
      {"replay", wall, man, clip, "--clip-scale", "0.01", "-o", out + "jsonl"},
      {"feet", walk, walker, "--skip-t-pose"},
      {"repair", walk, walker, "--skip-t-pose", "-o", out + "bvh"},
      {"batch", fleet, "-o", folder / "fleet"},
      {"ask", stage, "--from", "0,0,0", "--radius", "1"},
      {"world", "check", stage},
      {"world", "replay", stage, "-o", out + "jsonl"},
      {"world", "view", stage, "-o", out + "html"},
      {"sweep", man, clip, "-o", out + "ply"},
      {"certify", wall, man, clip, "-o", folder / "proof"},
      {"avatar", "bvh", clip, "-o", out + "json"},
      {"avatar", "mesh", wall, "-o", out + "json"},
      {"avatar", "urdf", robot, "-o", out + "json"},
      {"avatar", "check", man},
      {"avatar", "colliders", man, "-o", out + "glb"},
      {"avatar", "pairs", FORETOUCH_EXAMPLE_FOLDER "/dancer.avatar.json"},
      {"scene", "check", wall},
      {"scene", "bake", wall, "-o", out + "ftscene"},
      {"log", "info", log},
      {"log", "check", log},
      {"log", "recover", log, "-o", out + "lcmlog"},
      {"log", "convert", log, "-o", out + "bvh"},
      {"log", "replay", log, "--world", stage},
      {"solid", "check", shown},
      {"bounds", "learn", FORETOUCH_EXAMPLE_FOLDER "/dancer.bvh", "--rates", "10", "-o",
       out + "bounds.json"}};
  // Until they are stopped, on a network, of the bundled example, or without an input.
  std::set<std::string> seen{"serve",      "listen", "demo", "publish",
                             "completion", "help",   "man",  "version"};
  const std::set<std::string> all = commandsOfHelp();
  for (std::vector<std::string> line : lines) {
    std::string command = line[0];
    if (all.count(command) == 0) command += " " + line[1];
    seen.insert(command);
    const auto run = [&] {
      std::filesystem::remove(out + "lcmlog");
      std::filesystem::remove_all(folder / "fleet");
      return runForetouch(line);
    };
    const Ended loud = run();
    line.emplace_back("-q");
    const Ended quiet = run();
    EXPECT_EQ(quiet.exitCode, loud.exitCode) << command << ": " << quiet.err;
    EXPECT_EQ(quiet.err, withoutNotes(loud.err)) << command;
    EXPECT_EQ(withoutDigits(quiet.out), withoutDigits(loud.out)) << command;
    EXPECT_NE(loud.exitCode, 2) << command << ": " << loud.err;
  }
  EXPECT_EQ(seen, all);
}

/// The scripts with a build that is there already, of a program that says where it is.
TEST(Run, StaysInTheFolderWhereTheUserIs) {
  const TempFolder project, elsewhere;
  project.script("cmake", "echo built >>\"$(dirname \"$0\")/builds\"");
  std::filesystem::create_directories(project / "build/release/bin");
  project.write("build/release/build.ninja", "");
  project.write("build/release/CMakeCache.txt", "FORETOUCH_BENCH:BOOL=ON\n");
  project.script("build/release/bin/foretouch", "pwd -P; echo \"$@\"");
  const std::string source = FORETOUCH_SOURCE_DIR;
  std::filesystem::copy_file(source + "/run", project / "run");
  std::filesystem::copy(source + "/dev", project / "dev");
  const std::string command = "cd '" + elsewhere.path() + "' && PATH='" + project.path() +
                              "':\"$PATH\" '" + (project / "run") +
                              "' foretouch avatar bvh 'a b.bvh'";
  const Ended ended = ProgramRun({"-c", command}, {}, "", "sh").ended();
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_EQ(ended.err, "");
  EXPECT_EQ(ended.out,
            std::filesystem::canonical(elsewhere.path()).string() + "\navatar bvh a b.bvh\n");
  EXPECT_EQ(contentOf(project / "builds"), "built\n");
}

TEST(Rate, SaysWhatItTakesWhereNoWholeNumberOfFramesGivesIt) {
  const SmallWorld world;  // 10 poses a second
  const auto errorsAt = [&](const char* rate) {
    return runForetouch(world.replay({"-o", world.folder / "out.jsonl", "--rate", rate})).err;
  };
  EXPECT_EQ(errorsAt("5"), "");
  EXPECT_TRUE(holds(errorsAt("4"),
                    "--rate 4: takes one frame in 3 of a clip of 10 a second: "
                    "3.3333 poses a second, 16.7 % fewer than asked"))
      << errorsAt("4");
  EXPECT_TRUE(holds(errorsAt("7"),
                    "10 poses a second, 42.9 % more than asked; --rate 5 would be "
                    "at most as many"))
      << errorsAt("7");
}

TEST(UnitOfAClip, IsOfferedOnlyWhereEnoughJointsMatch) {
  const SmallWorld world;
  const auto noteOf = [&](const std::string& avatar) {
    return runForetouch(world.replay({"-o", world.folder / "out.jsonl", "--clip-scale", "0.01"},
                                     "wall.obj", avatar))
        .err;
  };
  EXPECT_TRUE(holds(noteOf("man.json"), "is --clip-scale right? 100 times as much would fit"))
      << noteOf("man.json");
  std::string many = kManAvatar;
  for (const char* const name : {"A", "B", "C"}) {
    many.insert(many.rfind("\n]}"), std::string(",\n{\"name\":\"") + name +
                                        R"(","parent":"Arm","offset":[0,0.3,0],"lss":[]})");
  }
  world.folder.write("many.json", many);
  EXPECT_TRUE(holds(noteOf("many.json"), "by the 2 of 5 joints that match; does --map say"))
      << noteOf("many.json");
}

TEST(Links, AreListedAndAMisspeltOneIsToldWhere) {
  const SmallWorld world;
  const std::string man = world.folder / "man.json";
  const Ended listed = runForetouch({"avatar", "check", man, "--links"});
  EXPECT_TRUE(holds(listed.out, "\nArm                             Hips")) << listed.out;
  const std::string mesh = world.folder / "out.obj";
  const Ended near = runForetouch({"sweep", "--avatar", man, "--motion", world.folder / "clip.bvh",
                                   "--links", "Amr", "-o", mesh});
  EXPECT_EQ(near.exitCode, 2);
  EXPECT_TRUE(holds(near.err, "no link is called 'Amr'")) << near.err;
  EXPECT_TRUE(holds(near.err, "foretouch avatar check --links lists all")) << near.err;
  const Ended swept =
      runForetouch({"sweep", "--avatar", man, "--motion", world.folder / "clip.bvh", "-o", mesh});
  EXPECT_TRUE(holds(swept.out, "\nmesh: " + mesh + "\n")) << swept.out;
}

}  // namespace
}  // namespace foretouch::test
