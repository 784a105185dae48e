// tools/solid/solid_reader.h: reads a file of shown poses line by line (docs/formats.md, "Shown
// poses"). The file is untrusted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "assets/file_frame.h"
#include "middleware/solid/solid_tick.h"

namespace foretouch::tools {

/// Largest line of such a file, in bytes.
inline constexpr std::size_t kMaxSolidLineBytes = std::size_t{256} << 20;

/// What the first line says that decides what its ways meet.
struct SolidHeader {
  std::string scene, sceneMark, avatar, avatarMark;  ///< Names without folders, and marks.
  double sceneScale = 1.0;
  UpAxis sceneUp = UpAxis::Y;
  double tolerance = 0.0;  ///< The tolerance with which the ways were certified (m).
  std::vector<std::string> ignore;
  std::string self;  ///< Pair rules as JSON; empty: own links were not asked.
  std::vector<std::string> links;
  std::int64_t ticks = 0;
};

/// One tick as the file has it: poses have as many joints as there are links, and finite numbers;
/// nothing else is checked.
struct SolidRecord {
  std::int64_t line = 0;  ///< The line in the file, from 1.
  bool isMarkTrue = false;
  std::int64_t tick = 0;
  double timeS = 0.0;
  SolidState state = SolidState::Placing;
  SolidLimit limit = SolidLimit::None;
  bool isCertified = false;
  double deviation = 0.0, lift = 0.0, clearance = 0.0;
  std::vector<double> deviations;
  std::optional<Pose> start;
  std::string from;
  std::vector<Pose> way;
  std::vector<double> times;
  std::optional<Pose> tracked;  ///< Nothing: it is what is shown.
};

class SolidReader {
 public:
  /// Errors: those of next(), and a file of another format or version.
  static Result<SolidReader> open(const std::string& path);

  [[nodiscard]] const SolidHeader& header() const { return header_; }
  [[nodiscard]] bool isHeaderMarkTrue() const { return isHeaderMarkTrue_; }
  /// The next tick; nothing after the last one. Errors name file and line: text that is not JSON,
  /// fields that are missing or of the wrong type, words that are not a state, poses of another
  /// number of joints, a line beyond kMaxSolidLineBytes.
  [[nodiscard]] Result<std::optional<SolidRecord>> next();
  /// After the last tick: whether the file ends as a complete one does, with a true mark.
  [[nodiscard]] bool isComplete() const { return isComplete_; }

 private:
  explicit SolidReader(std::string path) : path_(std::move(path)), file_(path_, std::ios::binary) {}
  [[nodiscard]] Result<bool> readLine(std::string& line);
  [[nodiscard]] bool takeMark(const std::string& line);

  std::string path_;
  std::ifstream file_;
  std::int64_t line_ = 0;
  std::string mark_;
  SolidHeader header_;
  bool isHeaderMarkTrue_ = false, isComplete_ = false;
};

}  // namespace foretouch::tools
