#include "assets/text_file.h"

#include <filesystem>
#include <set>
#include <string>

#include "tests/assets/files_in_folder.h"

namespace foretouch {
namespace {

namespace fs = std::filesystem;

using test::readBack;
using test::writeText;
using ReadWholeFile = test::FilesInFolder;
using PendingFileTest = test::FilesInFolder;

TEST_F(ReadWholeFile, ReadsEveryByte) {
  const std::string text("a\0b\r\n\xff", 6);
  writeText(file("f"), text);
  EXPECT_EQ(readBack(file("f")), text);
  writeText(file("empty"), "");
  EXPECT_EQ(readBack(file("empty")), "");
}

TEST_F(ReadWholeFile, RefusesWhatIsMissingOrNoFileOrTooLarge) {
  EXPECT_EQ(readWholeFile(file("none"), 10).error().code, ErrorCode::FileNotFound);
  EXPECT_EQ(readWholeFile(folder_.path(), 10).error().code, ErrorCode::FileUnreadable);
  writeText(file("ten"), "0123456789");
  EXPECT_EQ(readWholeFile(file("ten"), 9).error().code, ErrorCode::LimitExceeded);
  EXPECT_TRUE(readWholeFile(file("ten"), 10).ok());
}

TEST_F(PendingFileTest, AppearsOnlyWithCommit) {
  auto pending = PendingFile::create(file("out"));
  ASSERT_TRUE(pending.ok());
  pending.value().write("one ");
  pending.value().write("two");
  EXPECT_FALSE(fs::exists(file("out")));
  ASSERT_TRUE(pending.value().commit().ok());
  EXPECT_EQ(readBack(file("out")), "one two");
  EXPECT_EQ(names(), std::set<std::string>{"out"});
}

TEST_F(PendingFileTest, DroppedItLeavesNothingAndTheOldFileStands) {
  writeText(file("out"), "old");
  {
    auto pending = PendingFile::create(file("out"));
    ASSERT_TRUE(pending.ok());
    pending.value().write(std::string(3u << 20, 'x'));  // beyond its buffer: part is on the disk
    EXPECT_EQ(names().size(), 2u);
  }
  EXPECT_EQ(names(), std::set<std::string>{"out"});
  EXPECT_EQ(readBack(file("out")), "old");
}

TEST_F(PendingFileTest, MovedFromItOwnsNothing) {
  auto pending = PendingFile::create(file("out"));
  ASSERT_TRUE(pending.ok());
  {
    PendingFile moved = std::move(pending).value();
    moved.write("x");
    ASSERT_TRUE(moved.commit().ok());
  }
  EXPECT_EQ(readBack(file("out")), "x");
}

TEST_F(PendingFileTest, SaysWhyAFolderOrAMissingOneCannotBeWritten) {
  EXPECT_EQ(PendingFile::create(folder_.path()).error().code, ErrorCode::FileUnwritable);
  const auto missing = PendingFile::create(file("none/out"));
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.error().code, ErrorCode::FileUnwritable);
  EXPECT_EQ(missing.error().file, file("none/out"));
  EXPECT_TRUE(names().empty());
}

TEST(IsUtf8, KnowsTheBoundsOfTheStandard) {
  for (const char* good :
       {"", "a", "\xc2\x80", "\xdf\xbf", "\xe0\xa0\x80", "\xed\x9f\xbf", "\xee\x80\x80",
        "\xef\xbf\xbf", "\xf0\x90\x80\x80", "\xf4\x8f\xbf\xbf"}) {
    EXPECT_TRUE(isUtf8(good)) << good;
  }
  for (const char* bad : {"\x80", "\xc0\x80", "\xc1\xbf", "\xc2", "\xc2\x7f", "\xe0\x9f\xbf",
                          "\xe0\xa0", "\xed\xa0\x80", "\xf0\x8f\xbf\xbf", "\xf4\x90\x80\x80",
                          "\xf5\x80\x80\x80", "\xff", "a\xe2\x82"}) {
    EXPECT_FALSE(isUtf8(bad)) << bad;
  }
}

TEST(InQuotes, ShowsTextAndHidesWhatDrivesTerminals) {
  EXPECT_EQ(inQuotes("Left Arm"), "'Left Arm'");
  EXPECT_EQ(inQuotes("\xc3\xa0"), "'\xc3\xa0'");
  EXPECT_EQ(inQuotes("\x1b[0m\xff\xc2\x9b"), "'\\x1b[0m\\xff\\xc2\\x9b'");
  EXPECT_EQ(inQuotes(std::string_view("\0", 1)), "'\\x00'");
}

TEST(InQuotes, CutsLongTextBetweenLetters) {
  const std::string cut = inQuotes(std::string(47, 'x') + "\xc3\xa0zzz");
  EXPECT_EQ(cut, "'" + std::string(47, 'x') + "\xc3\xa0...'");
  EXPECT_EQ(inQuotes(std::string(48, 'x')), "'" + std::string(48, 'x') + "'");
}

}  // namespace
}  // namespace foretouch
