#include "tools/settings/world_settings.h"

#include <algorithm>

#include <fmt/format.h>

#include "tools/settings/frame_settings.h"
#include "tools/settings/words.h"

namespace foretouch::tools {
namespace {

bool isSkinned(const WorldRequest& request) {
  return request.query.fidelity == Fidelity::Skinned;
}

bool isExactAnywhere(const WorldRequest& request) {
  return request.query.fidelity == Fidelity::Exact ||
         std::any_of(request.policies.begin(), request.policies.end(),
                     [](const PolicyRule& rule) { return rule.fidelity == Fidelity::Exact; });
}

void addSkinSettings(Settings& settings, WorldRequest& request) {
  const auto isNamed = [&request] { return isSkinned(request) && !isExactAnywhere(request); };
  settings
      .path("--skin", "BODY", request.skinPath,
            "Skinned fidelity: the model from which the avatar was made")
      .files(kModelEndings)
      .in(kTouchGroup)
      .inConfig("query", "skin")
      .inHeader("skin")
      .inReport("skin")
      .namedIf(isNamed)
      .told = [&request] {
    const std::size_t name = request.skinPath.rfind('/') + 1;
    return isSkinned(request) ? request.skinPath.substr(name) : std::string();
  };
  addUnit(settings, "--skin-scale", request.skinImport.scale, "Metres per unit of that model")
      .in(kTouchGroup)
      .inConfig("query", "skin_scale")
      .inHeader("skin_scale")
      .namedIf(isNamed);
  addUpAxis(settings, "--skin-up", request.skinImport.up, "Which axis of that model points up")
      .in(kTouchGroup)
      .inConfig("query", "skin_up")
      .inHeader("skin_up")
      .namedIf(isNamed);
}

void addScopeSettings(Settings& settings, WorldRequest& request) {
  const auto isNamed = [&request] { return request.query.scope != QueryOptions().scope; };
  settings
      .word("--scope", "links|avatar|objects", request.query.scope, scopeWords(),
            "First contact of every link, only of the whole avatar, or of every link with every "
            "object")
      .ofClips()
      .in(kTouchGroup)
      .inConfig("query", "scope")
      .inHeader("scope")
      .inReport("scope")
      .namedIf(isNamed)
      .told = [&request, isNamed]() -> std::string {
    return isNamed() ? toString(request.query.scope) : "";
  };
  settings
      .flag("--pass-separating", request.query.passSeparating,
            "A link that begins within the tolerance of the scene and does not approach it goes "
            "on, until it is a quarter as near")
      .ofClips()
      .in(kTouchGroup)
      .inConfig("query", "pass_separating")
      .inHeader("pass_separating")
      .inReport("what separates")
      .namedIf([&request] { return request.query.passSeparating; })
      .told = [&request]() -> std::string {
    return request.query.passSeparating ? "is passed" : "";
  };
}

}  // namespace

/// The first line of results has them from the rules themselves.
void addSelfSettings(Settings& settings, WorldRequest& request) {
  settings
      .flag("--self", request.asksSelf,
            "Also ask whether the avatar's own links touch each other; which pairs are asked: "
            "foretouch avatar pairs")
      .ofClips()
      .in(kTouchGroup)
      .inConfig("query", "self")
      .inReport("own links")
      .told = [&request]() -> std::string {
    if (!request.asksSelf) return "";
    const std::size_t name = request.pairsPath.rfind('/') + 1;
    return "asked, by " + (request.pairsPath.empty() ? "rules derived from avatar and clip"
                                                     : request.pairsPath.substr(name));
  };
  settings
      .path("--pairs", "FILE", request.pairsPath,
            "With --self: the pair rules; not given: derived from the avatar and the clip's poses")
      .files("json")
      .ofClips()
      .in(kTouchGroup)
      .inConfig("query", "pairs")
      .needing("--self");
}

void addSceneSettings(Settings& settings, WorldRequest& request) {
  settings
      .path("--scene", "FILE", request.scenePath,
            "Scene: OBJ, PLY, STL, glTF, FBX, Collada, 3DS, OFF, X, IQM or baked")
      .files(kModelEndings)
      .notEmpty()
      .in(kInputGroup)
      .inConfig("scene", "file")
      .inHeader("scene")
      .inReport("scene");
  addUnit(settings, "--scene-scale", request.sceneImport.scale, "Metres per unit of the scene")
      .in(kUnitsGroup)
      .inConfig("scene", "scale")
      .inHeader("scene_scale")
      .inReport("scene's unit");
  addUpAxis(settings, "--scene-up", request.sceneImport.up, "Which axis of the scene points up")
      .formerly("--up")
      .in(kUnitsGroup)
      .inConfig("scene", "up")
      .inHeader("up")
      .inReport("scene's up axis");
}

void refuseGoneFidelities(Setting& setting) {
  setting.take = [take = setting.take](const GivenValue& given) -> Result<Done> {
    const std::string why = whyFidelityIsGone(given.texts.front());
    if (!why.empty()) return Error{ErrorCode::OutOfRange, "", -1, -1, why};
    return take(given);
  };
}

void addQuerySettings(Settings& settings, WorldRequest& request) {
  settings
      .number("--tolerance", "M", request.query.tolerance, kToleranceRange,
              "Largest separation (m) of a reported contact")
      .in(kTouchGroup)
      .inConfig("query", "tolerance")
      .inHeader("tolerance")
      .inReport("tolerance");
  settings
      .word("--fidelity", "link|exact|skinned", request.query.fidelity, fidelityWords(),
            "What touches: the links' LSS (link), their meshes (exact), or a skin (skinned)")
      .in(kTouchGroup)
      .inConfig("query", "fidelity")
      .inHeader("fidelity")
      .inReport("fidelity");
  refuseGoneFidelities(settings.of("--fidelity"));
  settings.list("--ignore", "PAIRS", request.ignore, "Contacts to ignore; may be repeated")
      .in(kTouchGroup)
      .inConfig("query", "ignore")
      .inHeader("ignore")
      .inReport("ignored");
  Setting& budget =
      settings
          .whole("--budget-us", "US", request.budgetUs, 0, kMostBudgetUs,
                 "Work that one step may cost, at 100 evaluations per us; links beyond it are "
                 "undecided; 0: no limit")
          .in(kEffortGroup)
          .inConfig("service", "budget_us")
          .inHeader("budget_us")
          .inReport("budget")
          .namedIf([&request] { return request.budgetUs > 0; });
  budget.shown = [&request] {
    return request.budgetUs > 0 ? std::to_string(request.budgetUs) : "";
  };
  budget.told = [&request] {
    return request.budgetUs > 0 ? fmt::format("{} us per step, as work", request.budgetUs) : "";
  };
}

void addReplayQuerySettings(Settings& settings, WorldRequest& request) {
  addSkinSettings(settings, request);
  // Results still say how exact fidelity tested pairs of triangles (docs/formats.md).
  settings
      .gone("--leaves",
            "is gone: queries follow pairs of triangles by advancement. Cubics are for comparison "
            "only: foretouch-bench latency --fidelity exact --leaves cubics")
      .inHeader("leaves")
      .namedIf([&request] { return isExactAnywhere(request); })
      .json = [] { return jsonString("advancement"); };
  addScopeSettings(settings, request);
  settings.gone("--culler",
                "is gone: the answers never depended on it. The slower culler is for comparison "
                "only: foretouch-bench latency --culler point-query");
  settings
      .path("--policy", "FILE", request.policyPath,
            "Tolerance, fidelity and what to ignore, link by link: [[policy]] tables "
            "(docs/formats.md)")
      .in(kTouchGroup)
      .files("toml")
      .inHeader("policy")
      .inReport("policy")
      .namedIf([&request] { return !request.policies.empty(); })
      .json = [&request] { return policiesJson(request.policies); };
  addSelfSettings(settings, request);
}

void addTouchSettings(Settings& settings, WorldRequest& request) {
  GroundRule& ground = request.ground;
  const auto isAsked = [&ground] { return ground.use != GroundUse::Keep; };
  settings
      .word("--ground", "apart|keep|ignore", ground.use, groundWords(),
            "Touches of the ground: counted apart, touches like any other, or not listed; no "
            "query depends on it")
      .in(kOutputGroup)
      .inHeader("ground");
  settings
      .number("--ground-angle", "DEG", ground.angleDeg, kGroundAngleRange,
              "What counts as ground: where the contact's normal is so near to up")
      .in(kOutputGroup)
      .inHeader("ground_angle")
      .namedIf(isAsked);
  settings
      .number("--ground-height", "M", ground.heightM, kGroundHeightRange,
              "And at most so far above the lowest point of the body")
      .in(kOutputGroup)
      .inHeader("ground_height")
      .namedIf(isAsked);
}

}  // namespace foretouch::tools
