#include "tools/batch/job_name.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <sys/stat.h>
#include <tuple>
#include <utility>

#include "assets/text_file.h"
#include "tools/settings/file_mark.h"

namespace foretouch::tools {
namespace {

namespace fs = std::filesystem;

/// Formats of text whose files name others that decide what is read.
constexpr const char* kNaming[] = {".json", ".gltf", ".urdf", ".dae", ".xml", ".x"};
/// A larger text is data.
constexpr std::size_t kMostNamingBytes = std::size_t{64} << 20;
constexpr std::size_t kLongestName = 1024;
/// An avatar names a mesh, and a glTF its buffers.
constexpr int kDeepest = 3;
constexpr char kAbsent[] = "absent";

bool isNaming(const std::string& path) {
  std::string ending = fs::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::find(std::begin(kNaming), std::end(kNaming), ending) != std::end(kNaming);
}

bool isFile(const std::string& path) {
  std::error_code absent;
  return fs::is_regular_file(path, absent);
}

}  // namespace

bool FileMarks::Stamp::operator==(const Stamp& other) const {
  return std::tie(device, inode, size, seconds, nanoseconds) ==
         std::tie(other.device, other.inode, other.size, other.seconds, other.nanoseconds);
}

FileMarks::Stamp FileMarks::stampOf(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return {};
  return {status.st_dev, status.st_ino, status.st_size, status.st_mtim.tv_sec,
          status.st_mtim.tv_nsec};
}

FileMarks::Known FileMarks::read(const std::string& path) const {
  Known known;
  known.stamp = stampOf(path);
  const auto mark = isFile(path) ? markOfFile(path) : Result<std::string>(kAbsent);
  known.mark = mark.ok() ? mark.value() : kAbsent;
  if (!isNaming(path)) return known;
  const auto text = readWholeFile(path, kMostNamingBytes);
  if (!text.ok()) return known;
  const fs::path beside = fs::path(path).parent_path();
  for (const std::string& name : namesIn(text.value())) {
    const std::string named = (beside / name).lexically_normal().string();
    if (isFile(named)) known.names.push_back(named);
  }
  return known;
}

FileMarks::Known FileMarks::known(const std::string& path) {
  const Stamp stamp = stampOf(path);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = known_.find(path);
    if (found != known_.end() && found->second.stamp == stamp) return found->second;
  }
  Known known = read(path);  // two threads may both read it, and find the same
  const std::lock_guard<std::mutex> lock(mutex_);
  return known_[path] = std::move(known);
}

void FileMarks::collect(const std::string& path, int depth,
                        std::map<std::string, std::string>& marks) {
  const Known found = known(path);
  marks[fs::path(path).filename().string()] += found.mark;
  if (depth == kDeepest) return;
  for (const std::string& name : found.names) {
    if (name != path) collect(name, depth + 1, marks);
  }
}

std::string FileMarks::of(const std::string& path) {
  const std::string full = (fs::path(folder_) / path).string();
  std::map<std::string, std::string> marks;  // by name: wherever the files lie
  collect(full, 0, marks);
  std::string all;
  for (const auto& [name, mark] : marks) all += name + '\n' + mark + '\n';
  return markOfText(all);
}

std::vector<std::string> namesIn(const std::string& text) {
  constexpr char kPackage[] = "package://";
  std::vector<std::string> names;
  for (std::size_t from = text.find('"'); from != std::string::npos;) {
    const std::size_t end = text.find('"', from + 1);
    if (end == std::string::npos) break;
    std::string name = text.substr(from + 1, std::min(end - from - 1, kLongestName));
    if (name.rfind(kPackage, 0) == 0) {
      const std::size_t slash = name.find('/', sizeof kPackage - 1);
      name = slash == std::string::npos ? "" : name.substr(slash + 1);
    }
    // A name of a file has an ending, and no line break.
    const bool isLikely = name.find('.') != std::string::npos && name.size() < kLongestName &&
                          name.find('\n') == std::string::npos;
    if (isLikely) names.push_back(std::move(name));
    from = text.find('"', end + 1);
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

std::string jobName(const BatchJob& job, const std::string& version, FileMarks& marks) {
  std::string all = "foretouch-batch-job 1\n" + version + "\n";
  for (const auto& option : job.options) {
    if (option->isDefault) continue;
    all += option->name + '\n';
    if (!option->isFile) {
      all += option->value + '\n';
      continue;
    }
    for (const std::string& path : option->texts) {
      all += fs::path(path).filename().string() + '\n' + marks.of(path) + '\n';
    }
  }
  const std::string first = markOfText(all);
  return first + markOfText(all, first);
}

}  // namespace foretouch::tools
