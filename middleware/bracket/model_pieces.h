// middleware/bracket/model_pieces.h: a step of a model as pieces of constant rate, and how far each
// link may be from the model in each. Not installed.
#pragma once

#include <cstdint>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "articulated/motion_model.h"
#include "articulated/skeleton.h"
#include "lss/index.h"
#include "middleware/bracket/known_places.h"

namespace foretouch::internal {

/// How far points of a link are from the model at most: shift + turn * (their distance from the
/// link's origin). Metres and radians.
struct LinkStray {
  double turn = 0.0, shift = 0.0;
  [[nodiscard]] double at(double rho) const { return shift + turn * rho; }
};

struct ModelPiece {
  double begin = 0.0, end = 1.0;          ///< In the part of the step that is asked.
  double stepBegin = 0.0, stepEnd = 1.0;  ///< In the step.
  ChainMotion motion;
  MotionEvaluator evaluator;      ///< For `motion`.
  std::vector<LinkStray> strays;  ///< Per link; infinite: the piece is too long to say.
};

/// A part of a step, from `begin` to `end` of it.
struct AskedPart {
  PosedStep step;
  double begin = 0.0, end = 1.0;
  [[nodiscard]] double at(double t) const { return t == 1.0 ? end : begin + t * (end - begin); }
};

/// So many equal pieces, in which these joints are moved: others stay as the step begins, and no
/// link that hangs on them is asked.
struct PieceCut {
  int count;
  const std::vector<std::uint8_t>& isMoved;  ///< Per joint; a moved one's parent is, too.
  KnownPlaces& places;                       ///< Both outlive the pieces.
};

/// One cut of a step. For one thread; keeps its memory.
class ModelPieces {
 public:
  static constexpr int kMost = 32;

  ModelPieces() = default;
  ModelPieces(const ModelPieces&) = delete;  // evaluators refer to their pieces' motions
  ModelPieces& operator=(const ModelPieces&) = delete;

  /// Cuts a part of the model's step. False: a link may stray by any amount in a piece.
  bool cut(const Avatar& avatar, const AskedPart& part, const ModelMotion& model,
           const PieceCut& cut);
  /// The first half of the step stands as at its begin, the second half as at its end.
  void stand(const Skeleton& skeleton, const PosedStep& step);
  /// Goes on as it went in the step, in pieces that grow: what may be touched soon is found before
  /// all that may be touched later is looked at. False: that cannot be said.
  [[nodiscard]] bool goOn(const Skeleton& skeleton, const PosedStep& step, double horizon);

  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] ModelPiece& piece(int k) { return pieces_[slotOf(k)]; }
  /// Where the links are at a piece's begin and at its end.
  [[nodiscard]] const std::vector<LinkState>& placesAtBegin(const Avatar& avatar, int k) {
    return places(avatar, k);
  }
  [[nodiscard]] const std::vector<LinkState>& placesAtEnd(const Avatar& avatar, int k) {
    return places(avatar, isContinuous_ ? k + 1 : k);
  }
  /// The piece that holds an instant of the step.
  [[nodiscard]] int at(double t) const;

 private:
  void resize(int count);
  void poseAt(double t, const ModelMotion& model, const PieceCut& cut, Pose& pose) const;
  void setPiece(int k, const Skeleton& skeleton);
  const std::vector<LinkState>& places(const Avatar& avatar, int k);

  std::vector<ModelPiece> pieces_;
  int count_ = 0;
  bool isContinuous_ = true;  // each piece begins where the one before it ends
  ChainMotion whole_;         // one of constant rate of which a part is asked
  struct Placed {
    Pose pose;
    std::vector<LinkState> places;
    bool isGiven = false;                           // one of the step's own poses
    const std::vector<LinkState>* known = nullptr;  // once they are
  };
  std::vector<Placed> at_;  // where pieces begin and end
  KnownPlaces* places_ = nullptr;
  std::vector<Pose> ends_;
  std::vector<double> endsS_;
};

}  // namespace foretouch::internal
