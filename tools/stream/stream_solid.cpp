#include "tools/stream/stream_solid.h"

#include <algorithm>

#include "articulated/try.h"
#include "middleware/query_options.h"

namespace foretouch::tools {
namespace {

/// So that a cut leaves room to back off.
constexpr double kToleranceOfGap = 0.25;

}  // namespace

Result<SolidOptions> solidOptionsFor(const StreamSolidRequest& request,
                                     const std::string& avatarPath, const Avatar& avatar,
                                     const std::vector<IgnoredPair>& ignored) {
  SolidOptions options = request.solid.options;
  options.tolerance = std::min(options.tolerance, kToleranceOfGap * options.skin);
  options.ignored = ignored;
  options.workBudget = workBudget(static_cast<double>(request.budgetUs));
  if (request.stopsItself) {
    FORETOUCH_TRY(options.self, inFile(PairRules::derive(avatar, {}), avatarPath));
  }
  return options;
}

Result<Done> makeSolid(const StreamSolidRequest& request, const std::string& avatarPath,
                       StreamSolver& solver) {
  if (!request.solid.isAsked) return Done{};
  FORETOUCH_TRY(const auto options,
                solidOptionsFor(request, avatarPath, solver.avatar(), solver.options().ignored));
  return inFile(solver.makeSolid(options), avatarPath);
}

}  // namespace foretouch::tools
