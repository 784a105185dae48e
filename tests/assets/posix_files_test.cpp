// Files as POSIX has them: pipes, links, permissions, devices, other users.
#include <filesystem>
#include <string>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/assets/files_in_folder.h"

namespace foretouch {
namespace {

namespace fs = std::filesystem;

using test::readBack;
using test::writeText;
using ReadPosixFile = test::FilesInFolder;
using PendingPosixFile = test::FilesInFolder;

TEST_F(ReadPosixFile, DoesNotWaitForAPipe) {
  EXPECT_EQ(readWholeFile("/dev/zero", 10).error().code, ErrorCode::FileUnreadable);
  ASSERT_EQ(::mkfifo(file("pipe").c_str(), 0600), 0);
  if (!fs::is_fifo(file("pipe"))) GTEST_SKIP() << "no pipes here";
  EXPECT_EQ(readWholeFile(file("pipe"), 10).error().code, ErrorCode::FileUnreadable);
}

TEST_F(ReadPosixFile, LimitHoldsForFilesThatStateNoSize) {
  // A file in /proc states a size of 0 whatever it holds.
  EXPECT_EQ(readWholeFile("/proc/self/status", 10).error().code, ErrorCode::LimitExceeded);
  EXPECT_GT(readBack("/proc/self/status").size(), 10u);
}

TEST_F(PendingPosixFile, ReplacesAndKeepsPermissions) {
  writeText(file("out"), "old");
  ASSERT_EQ(::chmod(file("out").c_str(), 0624), 0);
  auto pending = PendingFile::create(file("out"));
  ASSERT_TRUE(pending.ok());
  pending.value().write("new");
  ASSERT_TRUE(pending.value().commit().ok());
  EXPECT_EQ(readBack(file("out")), "new");
  struct stat status {};
  ASSERT_EQ(::stat(file("out").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0624u);
}

TEST_F(PendingPosixFile, FollowsASymbolicLink) {
  writeText(file("real"), "old");
  fs::create_symlink("real", file("link"));
  auto pending = PendingFile::create(file("link"));
  ASSERT_TRUE(pending.ok());
  pending.value().write("new");
  ASSERT_TRUE(pending.value().commit().ok());
  EXPECT_TRUE(fs::is_symlink(file("link")));
  EXPECT_EQ(readBack(file("real")), "new");
}

TEST_F(PendingPosixFile, FollowsLinksOfLinksToAFileThatIsNotThereYet) {
  fs::create_directory(file("folder"));
  fs::create_symlink("folder/second", file("first"));
  fs::create_symlink("../real", file("folder/second"));
  auto pending = PendingFile::create(file("first"));
  ASSERT_TRUE(pending.ok());
  pending.value().write("new");
  ASSERT_TRUE(pending.value().commit().ok());
  EXPECT_EQ(readBack(file("real")), "new");
}

TEST_F(PendingPosixFile, RefusesAStrangersLinkInASharedFolder) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can make a link of somebody else";
  const auto linkIn = [&](const std::string& folder, mode_t mode, uid_t owner) {
    fs::create_directory(file(folder));
    ::chmod(file(folder).c_str(), mode);
    writeText(file("mine"), "old");
    const std::string link = file(folder + "/report.html");
    fs::create_symlink(file("mine"), link);
    EXPECT_EQ(::lchown(link.c_str(), owner, owner), 0);
    return link;
  };
  constexpr uid_t kStranger = 12345;
  const std::string strangers = linkIn("shared", 01777, kStranger);
  struct stat state {};
  ASSERT_EQ(::lstat(strangers.c_str(), &state), 0);
  if (state.st_uid != kStranger) GTEST_SKIP() << "no files of others here";
  const auto refused = PendingFile::create(strangers);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::FileUnwritable);
  EXPECT_NE(refused.error().message.find("another user's link"), std::string::npos);
  EXPECT_EQ(readBack(file("mine")), "old");
  // Our own there, and a stranger's where we let nobody in.
  EXPECT_TRUE(PendingFile::create(linkIn("own", 01777, ::geteuid())).ok());
  EXPECT_TRUE(PendingFile::create(linkIn("private", 0755, kStranger)).ok());
  // On the way as well, and behind a link of ours.
  fs::create_directory(file("docs"));
  writeText(file("docs/report.html"), "old");
  fs::create_directory_symlink(file("docs"), file("shared/folder"));
  ASSERT_EQ(::lchown(file("shared/folder").c_str(), kStranger, kStranger), 0);
  fs::create_directory_symlink(file("shared/folder"), file("bridge"));
  for (const char* way : {"shared/folder/report.html", "bridge/report.html",
                          "docs/../shared/folder/report.html", "shared/folder/new.html"}) {
    EXPECT_FALSE(PendingFile::create(file(way)).ok()) << way;
  }
  EXPECT_EQ(readBack(file("docs/report.html")), "old");
  ASSERT_EQ(::lchown(file("shared/folder").c_str(), ::geteuid(), ::getegid()), 0);
  EXPECT_TRUE(PendingFile::create(file("bridge/report.html")).ok());
}

TEST_F(PendingPosixFile, FollowsLinksOnTheWayAndEndsInARing) {
  fs::create_directory(file("real"));
  fs::create_directory_symlink("real", file("folder"));
  fs::create_directory_symlink("folder", file("again"));
  auto pending = PendingFile::create(file("again/../again//out"));
  ASSERT_TRUE(pending.ok());
  pending.value().write("new");
  ASSERT_TRUE(pending.value().commit().ok());
  EXPECT_EQ(readBack(file("real/out")), "new");
  fs::create_symlink("ring", file("ring"));
  EXPECT_FALSE(PendingFile::create(file("ring")).ok());
  EXPECT_FALSE(PendingFile::create(file("ring/out")).ok());
}

// As a shell's >(command) gives it: a link of /proc whose text is no path.
TEST_F(PendingPosixFile, WritesIntoAPipeThatHasNoNameOfItsOwn) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const std::string name = "/dev/fd/" + std::to_string(ends[1]);
  struct stat opened {};
  struct stat named {};
  ::fstat(ends[1], &opened);
  ::stat(name.c_str(), &named);
  if (opened.st_ino != named.st_ino) GTEST_SKIP() << "no names for pipes here";
  auto pending = PendingFile::create(name);
  ASSERT_TRUE(pending.ok()) << describe(pending.error());
  pending.value().write("new");
  EXPECT_TRUE(pending.value().commit().ok());
  char text[8] = {};
  EXPECT_EQ(::read(ends[0], text, sizeof text), 3);
  EXPECT_STREQ(text, "new");
  for (const int end : ends) ::close(end);
}

