// tools/report/log_report.h: the replay of an event log as a view document.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "tools/log/replay_log.h"
#include "tools/log/replay_log_summary.h"
#include "tools/report/document_parts.h"
#include "tools/report/swept_views.h"
#include "tools/report/track_builder.h"
#include "tools/report/view_document.h"
#include "tools/touches/ground.h"
#include "tools/touches/touch_tracker.h"

namespace foretouch::tools {

/// Collects answered poses in bounded memory. Only motions between consecutive poses are steps of
/// the document: the motion across a gap is unknown, and not drawn. Time is 0 at the very first
/// pose; a timeline that begins before the previous one has ended moves behind it.
class LogReport {
 public:
  /// `inputs` must outlive it and the document.
  LogReport(const LogReplayInputs& inputs, const ReportOptions& options);

  /// Call in the order of the log. Once an avatar has no room, only counts its poses.
  void add(const AnsweredPose& answered);

  /// Call once. `progress` may end it early: the document is then unusable.
  [[nodiscard]] ViewDocument document(const LogReplayReport& report,
                                      const LogReplaySummary& summary,
                                      const ReportProgress& progress);

 private:
  /// One avatar's data so far.
  struct Player {
    std::optional<AvatarSurface> surface;
    TrackBuilder track;
    std::vector<ReportedContact> contacts;
    double shiftS = 0.0;  ///< Added to the times of this timeline.
    std::int64_t moved = 0, leftOut = 0, acrossGaps = 0;
    TouchTracker tracker{TouchScope::FirstOfLink};
    GroundTest ground;
    std::vector<Touch> touches;  // that have ended
    std::uint32_t lastTo = 0;    // the pose that ended the last step

    Player(const Avatar& avatar, const LogReplayInputs& inputs, const QueryOptions& options);
  };

  Player& playerOf(const AnsweredPose& answered);
  [[nodiscard]] bool hasRoom(const Player& player) const;
  void addStep(const AnsweredPose& answered, Player& player);
  void track(const AnsweredPose& answered, std::size_t firstRow, Player& player) const;
  [[nodiscard]] std::vector<Touch> listed(const std::vector<Touch>& touches) const;
  [[nodiscard]] ViewAvatar avatarOf(std::size_t index, double fromS, ViewDocument& document);
  void noteWhatIsMissing(std::vector<std::string>& notes) const;
  [[nodiscard]] std::vector<ViewRow> settings() const;

  const LogReplayInputs& inputs_;
  ReportOptions options_;
  std::optional<std::int64_t> beginUs_;
  std::vector<std::unique_ptr<Player>> players_;  ///< Null: no pose was answered yet.
};

}  // namespace foretouch::tools
