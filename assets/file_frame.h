// assets/file_frame.h: the unit and the up axis of a model's or scene's file: what it says itself,
// and what its numbers were read with.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <Eigen/Core>

namespace foretouch {

enum class UpAxis : std::uint8_t { Y, Z };

/// What a file says of its own numbers; what it does not say is empty.
struct DeclaredFrame {
  std::optional<double> metresPerUnit;  ///< Finite, > 0.
  std::optional<UpAxis> up;
  bool isOfFormat = false;  ///< The format has only one frame (glTF): the file itself is silent.
};

/// How a file's numbers became metres with +Y up: by the options where they name a unit or an axis,
/// else as the file declares, else taken as they are. An option stands in place of what the file
/// declares and never adds to it.
struct FileFrame {
  DeclaredFrame declared;
  double metresPerUnit = 1.0;
  UpAxis up = UpAxis::Y;
  bool isUnitAsked = false, isUpAsked = false;  ///< By the options.
};

/// "says 0.01 m per unit and Z up; both applied"; empty if the file itself says nothing.
[[nodiscard]] std::string describe(const FileFrame& frame);

namespace internal {

/// What is left to do to numbers that are in metres with +Y up by an earlier frame. Scale and turn
/// commute.
struct FrameChange {
  enum class Turn : std::uint8_t { None, FromZUp, BackToZUp };
  double scale = 1.0;
  Turn turn = Turn::None;

  /// FromZUp: (x, y, z) becomes (x, z, -y). Moves coordinates, computes nothing.
  [[nodiscard]] Eigen::Vector3d turned(const Eigen::Vector3d& v) const {
    if (turn == Turn::FromZUp) return {v.x(), v.z(), -v.y()};
    return turn == Turn::BackToZUp ? Eigen::Vector3d(v.x(), -v.z(), v.y()) : v;
  }
};

/// `frame` is what the reader made of the file's numbers; it becomes what the options and the
/// declaration together mean.
[[nodiscard]] FrameChange settleFrame(std::optional<double> metresPerUnit, std::optional<UpAxis> up,
                                      FileFrame& frame);

}  // namespace internal
}  // namespace foretouch
