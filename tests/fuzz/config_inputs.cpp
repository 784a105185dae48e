#include "tests/fuzz/config_inputs.h"

#include <cmath>
#include <set>
#include <string_view>

#include "tests/fuzz/promise.h"
#include "tools/inputs/policy_rules.h"
#include "tools/stream/serve_config.h"

namespace foretouch::fuzz {
namespace {

/// Policies, and what an avatar and a scene make of them.
void checkPolicies(const std::vector<tools::PolicyRule>& rules) {
  require(rules.size() <= tools::kMaxPolicyRules, "policies are bounded");
  for (const tools::PolicyRule& rule : rules) {
    require(rule.tolerance || rule.fidelity || rule.ignore, "a policy says something");
    require(
        !rule.tolerance || (*rule.tolerance >= kMinTolerance && *rule.tolerance <= kMaxTolerance),
        "a policy's tolerance is legal");
    require(!rule.fidelity || rule.objects.empty(), "a link has one surface");
  }
  RawSkeleton raw;
  for (const char* const name : {"Hips", "LeftHand", "LeftFoot"}) {
    RawJoint joint;
    joint.name = name;
    raw.joints.push_back(joint);
  }
  const Skeleton skeleton = Skeleton::build(raw).value();
  const std::vector<std::string> objects{"floor", "table", "table"};
  QueryOptions options;
  const auto applied = tools::applyPolicies(rules, skeleton, objects, options);
  if (!applied.ok()) {
    require(applied.error().file == "input" && applied.error().line >= 1, "a rule has a place");
    return;
  }
  require(options.linkPolicies.empty() || options.linkPolicies.size() == 3, "all links or none");
  for (const LinkPolicy& policy : options.linkPolicies) {
    require(policy.tolerance >= kMinTolerance && policy.tolerance <= options.tolerance,
            "no link is coarser than what is said of all");
  }
  for (const IgnoredPair& pair : options.ignored) {
    require(pair.link >= 0 && pair.link < 3 && pair.object >= -1 && pair.object < 3,
            "ignored pairs exist");
  }
}

}  // namespace

bool feedConfig(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto parsed = tools::parseServeConfig(text, "input");
  if (!parsed.ok()) {
    checkError(parsed.error(), text);
    return false;
  }
  const tools::ServeConfig& config = parsed.value();
  require(!config.url.empty() && !config.world.scenePath.empty(), "what a service needs is there");
  require(config.service.workers >= 1 && config.service.workers <= kMaxServiceWorkers,
          "workers are bounded");
  require(config.service.queue >= 1 && config.service.queue <= kMaxServiceQueue,
          "queues are bounded");
  require(config.world.budgetUs >= 0 && config.world.budgetUs <= tools::kMostBudgetUs,
          "budgets are");
  const double scale = config.world.sceneImport.scale.value_or(1.0);
  const double tolerance = config.world.query.tolerance;
  require(std::isfinite(scale) && scale > 0.0, "the scale is positive");
  require(tolerance >= kMinTolerance && tolerance <= kMaxTolerance, "the tolerance is legal");
  require(config.stream.maxStepUs >= 1 && config.stream.confirmations >= 1, "so is the policy");
  checkPolicies(config.world.policies);
  std::set<std::int32_t> ids;
  for (const tools::NumberedAvatar& avatar : config.avatars) {
    require(ids.insert(avatar.id).second && avatar.id >= 0, "ids differ");
    require(!avatar.path.empty(), "an avatar has a file");
  }
  require(!ids.empty(), "there is an avatar");
  return true;
}

}  // namespace foretouch::fuzz
