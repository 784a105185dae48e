// Whoever reads or writes a file by its path names that path in the error: no caller has to add it.
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "assets/avatar/avatar_file.h"
#include "assets/bvh/bvh_reader.h"
#include "assets/import/model_import.h"
#include "assets/import/scene_import.h"
#include "assets/text_file.h"
#include "network/log/event_log.h"
#include "network/service/journal.h"
#include "tests/support/temp_folder.h"

namespace foretouch {
namespace {

using test::TempFolder;
using Attempt = std::function<Error(const std::string&)>;

template <typename Read>
Attempt errorOf(Read read) {
  return [read](const std::string& path) {
    const auto result = read(path);
    return result.ok() ? Error::of(ErrorCode::Syntax, "no error") : result.error();
  };
}

Avatar oneLink() {
  RawSkeleton raw;
  raw.joints.emplace_back().name = "root";
  return Avatar::build(Skeleton::build(raw).value(), {{Lss{{0, 0, 0}, {0, 1, 0}, 0.1}}}).value();
}

std::vector<std::pair<const char*, Attempt>> readers() {
  return {
      {"readWholeFile", errorOf([](const std::string& path) { return readWholeFile(path, 9); })},
      {"readAvatarFile", errorOf([](const std::string& path) { return readAvatarFile(path); })},
      {"readBvhFile", errorOf([](const std::string& path) { return readBvhFile(path, {}); })},
      {"importModel", errorOf([](const std::string& path) { return importModel(path, {}); })},
      {"importScene", errorOf([](const std::string& path) { return importScene(path, {}); })},
      {"EventLogReader::open",
       errorOf([](const std::string& path) { return EventLogReader::open(path); })},
  };
}

TEST(ErrorPlaces, AReaderNamesTheFileThatIsNotThere) {
  const TempFolder folder;
  const std::string path = folder / "missing.file";
  for (const auto& [name, attempt] : readers()) EXPECT_EQ(attempt(path).file, path) << name;
}

TEST(ErrorPlaces, AReaderNamesTheFileThatIsGarbage) {
  const TempFolder folder;
  const std::string path = folder.write("garbage.obj", "0123456789 no format of ours");
  for (const auto& [name, attempt] : readers()) EXPECT_EQ(attempt(path).file, path) << name;
}

TEST(ErrorPlaces, AWriterNamesTheFileThatItCannotWrite) {
  const TempFolder folder;
  const std::string path = folder / "no/such/folder/file";
  const std::vector<std::pair<const char*, Attempt>> writers = {
      {"PendingFile", errorOf([](const std::string& to) { return PendingFile::create(to); })},
      {"writeAvatarFile",
       errorOf([](const std::string& to) { return writeAvatarFile(oneLink(), to); })},
      {"EventLogWriter", errorOf([](const std::string& to) { return EventLogWriter::create(to); })},
      {"createLogSink", errorOf([](const std::string& to) { return createLogSink(to); })},
  };
  for (const auto& [name, attempt] : writers) EXPECT_EQ(attempt(path).file, path) << name;
}

}  // namespace
}  // namespace foretouch
