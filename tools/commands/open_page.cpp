#include "tools/commands/open_page.h"

#include <algorithm>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <iostream>
#include <spawn.h>
#include <string>
#include <system_error>
#include <unistd.h>

#include "tools/console.h"

namespace foretouch::tools {
namespace {

constexpr char kOpener[] = "xdg-open";

bool isSet(const char* variable) {
  const char* const value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

bool isInstalled(const char* program) {
  const char* const path = std::getenv("PATH");
  const std::string folders = path == nullptr ? "" : path;
  for (std::size_t from = 0; from <= folders.size();) {
    const std::size_t end = std::min(folders.find(':', from), folders.size());
    const std::string file = folders.substr(from, end - from) + "/" + program;
    if (::access(file.c_str(), X_OK) == 0) return true;
    from = end + 1;
  }
  return false;
}

bool isSomebodyThere() {
  return ::isatty(STDIN_FILENO) == 1 && ::isatty(STDOUT_FILENO) == 1 && !isSet("CI") &&
         (isSet("DISPLAY") || isSet("WAYLAND_DISPLAY")) && isInstalled(kOpener);
}

/// Outlives this program, and writes nothing into its terminal.
void open(std::string path) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    posix_spawn_file_actions_addopen(&files, stream, "/dev/null", O_RDWR, 0);
  }
  // A session of its own: the terminal's end does not end it.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID);
  std::string opener = kOpener;
  char* const words[] = {opener.data(), path.data(), nullptr};
  pid_t child = 0;
  if (::posix_spawnp(&child, kOpener, &files, &attributes, words, environ) != 0) {
    printNote(opener + " cannot be started");
  }
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
}

}  // namespace

void offerToOpen(const std::string& path) {
  if (!isSomebodyThere()) return;
  printOut("Open the page now? [Y/n] ");
  static_cast<void>(outputArrived());
  std::string answer;
  if (!std::getline(std::cin, answer)) return;
  if (!answer.empty() && answer[0] != 'y' && answer[0] != 'Y') return;
  std::error_code unknown;
  open(std::filesystem::absolute(path, unknown).string());
}

}  // namespace foretouch::tools
