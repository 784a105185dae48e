#include "tools/inputs/policy_rules.h"

#include <utility>

#include "articulated/try.h"
#include "tools/inputs/policy_section.h"
#include "tools/settings/toml_section.h"

namespace foretouch::tools {
namespace {

void readNames(TomlSection& section, const char* key, std::vector<std::string>& names) {
  section.texts(key, names);
  const toml::node* const node = section.find(key);
  if (node == nullptr || !node->is_array() || !node->as_array()->empty()) return;
  section.outOfRange(key, "at least one name (leave it out for all of them)", "none", *node);
}

PolicyRule readPolicy(TomlSection section, TomlReading& reading) {
  PolicyRule rule;
  rule.file = reading.file;
  rule.line = section.line();
  section.allowOnly({"links", "objects", "tolerance", "fidelity", "ignore"});
  readNames(section, "links", rule.links);
  readNames(section, "objects", rule.objects);
  if (section.find("tolerance") != nullptr) {
    rule.tolerance = kMinTolerance;
    section.number(
        "tolerance", kToleranceRange.inWords().c_str(),
        [](double v) { return kToleranceRange.contains(v); }, *rule.tolerance);
  }
  if (section.find("fidelity") != nullptr) {
    rule.fidelity = Fidelity::Link;
    section.word<Fidelity>("fidelity", {"link", "exact"}, {Fidelity::Link, Fidelity::Exact},
                           *rule.fidelity);
  }
  section.truth("ignore", rule.ignore);
  if (!rule.tolerance && !rule.fidelity && !rule.ignore) {
    reading.fail(ErrorCode::Empty, rule.line, "[[policy]]: expected tolerance, fidelity or ignore");
  }
  if (rule.fidelity && !rule.objects.empty()) {
    reading.fail(ErrorCode::Mismatch, rule.line,
                 "[[policy]] fidelity: expected no objects beside it: a link has one surface for "
                 "all of them");
  }
  return rule;
}

}  // namespace

void readPolicies(const TomlSection& root, TomlReading& reading, std::vector<PolicyRule>& rules) {
  const toml::node* const node = root.find("policy");
  if (node == nullptr || (node->is_array() && node->as_array()->empty())) return;
  if (!node->is_array_of_tables()) {
    return reading.fail(ErrorCode::Syntax, lineOf(*node),
                        "policy: expected tables, each under a line [[policy]]");
  }
  if (node->as_array()->size() > kMaxPolicyRules) {
    return reading.fail(ErrorCode::LimitExceeded, lineOf(*node),
                        "expected at most " + std::to_string(kMaxPolicyRules) + " policies");
  }
  for (const toml::node& element : *node->as_array()) {
    rules.push_back(readPolicy({reading, *element.as_table(), "[[policy]]"}, reading));
  }
}

Result<std::vector<PolicyRule>> parsePolicyFile(std::string_view text, const std::string& file) {
  FORETOUCH_TRY(const auto parsed, parseToml(text, file));
  TomlReading reading{file, std::nullopt};
  TomlSection root(reading, parsed, "the file");
  // A project file may hold the policies; takeFromProject() checks its other tables.
  root.allowOnly({"policy", "scene", "clip", "avatar", "query", "service", "stream", "solid",
                  "person", "made"});
  std::vector<PolicyRule> rules;
  readPolicies(root, reading, rules);
  if (rules.empty()) reading.fail(ErrorCode::Empty, -1, "expected at least one [[policy]]");
  if (reading.error) return *reading.error;
  return rules;
}

Result<std::vector<PolicyRule>> readPolicyFile(const std::string& path) {
  FORETOUCH_TRY(const auto text, readWholeFile(path, kMaxTomlBytes));
  return parsePolicyFile(text, path);
}

Result<Done> readPolicies(WorldRequest& request) {
  if (request.policyPath.empty()) return Done{};
  FORETOUCH_TRY(request.policies, readPolicyFile(request.policyPath));
  return Done{};
}

}  // namespace foretouch::tools
