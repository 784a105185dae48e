// tools/person/person_touches.h: what the person of a replay surely touched and may have touched,
// by bounds on how far the person may be from a model of the motion: touches with brackets of their
// begins and ends, and whether the clip itself breaks a bound. Seconds from the clip's first frame.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "articulated/motion_model.h"
#include "articulated/result.h"
#include "assets/bounds/bounds_file.h"
#include "middleware/bracket/bracket.h"
#include "tools/inputs/replay_inputs.h"
#include "tools/person/bracket_joiner.h"
#include "tools/person/person_counts.h"
#include "tools/settings/person_settings.h"

namespace foretouch::tools {

struct PersonAnswer {
  std::vector<PersonTouch> touches;  ///< In the order of their begins.
  PersonCounts counts;
  std::vector<LinkId> unclaimed;  ///< Links with LSS that the file has no bound for.
  double rateHz = 0.0;
};

/// The file's bounds of the avatar's links, at the replay's rate; none if they are not asked.
/// Errors: those of the file, and of boundsOf().
[[nodiscard]] Result<LinkBounds> personBounds(const ReplayInputs& inputs,
                                              const PersonRequest& request);

/// Asks every step, in order. Errors: those of poses.
[[nodiscard]] Result<PersonAnswer> personTouches(const ReplayInputs& inputs,
                                                 const PersonRequest& request,
                                                 const LinkBounds& bounds);

/// Lines of the results (docs/formats.md): one per touch, and one with the counts.
[[nodiscard]] std::string personLines(const ReplayInputs& inputs, const PersonRequest& request,
                                      const PersonAnswer& answer);
/// The touches as text for people.
[[nodiscard]] std::string personText(const ReplayInputs& inputs, const PersonRequest& request,
                                     const PersonAnswer& answer);

/// What does not hold, or is not claimed, as sentences.
[[nodiscard]] std::vector<std::string> personNotes(const ReplayInputs& inputs,
                                                   const PersonAnswer& answer);

/// The answer, its lines and its text; empty if nothing is asked.
struct PersonTold {
  std::optional<PersonAnswer> answer;
  std::string lines, text;
};
[[nodiscard]] Result<PersonTold> tellPerson(const ReplayInputs& inputs,
                                            const PersonRequest& request, const LinkBounds& bounds);

}  // namespace foretouch::tools
