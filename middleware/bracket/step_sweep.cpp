#include "middleware/bracket/step_sweep.h"

#include <algorithm>
#include <utility>

#include "lss/rounding.h"
#include "middleware/bracket/model_levels.h"
#include "tessellation/swept_lss.h"

namespace foretouch::internal {
namespace {

/// Leaves near a link in a step.
constexpr std::size_t kCrowd = 64;
/// Leaves of a piece; more are walked where a part of it is looked at.
constexpr std::size_t kMostListed = 512;

}  // namespace

void StepSweep::begin() {
  memory_.base = 0;
  clearTubes();  // of another step
  const bool isSaid = (ask_.isCut || cutWhole(plan_, memory_)) && sweep(ask_.isCut);
  // Where no finer level follows, a link that nothing bounds says nothing of the others.
  if (isSaid || ask_.isCut) openNear();
  if (!ask_.isCut) refine(isSaid);
}

bool StepSweep::sweep(bool isLast) {
  bool areBounded = true;
  for (std::size_t body = 0; body < plan_.bodies.size(); ++body) {
    BodyBrackets& own = memory_.bodies[body];
    own.boxes.assign(countOf(numLinks(body)), Aabb{});
    for (LinkId link = 0; link < numLinks(body); ++link) {
      if (!isClaimed(body, link) || own.isOpen[slotOf(link)] == 0) continue;
      const bool isBounded = sweepLink(body, link);
      if (!isBounded && isLast) own.growths[slotOf(link)].reset();
      areBounded = areBounded && isBounded;
    }
  }
  return areBounded;
}

bool StepSweep::sweepLink(std::size_t body, LinkId link) {
  BodyBrackets& own = memory_.bodies[body];
  const auto i = slotOf(link);
  ModelPieces& pieces = base(body);
  for (int k = 0; k < pieces.count(); ++k) {
    const ModelPiece& piece = pieces.piece(k);
    const MotionBounds bounds = piece.motion.bounds(link);
    const double margin = marginIn(piece, body, link);
    // What would bound nothing at these coordinates.
    if (!(margin <= kMaxCoordinate)) return false;
    const LinkState& begin = pieces.placesAtBegin(avatarOf(body), k)[i];
    const LinkState& end = pieces.placesAtEnd(avatarOf(body), k)[i];
    for (const Lss& lss : lssOf(body, link)) {
      own.boxes[i].add(sweptBox(lss, axisBounds(lss, bounds), axisEnds(lss, begin),
                                axisEnds(lss, end), 1.0, margin));
    }
  }
  return true;
}

double StepSweep::marginIn(const ModelPiece& piece, std::size_t body, LinkId link) const {
  return ask_.growths.of(piece, body, link).most() * kInflation + plan_.resolution;
}

void StepSweep::clearTubes() {
  memory_.tubes.clear();
  memory_.tubesOf = {kNoParent, -1};
}

void StepSweep::setTubes(int k, LinkId link) {
  if (memory_.tubesOf == std::make_pair(link, k)) return;
  ModelPieces& pieces = base(0);
  setTubes(pieces.piece(k), link, pieces.placesAtBegin(avatarOf(0), k),
           pieces.placesAtEnd(avatarOf(0), k), 1.0, marginIn(pieces.piece(k), 0, link));
  memory_.tubesOf = {link, k};
}

void StepSweep::setTubes(const ModelPiece& piece, LinkId link, const std::vector<LinkState>& begin,
                         const std::vector<LinkState>& end, double span, double margin) {
  const MotionBounds bounds = piece.motion.bounds(link);
  clearTubes();
  for (const Lss& lss : lssOf(0, link)) {
    memory_.tubes.emplace_back(lss, axisBounds(lss, bounds), axisEnds(lss, begin[slotOf(link)]),
                               axisEnds(lss, end[slotOf(link)]), span, margin);
  }
}

void StepSweep::refine(bool isSaid) {
  clearTubes();  // of another level
  for (std::size_t body = 0; isSaid && body < plan_.bodies.size(); ++body) {
    memory_.bodies[body].moveOpen(avatarOf(body).skeleton());
  }
  if (!cutBase(plan_, memory_)) {
    for (BodyBrackets& body : memory_.bodies) body.begin(body.growths.size());
    return;
  }
  const bool asksPairs = !plan_.pairs.empty() || plan_.bodies.size() > 1;
  if (isSaid && (memory_.base == 0 || (areLssSurface() && !asksPairs))) return;
  (void)sweep(true);
  openNear();
}

void StepSweep::openNear() {
  for (BodyBrackets& body : memory_.bodies) body.isOpen.assign(body.isOpen.size(), 0);
  if (plan_.scene) openNearScene();
  forEachPair([this](const Asked& asked) {
    if (!mayMeet(asked)) return;
    memory_.bodies[0].isOpen[slotOf(asked.link)] = 1;
    memory_.bodies[asked.otherBody].isOpen[slotOf(asked.other)] = 1;
  });
}

void StepSweep::openNearScene() {
  BodyBrackets& own = memory_.bodies[0];
  memory_.triangles.walk(*plan_.scene, own.boxes);
  memory_.ofStep.resize(std::max(memory_.ofStep.size(), own.boxes.size()));
  memory_.isNear.assign(own.boxes.size(), 0);
  for (LinkId link = 0; link < numLinks(0); ++link) {
    const bool isNear = isClaimed(0, link) && memory_.triangles.count(slotOf(link)) > 0 &&
                        !memory_.ignored.collect(plan_.ignored, link);
    if (!isNear || !collectNear(link)) continue;
    memory_.isNear[slotOf(link)] = own.isOpen[slotOf(link)] = 1;
  }
}

bool StepSweep::collectNear(LinkId link) {
  if (!areLssSurface() || isCrowded(link)) return true;
  NearLeaves& leaves = memory_.ofStep[slotOf(link)];
  memory_.triangles.collect(*plan_.scene, slotOf(link), memory_.ignored, leaves);
  if (leaves.empty() || base(0).count() > 1) return !leaves.empty();
  setTubes(0, link);
  memory_.triangles.collect(*plan_.scene, memory_.tubes, leaves, memory_.ofWhole);
  return !memory_.ofWhole.empty();
}

bool StepSweep::mayMeet(const Asked& asked) const {
  const BodyBrackets &one = memory_.bodies[0], &other = memory_.bodies[asked.otherBody];
  return isClaimed(0, asked.link) && isClaimed(asked.otherBody, asked.other) &&
         one.boxes[slotOf(asked.link)].overlaps(other.boxes[slotOf(asked.other)]);
}

bool StepSweep::isCrowded(LinkId link) const {
  return memory_.triangles.count(slotOf(link)) > kCrowd;
}

void StepSweep::walkPieces(LinkId link) {
  memory_.pieceBoxes.clear();
  for (int k = 0; k < base(0).count(); ++k) {
    setTubes(k, link);
    Aabb box;
    for (const SweptTube& tube : memory_.tubes) box.add(tube.box());
    memory_.pieceBoxes.push_back(box);
  }
  memory_.ofPieces.walk(*plan_.scene, memory_.pieceBoxes);
}

const NearLeaves* StepSweep::leavesIn(int k, LinkId link) {
  if (!isCrowded(link)) return &memory_.ofStep[slotOf(link)];
  if (!std::exchange(memory_.arePiecesWalked, true)) walkPieces(link);
  if (memory_.ofPieces.count(slotOf(k)) > kMostListed) return nullptr;
  NearLeaves& leaves = memory_.leaves[slotOf(k)];
  if (std::exchange(memory_.areLeavesKnown[slotOf(k)], std::uint8_t{1}) == 0) {
    memory_.ofPieces.collect(*plan_.scene, slotOf(k), memory_.ignored, leaves);
  }
  return &leaves;
}

const NearPairs* StepSweep::pairsIn(int k, LinkId link) {
  const NearLeaves* const leaves = leavesIn(k, link);
  if (leaves == nullptr || leaves->size() > kCrowd) return nullptr;
  NearPairs& pairs = memory_.near[slotOf(k)];
  if (std::exchange(memory_.arePairsKnown[slotOf(k)], std::uint8_t{1}) == 0) {
    setTubes(k, link);
    memory_.sides.addBoxes(leaves->size());
    memory_.ofPieces.collect(*plan_.scene, memory_.tubes, *leaves, pairs);
  }
  return &pairs;
}

}  // namespace foretouch::internal
