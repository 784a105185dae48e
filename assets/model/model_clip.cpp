#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "articulated/try.h"
#include "assets/bvh/bvh_limits.h"
#include "assets/bvh/bvh_reader.h"
#include "assets/model/chord_error.h"
#include "assets/model/model_avatar.h"
#include "assets/model/model_frames.h"
#include "assets/model/model_tracks.h"
#include "assets/model/pose_frames.h"
#include "assets/near_names.h"
#include "assets/text_file.h"
#include "lss/index.h"

namespace foretouch {
namespace {

/// A share of a frame: a duration that is a whole number of frames to rounding gets no extra frame.
constexpr double kWholeFrame = 1e-6;

std::vector<std::string> namesOf(const std::vector<ModelAnimation>& animations) {
  std::vector<std::string> names;
  for (const ModelAnimation& animation : animations) names.push_back(animation.name);
  return names;
}

/// "Walk" of "Armature|Walk": exporters put the rig before it.
std::string nameWithoutRig(const std::string& name) {
  return name.substr(name.rfind('|') + 1);
}

/// "; did you mean ...?": with the rig before the name, or without it.
std::string nearestAnimations(const std::string& wanted, const std::vector<std::string>& names) {
  std::vector<std::string> bare;
  for (const std::string& name : names) bare.push_back(nameWithoutRig(name));
  const std::string near = didYouMean(wanted, names);
  return near.empty() ? didYouMean(wanted, bare) : near;
}

/// The only one that `is` so; null: there is none, or there are several.
template <typename Is>
const ModelAnimation* onlyOne(const std::vector<ModelAnimation>& animations, Is is) {
  const auto first = std::find_if(animations.begin(), animations.end(), is);
  if (first == animations.end()) return nullptr;
  return std::any_of(first + 1, animations.end(), is) ? nullptr : &*first;
}

Result<const ModelAnimation*> findAnimation(const Model& model, const std::string& wanted) {
  const std::vector<ModelAnimation>& animations = model.animations;
  if (animations.empty()) return Error::of(ErrorCode::Empty, "the model holds no animation");
  if (wanted.empty()) return &animations.front();
  for (const ModelAnimation& animation : animations) {
    if (animation.name == wanted) return &animation;
  }
  for (std::size_t i = 0; i < animations.size(); ++i) {
    if (std::to_string(i) == wanted) return &animations[i];
  }
  const auto* const ofRig = onlyOne(animations, [&](const ModelAnimation& animation) {
    return nameWithoutRig(animation.name) == wanted;
  });
  if (ofRig != nullptr) return ofRig;
  const std::vector<std::string> names = namesOf(animations);
  return Error::of(ErrorCode::UnknownName,
                   "no animation is called " + inQuotes(wanted) + "; expected a number from 0 to " +
                       std::to_string(names.size() - 1) + ", or one of " + internal::listed(names) +
                       nearestAnimations(wanted, names));
}

/// Says which one is played, where the user named none of several.
void noteChoice(const Model& model, const std::string& wanted, std::vector<std::string>& notes) {
  if (!wanted.empty() || model.animations.size() < 2) return;
  const std::vector<std::string> names = namesOf(model.animations);
  notes.push_back("holds " + std::to_string(names.size()) + " animations, and the first, " +
                  inQuotes(names.front()) + ", is played; a name or a number chooses another of " +
                  internal::listed(names));
}

std::vector<internal::SampledTrack> sampledTracks(const Model& model,
                                                  const ModelAnimation& animation) {
  std::vector<internal::SampledTrack> tracks;
  for (const ModelTrack& track : animation.tracks) {
    if (track.node < 0) continue;
    tracks.emplace_back(track, model.nodes[slotOf(track.node)].toParent);
  }
  return tracks;
}

std::vector<std::string> notesOn(const Model& model,
                                 const std::vector<internal::SampledTrack>& tracks) {
  std::vector<std::string> notes, scaled;
  std::size_t leftOut = 0;
  for (const internal::SampledTrack& track : tracks) {
    leftOut += track.leftOut();
    if (track.scalesAnew()) {
      scaled.push_back(model.nodes[slotOf(track.node())].name);
    }
  }
  if (leftOut > 0) {
    notes.push_back(std::to_string(leftOut) +
                    " keys are not finite or no rotation and are left out");
  }
  if (!scaled.empty()) {
    notes.push_back("links are rigid: the animated scale of " + std::to_string(scaled.size()) +
                    " nodes is ignored: " + internal::listed(scaled));
  }
  return notes;
}

/// Splines are followed exactly at the poses; between them, a clip is what it is.
void noteChordError(double errorM, double rateHz, std::vector<std::string>& notes) {
  constexpr double kNoticeable = 1e-3;  // metres
  if (!(errorM > kNoticeable)) return;
  notes.push_back("the animation follows curves: between its poses at " + inDigits(rateHz) +
                  " Hz the clip leaves them by up to " + inDigits(1e3 * errorM, 3) + " mm; " +
                  inDigits(std::ceil(rateHz * std::sqrt(errorM / kNoticeable))) +
                  " Hz would keep within 1 mm");
}

/// From the first frame at 0 s to one that is not before the last key.
Result<std::size_t> countFrames(const ModelAnimation& animation,
                                const std::vector<internal::SampledTrack>& tracks, double rateHz) {
  if (!(rateHz >= 1.0 / kMaxFrameTimeS && rateHz <= 1.0 / kMinFrameTimeS)) {
    return Error::of(ErrorCode::OutOfRange,
                     "expected a frame time of 1e-6 to 3600 s, found a rate of " +
                         std::to_string(rateHz) + " Hz");
  }
  double endS = std::isfinite(animation.durationS) ? std::max(0.0, animation.durationS) : 0.0;
  for (const internal::SampledTrack& track : tracks) endS = std::max(endS, track.lastKeyS());
  const double steps = std::ceil(endS * rateHz - kWholeFrame);
  if (steps < static_cast<double>(kMaxBvhValues)) return static_cast<std::size_t>(steps) + 1;
  return Error::of(ErrorCode::LimitExceeded, "animation " + inQuotes(animation.name) + " lasts " +
                                                 std::to_string(endS) + " s; at " +
                                                 std::to_string(rateHz) +
                                                 " Hz that is more frames than a clip may have");
}

/// The frames that unusable keys would have given.
std::vector<ClipGap> gapsOf(const std::vector<internal::SampledTrack>& tracks, std::size_t count,
                            double rateHz) {
  std::vector<ClipGap> gaps;
  const double last = static_cast<double>(count) - 1.0;
  for (const internal::SampledTrack& track : tracks) {
    for (const internal::SampledTrack::Unknown& unknown : track.unknown()) {
      const double from = std::floor(std::max(unknown.fromS * rateHz, -1.0) + kWholeFrame) + 1.0;
      const double to = std::ceil(std::min(unknown.toS * rateHz, last + 1.0) - kWholeFrame) - 1.0;
      if (from > to) continue;
      gaps.push_back({static_cast<std::int64_t>(from), static_cast<std::int64_t>(to)});
    }
  }
  return gaps;
}

/// Where files say which axis points up, a body and its animation may say different ones: then
/// their roots differ by that turn, and the body must take the animation's.
void markTurnedRoots(const Model& model, internal::FrameCollector& collector) {
  if (!model.frame.declared.up || model.frame.declared.isOfFormat) return;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    if (model.nodes[i].parent < 0) collector.moves(static_cast<std::int32_t>(i), true);
  }
}

}  // namespace

