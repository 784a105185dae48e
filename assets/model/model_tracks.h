// assets/model/model_tracks.h: the keys of a model's animation, sampled. Internal to model_clip.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "assets/model/model.h"

namespace foretouch::internal {

/// One node's keys, finite and in order of time, ready to sample.
class SampledTrack {
 public:
  /// `rest`: the node's frame at rest in its parent's. Drops and counts keys that are not finite,
  /// and rotations of zero length.
  SampledTrack(const ModelTrack& track, const Affine& rest);

  /// The node's frame in its parent's: between keys linear, rotations on the shorter arc at
  /// constant rate, or on a cubic spline where the keys have tangents; before the first and after
  /// the last key, that key. The scale is the one at rest. Source: Khronos, "glTF 2.0
  /// Specification", appendix C.
  [[nodiscard]] Affine at(double timeS) const;

  [[nodiscard]] std::int32_t node() const { return node_; }
  [[nodiscard]] bool turns() const { return !rotations_.empty(); }
  [[nodiscard]] bool isCubic() const { return positionsAreCubic_ || rotationsAreCubic_; }
  [[nodiscard]] double lastKeyS() const { return lastKeyS_; }
  [[nodiscard]] std::size_t leftOut() const { return leftOut_; }
  /// Where keys were left out: from the usable key before them to the one after, as the file has
  /// them; infinite where there is none.
  struct Unknown {
    double fromS = 0.0, toS = 0.0;
  };
  [[nodiscard]] const std::vector<Unknown>& unknown() const { return unknown_; }
  /// The file's scale differs from the one at rest by more than a thousandth at some key.
  [[nodiscard]] bool scalesAnew() const { return scalesAnew_; }

 private:
  template <typename Value, typename Tangent>
  struct Key {
    double timeS;
    Value value;
    Tangent in, out;  ///< Zero if the keys are not a spline.
  };
  using PositionKey = Key<Eigen::Vector3d, Eigen::Vector3d>;
  using RotationKey = Key<Quaternion, Eigen::Vector4d>;

  template <typename CleanKey, typename From, typename Tangents>
  std::vector<CleanKey> cleaned(const From& keys, const Tangents& tangents);
  void findScale(const std::vector<PositionKey>& scales);

  std::int32_t node_;
  std::vector<PositionKey> positions_;
  std::vector<RotationKey> rotations_;
  bool positionsAreCubic_, rotationsAreCubic_;
  Affine rest_;
  Eigen::Matrix3d scale_;  ///< rest_.linear = rotation * scale_.
  double lastKeyS_ = 0.0;
  std::size_t leftOut_ = 0;
  std::vector<Unknown> unknown_;
  bool scalesAnew_ = false;
};

}  // namespace foretouch::internal
