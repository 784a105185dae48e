#include "tools/solid/solid_command.h"

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "assets/avatar/avatar_file.h"
#include "assets/json_writer.h"
#include "tools/inputs/replay_inputs.h"
#include "tools/json_line.h"
#include "tools/progress.h"
#include "tools/settings/file_mark.h"
#include "tools/solid/solid_check.h"
#include "tools/solid/solid_reader.h"

namespace foretouch::tools {
namespace {

/// The values of all options.
struct AskedSolidCheck {
  std::string output, scene, avatar;
  bool asJson = false;
};

/// The file that the header names: as asked, else beside the output, else in the current folder.
/// Errors: it is not there, or another one than that of the header.
Result<std::string> fileOf(const char* option, const std::string& asked, const std::string& name,
                           const std::string& mark, const std::string& output) {
  namespace fs = std::filesystem;
  std::string path = asked;
  if (path.empty()) {
    // In a hostile file: a name, not a way to some other folder.
    const std::string plain = fs::path(name).filename().string();
    const fs::path beside = fs::path(output).parent_path() / plain;
    std::error_code absent;
    path = fs::exists(beside, absent) ? beside.string() : plain;
  }
  const auto found = markOfFile(path);
  if (!found.ok()) {
    return Error::in(
        output, ErrorCode::FileNotFound,
        fmt::format("names {}, which is neither beside it nor here: {} FILE says where "
                    "it is",
                    inQuotes(name), option));
  }
  if (found.value() == mark) return path;
  return Error::in(path, ErrorCode::Mismatch,
                   fmt::format("is not the file that {} was made with: expected the mark {}, found "
                               "{}",
                               inQuotes(output), mark, found.value()));
}

Result<Done> checkLinks(const SolidHeader& header, const Avatar& avatar, const std::string& path) {
  std::vector<std::string> names;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    names.push_back(avatar.skeleton().name(link));
  }
  if (names == header.links) return Done{};
  return Error{ErrorCode::Mismatch, path, 1, -1, "links: expected those of its avatar, in order"};
}

/// The finding about the file as a whole, once its ticks are judged.
void judgeEnd(const SolidReader& reader, CheckedSolid& checked) {
  if (checked.finding) return;
  if (checked.ticks != reader.header().ticks) {
    checked.finding = SolidFinding{-1, 0,
                                   fmt::format("expected {} ticks, as the first line says, found "
                                               "{}",
                                               reader.header().ticks, checked.ticks)};
  } else if (!reader.isComplete()) {
    checked.finding = SolidFinding{-1, 0, "expected a true summary as its last line"};
  }
}

Result<CheckedSolid> checkedFile(const AskedSolidCheck& asked) {
  FORETOUCH_TRY(auto reader, SolidReader::open(asked.output));
  const SolidHeader& header = reader.header();
  if (!reader.isHeaderMarkTrue()) {
    CheckedSolid checked;
    checked.finding =
        SolidFinding{-1, 1, "the first line is not the one that was written: its mark is another"};
    return checked;
  }
  WorldRequest world;
  FORETOUCH_TRY(world.scenePath,
                fileOf("--scene", asked.scene, header.scene, header.sceneMark, asked.output));
  FORETOUCH_TRY(const auto avatarPath,
                fileOf("--avatar", asked.avatar, header.avatar, header.avatarMark, asked.output));
  world.sceneImport.scale = header.sceneScale;
  world.sceneImport.up = header.sceneUp;
  FORETOUCH_TRY(const auto scene, loadScene(world));
  FORETOUCH_TRY(const auto avatar, readAvatarFile(avatarPath));
  FORETOUCH_CHECK(checkLinks(header, avatar, asked.output));
  FORETOUCH_TRY(const auto query, queryOf(header, avatar, scene, asked.output));
  FORETOUCH_TRY(auto check,
                inFile(SolidCheck::build(avatar, scene, query, header.tolerance), asked.output));
  ProgressBar progress("solid check", header.ticks);
  for (;;) {
    FORETOUCH_TRY(const auto record, reader.next());
    if (!record || !check.take(*record)) break;
    progress.advanceTo(check.checked().ticks);
  }
  judgeEnd(reader, check.checked());
  return check.checked();
}

std::string jsonOf(const AskedSolidCheck& asked, const CheckedSolid& checked) {
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  out.field("output", asked.output);
  out.field("sound", checked.isSound());
  out.field("ticks", checked.ticks);
  out.field("certified", checked.certified);
  out.field("not_certified", checked.notCertified);
  out.field("motions", checked.motions);
  out.field("begins", checked.begins);
  out.field("least_tolerance", checked.leastTolerance);
  if (checked.finding) {
    writeObject("finding", out, [&] {
      if (checked.finding->tick >= 0) out.field("tick", checked.finding->tick);
      if (checked.finding->line > 0) out.field("line", checked.finding->line);
      out.field("text", checked.finding->text);
    });
  }
  out.endObject();
  return text + "\n";
}

std::string inWords(const AskedSolidCheck& asked, const CheckedSolid& checked) {
  return fmt::format(
      "{}: sound. {} of {} ticks are certified, and so they are again: {} motions touch nothing, "
      "asked with tolerances down to {:.3g} m\n",
      asked.output, checked.certified, checked.ticks, checked.motions, checked.leastTolerance);
}

ExitCode checkSolidFile(const AskedSolidCheck& asked) {
  FORETOUCH_TRY_OR(failed, const auto checked, checkedFile(asked));
  if (asked.asJson) printOut(jsonOf(asked, checked));
  if (checked.isSound()) {
    if (!asked.asJson) printOut(inWords(asked, checked));
    return ExitCode::Done;
  }
  if (!asked.asJson) {
    const SolidFinding& finding = *checked.finding;
    const std::string place = finding.line > 0 ? fmt::format(":{}", finding.line) : "";
    const std::string tick = finding.tick >= 0 ? fmt::format("tick {}: ", finding.tick) : "";
    printError(asked.output + place + ": " + tick + finding.text);
  }
  return ExitCode::CheckSaysNo;
}

Command checkCommand() {
  const auto asked = std::make_shared<AskedSolidCheck>();
  Settings settings;
  settings.path("OUTPUT", "", asked->output, "Shown poses, as foretouch replay --solid writes them")
      .files("jsonl")
      .required("a file of shown poses");
  settings
      .path("--scene", "FILE", asked->scene,
            "The scene that it names; not given: beside it, or in the current folder")
      .files();
  settings
      .path("--avatar", "FILE", asked->avatar,
            "The avatar that it names; not given: beside it, or in the current folder")
      .files("json");
  settings.asJson(asked->asJson);
  Command command{"check", "Certify every recorded way once more, from the file alone",
                  R"(Example:
  foretouch solid check shown.jsonl

Asks each motion of each way again, with a smaller tolerance and without any solver, and checks that
the ways make one curve. Exit code 1 names the first tick that is not what it says.)",
                  std::move(settings)};
  command.run = [asked](const Settings&) { return checkSolidFile(*asked); };
  return command;
}

}  // namespace

Command solidCommand() {
  Command command{"solid", "Check recorded poses of a solid avatar"};
  command.commands.push_back(checkCommand());
  return command;
}

}  // namespace foretouch::tools