Result<Clip> clipFromModel(const Model& model, const ModelClipOptions& options) {
  FORETOUCH_CHECK(internal::checkModel(model));
  FORETOUCH_TRY(const auto animation, findAnimation(model, options.animation));
  const auto tracks = sampledTracks(model, *animation);
  FORETOUCH_TRY(const auto count, countFrames(*animation, tracks, options.rateHz));
  FORETOUCH_TRY(auto collector, internal::FrameCollector::create(model, count));

  for (const auto& track : tracks) collector.moves(track.node(), track.turns());
  markTurnedRoots(model, collector);
  std::vector<Affine> frames = internal::restFrames(model);
  for (std::size_t i = 0; i < count; ++i) {
    const double timeS = static_cast<double>(i) / options.rateHz;
    for (const auto& track : tracks) {
      frames[slotOf(track.node())] = track.at(timeS);
    }
    FORETOUCH_CHECK(collector.add(frames));
  }
  std::vector<std::string> notes = notesOn(model, tracks);
  noteChoice(model, options.animation, notes);
  noteChordError(internal::chordErrorOf(model, tracks, count, options.rateHz), options.rateHz,
                 notes);
  Clip clip = collector.take(1.0 / options.rateHz, std::move(notes));
  clip.gaps = gapsOf(tracks, count, options.rateHz);
  return clip;
}

}  // namespace foretouch
