// tools/solid/solid_check.h: certifies the ways of a file of shown poses once more, from the file,
// its scene and its avatar alone: the query answers each motion again, and no solver is asked.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "articulated/avatar.h"
#include "articulated/result.h"
#include "middleware/query/query.h"
#include "middleware/scene/scene.h"
#include "tools/solid/solid_reader.h"

namespace foretouch::tools {

struct SolidFinding {
  std::int64_t tick = -1;  ///< -1: the file as a whole.
  std::int64_t line = 0;
  std::string text;
};

struct CheckedSolid {
  std::int64_t ticks = 0, certified = 0, notCertified = 0;
  std::int64_t motions = 0;             ///< Proven clear again; single poses included.
  std::int64_t begins = 0;              ///< How often the curve begins.
  double leastTolerance = 0;            ///< The smallest with which a motion had to be asked.
  std::optional<SolidFinding> finding;  ///< The first; what follows is not looked at.

  [[nodiscard]] bool isSound() const { return !finding; }
};

/// The query options that the header states, without a tolerance. Errors: names that the avatar or
/// the scene does not have, rules of another avatar.
[[nodiscard]] Result<QueryOptions> queryOf(const SolidHeader& header, const Avatar& avatar,
                                           const Scene& scene, const std::string& path);

/// Reads and judges tick after tick. `advance` learns how many are done; false ends it. Errors:
/// those of the reader, and options that the query refuses.
class SolidCheck {
 public:
  /// `query`: as queryOf() makes it. Errors: those of Query::build().
  static Result<SolidCheck> build(const Avatar& avatar, const Scene& scene,
                                  const QueryOptions& query, double tolerance);

  /// True if the tick is sound; else `checked().finding` says why not.
  [[nodiscard]] bool take(const SolidRecord& record);
  [[nodiscard]] const CheckedSolid& checked() const { return checked_; }
  [[nodiscard]] CheckedSolid& checked() { return checked_; }

 private:
  SolidCheck(const Avatar& avatar, std::vector<Query> queries)
      : avatar_(avatar), queries_(std::move(queries)) {}
  [[nodiscard]] std::string faultOf(const SolidRecord& record);
  [[nodiscard]] std::string faultOfBegin(const SolidRecord& record) const;
  [[nodiscard]] std::string faultOfWay(const SolidRecord& record);
  [[nodiscard]] std::string faultOfMotion(const Pose& from, const Pose& to);

  Avatar avatar_;
  std::vector<Query> queries_;  // from the largest tolerance to the smallest
  Scratch scratch_;
  StepContacts answer_;
  ChainMotion motion_;
  CheckedSolid checked_;
  std::optional<Pose> shown_;  // nothing while it has no place
  bool wasInside_ = false;
  double lastTimeS_ = 0.0;
};

}  // namespace foretouch::tools
