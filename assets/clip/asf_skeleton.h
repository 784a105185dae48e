// assets/clip/asf_skeleton.h: the skeleton of Acclaim's format. Not installed.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "articulated/result.h"
#include "articulated/skeleton.h"

namespace foretouch::internal {

/// A line of words, without comments.
struct AcclaimLine {
  std::int64_t number = 0;
  std::vector<std::string_view> words;  ///< Empty at the end.
};

class AcclaimLines {
 public:
  explicit AcclaimLines(std::string_view text) : rest_(text) {}
  /// The next line that has words. Lines end with LF, CR LF or CR.
  [[nodiscard]] AcclaimLine next();

 private:
  std::string_view rest_;
  std::int64_t number_ = 0;
};

/// What moves a bone: about or along an axis.
enum class AcclaimDof : std::uint8_t { Tx, Ty, Tz, Rx, Ry, Rz };

struct AsfBone {
  std::string name;
  std::int64_t line = 0;
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< Times length: to its end, at rest.
  Quaternion axis = Quaternion::Identity();             ///< C.
  std::vector<AcclaimDof> dofs;                         ///< In the file's order.
};

struct AsfSkeleton {
  std::vector<AsfBone> bones;  ///< The root first, parents before children.
  std::vector<JointId> parents;
  std::map<std::string, std::size_t, std::less<>> placeOf;  ///< By name.
  Eigen::Vector3d rootPosition = Eigen::Vector3d::Zero();   ///< In the file's unit.
  double length = 1.0;                                      ///< The length of `:units`.
  std::vector<std::string> notes;
};

/// A rotation about fixed axes: the first angle first. `order`: "XYZ". Radians.
[[nodiscard]] Quaternion rotationOf(const std::string& order, const Eigen::Vector3d& angles);

/// Errors name the line.
[[nodiscard]] Result<AsfSkeleton> parseAsf(std::string_view text);

}  // namespace foretouch::internal
