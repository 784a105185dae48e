// assets/bounds/bounds_file.h: how far persons may be from a model of their motion, as JSON files,
// format "foretouch-bounds" version 1 (docs/formats.md): claims by link or by part of the body, for
// one model and rate of poses or for all. Metres and seconds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "articulated/motion_model.h"
#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "middleware/bracket/bracket.h"

namespace foretouch {

/// Largest file of bounds, in bytes.
inline constexpr std::size_t kMaxBoundsFileBytes = 4u << 20;

/// One claim. If several give the same number for a link, the one by its name counts, then the one
/// by its part, then the one for all; among equals the first.
struct BoundEntry {
  std::string link;                  ///< By name; or
  std::string part;                  ///< head, trunk, arm, hand, leg, foot, or all.
  std::optional<MotionModel> model;  ///< The model it is about; nothing: any.
  double rateHz = 0.0;               ///< Rate of the poses it is about, within a tenth; 0: any.
  LinkBound bound;
  double quantile = 1.0;   ///< Share of the observations that it holds at.
  std::int64_t count = 0;  ///< Observations behind it; 0: it was declared.
};

struct BoundsFile {
  std::string name;    ///< For people; may be empty.
  std::string source;  ///< Where the numbers are from; may be empty.
  std::vector<BoundEntry> entries;
};

/// The parts of the body, as files name them, that the names of a skeleton's joints say; "" for a
/// joint whose name says none. One per joint.
[[nodiscard]] std::vector<std::string> boundParts(const Skeleton& skeleton);

/// Refuses unknown and repeated keys, wrong types, negative numbers, a claim without a link or a
/// part; errors name the entry and what was expected. Safe on hostile input.
[[nodiscard]] Result<BoundsFile> parseBounds(std::string_view json, const std::string& name);
[[nodiscard]] Result<BoundsFile> readBoundsFile(const std::string& path);
/// The text of a file: parseBounds() of it gives the same, bit for bit.
[[nodiscard]] std::string formatBounds(const BoundsFile& bounds);
[[nodiscard]] Result<Done> writeBoundsFile(const BoundsFile& bounds, const std::string& path);

/// What is claimed of each link of a skeleton, with poses of this rate between which the model
/// moves it.
struct LinkBounds {
  std::vector<LinkBound> bounds;      ///< One per link.
  std::vector<std::int32_t> entryOf;  ///< Per link, the last entry that it is from; -1: none.
};
/// Errors: a name that is not a link of the skeleton; no entry for this model and rate (the error
/// names those that there are). Nothing is claimed of a link that no entry fits.
[[nodiscard]] Result<LinkBounds> boundsOf(const BoundsFile& file, const Skeleton& skeleton,
                                          MotionModel model, double rateHz);

/// boundsOf() for a stream, whose poses come at any rate: keeps what it found last.
class BoundsByRate {
 public:
  /// Errors: as boundsOf(); no entry for the model at any rate.
  static Result<BoundsByRate> make(BoundsFile file, const Skeleton& skeleton, MotionModel model);
  /// Claims nothing at rates that no entry is about. Allocates only where other entries count than
  /// at the last call.
  [[nodiscard]] const std::vector<LinkBound>& at(double rateHz);

 private:
  BoundsByRate(BoundsFile file, Skeleton skeleton, MotionModel model)
      : file_(std::move(file)), skeleton_(std::move(skeleton)), model_(model) {}

  BoundsFile file_;
  Skeleton skeleton_;
  MotionModel model_;
  std::vector<std::uint8_t> counts_, nowCounts_;  // which entries are about the rate
  std::vector<LinkBound> bounds_;
};

/// "constant-rate", "cubic" or "cubic-late"; nothing for other words.
[[nodiscard]] std::optional<MotionModel> motionModelNamed(std::string_view word);

}  // namespace foretouch
