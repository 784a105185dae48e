#include "assets/bvh/bvh_rewrite.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "assets/bvh/bvh_hierarchy.h"
#include "assets/bvh/bvh_text.h"
#include "assets/text_file.h"
#include "lss/index.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using internal::BvhChannel;
using internal::BvhHierarchy;
using internal::BvhScanner;

constexpr double kDegrees = 180.0 / 3.14159265358979323846;

/// A pose's part that changed by less than this (rad, or m) is as it was.
constexpr double kUnchanged = 1e-9;

BvhJointChannels channelsOf(const std::vector<BvhChannel>& columns) {
  BvhJointChannels channels;
  for (const BvhChannel& column : columns) {
    if (column.isRotation) {
      channels.turns.push_back(column.axis);
    } else {
      channels.shifts[static_cast<std::size_t>(column.axis)] = true;
    }
  }
  return channels;
}

/// The turn of `degrees` that is nearest to `near`.
double unwrapped(double degrees, double near) {
  return degrees - 360.0 * std::round((degrees - near) / 360.0);
}

/// Rewrites the motion, frame by frame.
class Rewriter {
 public:
  Rewriter(std::string_view text, const BvhHierarchy& hierarchy, double scale, const Clip& clip)
      : text_(text), hierarchy_(hierarchy), scale_(scale), clip_(clip) {}

  Result<std::string> write(BvhScanner& scanner, const std::vector<Pose>& after);

 private:
  struct Cell {
    std::string_view word;
    double value = 0.0;
  };
  Result<Done> writeJoint(std::size_t joint, const Cell* cells, const Pose& before,
                          const Pose& after);
  Result<Done> writeTurn(std::size_t joint, const Cell* cells, const Quaternion& after);
  void put(const Cell& cell, double value);
  [[nodiscard]] Error impossible(std::size_t joint) const;

  struct Edit {
    std::string_view word;
    std::string by;
  };

  std::string_view text_;
  const BvhHierarchy& hierarchy_;
  double scale_;
  const Clip& clip_;
  std::vector<Edit> edits_;  // of the frame
};

void Rewriter::put(const Cell& cell, double value) {
  const int digits = digitsBehindPoint(cell.word);
  if (std::abs(value - cell.value) < 0.5 * std::pow(10.0, -digits)) return;
  edits_.push_back({cell.word, fmt::format("{:.{}f}", value, digits)});
}

Error Rewriter::impossible(std::size_t joint) const {
  Error error = Error::of(ErrorCode::Mismatch,
                          "joint " + inQuotes(clip_.skeleton.name(static_cast<JointId>(joint))) +
                              " has no channels for a change of its pose");
  error.index = static_cast<std::int64_t>(joint);
  return error;
}

Result<Done> Rewriter::writeTurn(std::size_t joint, const Cell* cells, const Quaternion& after) {
  const auto& columns = hierarchy_.channels[joint];
  const BvhJointChannels channels = channelsOf(columns);
  const Eigen::Matrix3d R = Eigen::Quaterniond(after).toRotationMatrix();
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].isRotation) places.push_back(i);
  }
  if (channels.turns.size() == 1) {
    const double angle = 2.0 * std::atan2(after.vec()[channels.turns[0]], after.w()) * kDegrees;
    put(cells[places[0]], unwrapped(angle, cells[places[0]].value));
    return Done{};
  }
  if (!channels.saysAnyTurn()) return impossible(joint);
  const auto angles =
      anglesAbout(R, {channels.turns[0], channels.turns[1], channels.turns[2]},
                  {cells[places[0]].value, cells[places[1]].value, cells[places[2]].value});
  for (std::size_t n = 0; n < 3; ++n) put(cells[places[n]], angles[n]);
  return Done{};
}

Result<Done> Rewriter::writeJoint(std::size_t joint, const Cell* cells, const Pose& before,
                                  const Pose& after) {
  const auto& columns = hierarchy_.channels[joint];
  const Vector3d shift = after.translations[joint] - before.translations[joint];
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(shift[axis]) < kUnchanged) continue;
    bool isSaid = false;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (columns[i].isRotation || columns[i].axis != axis) continue;
      put(cells[i], after.translations[joint][axis] / scale_);
      isSaid = true;
    }
    if (!isSaid) return impossible(joint);
  }
  const double turn = Eigen::Quaterniond(before.rotations[joint])
                          .angularDistance(Eigen::Quaterniond(after.rotations[joint]));
  if (turn < kUnchanged) return Done{};
  return writeTurn(joint, cells, after.rotations[joint]);
}

