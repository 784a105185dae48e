// assets/model/chord_error.h: what poses at a fixed rate lose of an animation that follows cubic
// splines. Internal to model_clip.
#pragma once

#include <cstddef>
#include <vector>

#include "assets/model/model.h"
#include "assets/model/model_tracks.h"

namespace foretouch::internal {

/// How far (m) a point of the model may be from where its splines have it, halfway and at the
/// quarters between poses that are taken `rateHz` times per second: the sum, over the joints that
/// move it, of how far each leaves its chord. From above, as chords may err in different
/// directions; counts only tracks that are splines. 0: none is. It falls with the square of the
/// rate.
[[nodiscard]] double chordErrorOf(const Model& model, const std::vector<SampledTrack>& tracks,
                                  std::size_t frames, double rateHz);

}  // namespace foretouch::internal
