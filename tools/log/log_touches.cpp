#include "tools/log/log_touches.h"

#include <algorithm>
#include <utility>

#include "assets/json_writer.h"
#include "tools/stream/touch_lines.h"
#include "tools/touches/touch_json.h"

namespace foretouch::tools {

LogTouches::LogTouches(const LogReplayInputs& inputs) : inputs_(inputs) {
  for (const Avatar& avatar : inputs.avatars) {
    players_.push_back(
        {StreamTouches(), GroundTest(avatar, inputs.scene, inputs.request.world.ground)});
  }
}

void LogTouches::add(const AnsweredPose& answered) {
  Player& player = players_[answered.avatar];
  const ChainMotion motion(inputs_.avatars[answered.avatar].skeleton(), *answered.step.from,
                           *answered.step.to);
  player.ground.beginStep(motion);
  std::vector<bool> onGround;
  for (const AnsweredContact& found : answered.answer.contacts) {
    onGround.push_back(player.ground.isGround(found.contact));
  }
  ++answers_;
  TouchEvents events;
  player.touches.take(answered.answer, onGround, events);
  keep(events.ended);
}

void LogTouches::finish() {
  TouchEvents events;
  for (Player& player : players_) player.touches.breakOff(events);
  keep(events.ended);
  std::stable_sort(listed_.begin(), listed_.end(), [](const StreamTouch& x, const StreamTouch& y) {
    return isListedBefore(x.touch, y.touch);
  });
}

void LogTouches::keep(std::vector<StreamTouch>& ended) {
  const bool isIgnored = inputs_.request.world.ground.use == GroundUse::Ignore;
  for (StreamTouch& told : ended) {
    counts_.add(told.touch);
    if (!isIgnored || !told.touch.isGround) listed_.push_back(std::move(told));
  }
}

std::string LogTouches::lines() const {
  std::string text;
  for (const StreamTouch& told : listed_) text += endedTouchLine(told);
  return text + touchSummaryLine(counts_, answers_, {});
}

}  // namespace foretouch::tools
