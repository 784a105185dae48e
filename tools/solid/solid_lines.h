// tools/solid/solid_lines.h: the lines of a file of shown poses (docs/formats.md, "Shown poses").
// Pure: the same ticks give the same text.
#pragma once

#include <string>
#include <vector>

#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "assets/json_writer.h"
#include "middleware/solid/solid_options.h"
#include "tools/inputs/replay_inputs.h"
#include "tools/solid/solid_player.h"

namespace foretouch::tools {

inline constexpr char kSolidFormat[] = "foretouch-solid";
inline constexpr int kSolidVersion = 1;

/// The mark of the bits of its numbers, in the order rotations (w, x, y, z), translations.
[[nodiscard]] std::string markOfPose(const Pose& pose);

/// Writes the lines one after the other: each but the first carries the mark of itself and of all
/// lines before it.
class SolidLines {
 public:
  /// `options` as SolidAvatar::options() completes them.
  SolidLines(const ReplayInputs& inputs, SolidOptions options);

  /// The first line. Errors: an input file that can no longer be read, for its mark.
  [[nodiscard]] Result<std::string> header();
  /// Ticks in order.
  [[nodiscard]] std::string line(const PlayedTick& tick);
  /// The last line: `fields` are those of the summary, JSON already.
  [[nodiscard]] std::string last(const std::string& fields);

 private:
  [[nodiscard]] std::string marked(std::string open);
  void write(const SolidContact& contact, JsonWriter& out) const;

  const ReplayInputs& inputs_;
  SolidOptions options_;
  std::vector<std::string> links_, objects_;  // as JSON strings
  std::string mark_, shownMark_;
};

}  // namespace foretouch::tools