TEST_F(PendingPosixFile, SaysWhyAReadOnlyFolderCannotBeWritten) {
  // The superuser may write anywhere; where there is /proc, not even there.
  const bool isSuperuser = ::geteuid() == 0;
  const std::string target = isSuperuser ? "/proc/foretouch-out" : file("out");
  if (!isSuperuser) fs::permissions(folder_.path(), fs::perms::owner_read | fs::perms::owner_exec);
  const auto pending = PendingFile::create(target);
  fs::permissions(folder_.path(), fs::perms::owner_all);
  ASSERT_FALSE(pending.ok());
  EXPECT_EQ(pending.error().code, ErrorCode::FileUnwritable);
  EXPECT_TRUE(names().empty());
}

TEST_F(PendingPosixFile, WritesToADeviceDirectlyAndReportsAFullOne) {
  auto null = PendingFile::create("/dev/null");
  ASSERT_TRUE(null.ok());
  null.value().write("x");
  EXPECT_TRUE(null.value().commit().ok());
  EXPECT_TRUE(fs::is_character_file("/dev/null"));  // not renamed over

  auto full = PendingFile::create("/dev/full");
  ASSERT_TRUE(full.ok());
  full.value().write("x");
  const auto done = full.value().commit();
  ASSERT_FALSE(done.ok());
  EXPECT_EQ(done.error().code, ErrorCode::FileUnwritable);
  EXPECT_EQ(done.error().file, "/dev/full");
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

}  // namespace
}  // namespace foretouch