Result<std::string> Rewriter::write(BvhScanner& scanner, const std::vector<Pose>& after) {
  std::vector<Cell> row(hierarchy_.numChannels);
  std::string out;
  const char* copied = text_.data();
  for (std::size_t frame = 0; frame < after.size(); ++frame) {
    for (Cell& cell : row) {
      cell.word = scanner.next().text;
      const auto number = internal::readBvhNumber(cell.word);
      if (number.problem != nullptr) {
        return Error::of(ErrorCode::Mismatch, "is not the text that the clip was read from");
      }
      cell.value = number.value;
    }
    edits_.clear();
    std::size_t column = 0;
    for (std::size_t joint = 0; joint < hierarchy_.channels.size(); ++joint) {
      FORETOUCH_CHECK(writeJoint(joint, row.data() + column, clip_.frames[frame], after[frame]));
      column += hierarchy_.channels[joint].size();
    }
    // A joint's positions may come before its angles, or after them.
    std::sort(edits_.begin(), edits_.end(),
              [](const Edit& x, const Edit& y) { return x.word.data() < y.word.data(); });
    for (const Edit& edit : edits_) {
      out.append(copied, edit.word.data()) += edit.by;
      copied = edit.word.data() + edit.word.size();
    }
  }
  return out.append(copied, text_.data() + text_.size());
}

}  // namespace

std::array<double, 3> anglesAbout(const Eigen::Matrix3d& R, const std::array<int, 3>& axes,
                                  const std::array<double, 3>& old) {
  const int i = axes[0], j = axes[1], k = axes[2];
  const double sign = (j - i + 3) % 3 == 1 ? 1.0 : -1.0;
  const double sine = std::clamp(sign * R(i, k), -1.0, 1.0);
  constexpr double kLocked = 1.0 - 1e-12;
  std::array<double, 3> one{};
  if (std::abs(sine) < kLocked) {
    one = {std::atan2(-sign * R(j, k), R(k, k)), std::asin(sine),
           std::atan2(-sign * R(i, j), R(i, i))};
  } else {  // only the sum of the other two, or their difference, is known
    const double last = old[2] / kDegrees;
    const double both = std::atan2(sign * R(k, j), R(j, j));
    one = {sine > 0.0 ? both - last : both + last, std::asin(sine), last};
  }
  std::array<double, 3> other{one[0] + 180.0 / kDegrees, 180.0 / kDegrees - one[1],
                              one[2] + 180.0 / kDegrees};
  const auto settle = [&](std::array<double, 3>& angles) {
    double away = 0.0;
    for (std::size_t n = 0; n < 3; ++n) {
      angles[n] = unwrapped(angles[n] * kDegrees, old[n]);
      away += std::abs(angles[n] - old[n]);
    }
    return away;
  };
  const double toOne = settle(one), toOther = settle(other);
  return toOther < toOne ? other : one;
}

int digitsBehindPoint(std::string_view number) {
  constexpr std::size_t kLeast = 6, kMost = 12;
  const std::size_t point = number.find('.');
  if (point == std::string_view::npos) return kLeast;
  std::size_t digits = 0;
  while (point + 1 + digits < number.size() && number[point + 1 + digits] >= '0' &&
         number[point + 1 + digits] <= '9') {
    ++digits;
  }
  return static_cast<int>(std::clamp(digits, kLeast, kMost));
}

Result<std::vector<BvhJointChannels>> bvhChannelsOf(std::string_view text,
                                                    const std::string& name) {
  BvhScanner scanner(text);
  internal::ClipNotes notes;
  FORETOUCH_TRY(const auto hierarchy,
                inFile(internal::readBvhHierarchy(scanner, 1.0, notes), name));
  std::vector<BvhJointChannels> all;
  for (const auto& columns : hierarchy.channels) all.push_back(channelsOf(columns));
  return all;
}

Result<std::string> rewriteBvh(std::string_view text, const std::string& name, double scale,
                               const Clip& clip, const std::vector<Pose>& after) {
  BvhScanner scanner(text);
  internal::ClipNotes notes;
  FORETOUCH_TRY(const auto hierarchy,
                inFile(internal::readBvhHierarchy(scanner, scale, notes), name));
  const std::size_t values = std::max(hierarchy.numChannels, 3 * clip.endSites.size());
  FORETOUCH_TRY(const auto header, inFile(internal::readBvhMotionHeader(scanner, values), name));
  static_cast<void>(header);
  return inFile(Rewriter(text, hierarchy, scale, clip).write(scanner, after), name);
}

}  // namespace foretouch
