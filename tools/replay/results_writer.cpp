#include "tools/replay/results_writer.h"

#include <algorithm>
#include <filesystem>

#include "tools/contact_json.h"

namespace foretouch::tools {
namespace {

std::string nameOfFile(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

const char* nameOf(UpAxis up) {
  return up == UpAxis::Z ? "z" : "y";
}

/// A rule as it was given.
void writeRule(const PolicyRule& rule, JsonWriter& out) {
  out.beginObject();
  if (!rule.links.empty()) out.field("links", rule.links);
  if (!rule.objects.empty()) out.field("objects", rule.objects);
  if (rule.tolerance) out.field("tolerance", *rule.tolerance);
  if (rule.fidelity) out.field("fidelity", toString(*rule.fidelity));
  if (rule.ignore) out.field("ignore", *rule.ignore);
  out.endObject();
}

void writePlacement(const ReplayRequest& request, JsonWriter& out) {
  out.field("scale", request.motionScale);
  out.field("motion_up", request.placement.motionUpZ ? "z" : "y");
  out.key("place");
  out.beginArray();
  for (const double x : request.placement.origin) out.value(x);
  out.value(request.placement.yawDeg);
  out.endArray();
}

/// What only motions that are no BVH clips depend on.
void writeMotion(const ReplayRequest& request, JsonWriter& out) {
  if (!request.animation.empty()) out.field("animation", request.animation);
  if (!request.robotPath.empty()) writeFileName("robot", request.robotPath, out);
}

}  // namespace

void beginResults(JsonWriter& out) {
  out.beginObject();
  out.field("format", "foretouch-results");
  out.field("version", 1);
  out.field("tool", FORETOUCH_VERSION);
}

void writeFileName(const char* name, const std::string& path, JsonWriter& out) {
  out.field(name, nameOfFile(path));
}

void writeLinkNames(const Avatar& avatar, JsonWriter& out) {
  out.key("links");
  out.beginArray();
  for (LinkId link = 0; link < avatar.numLinks(); ++link) out.value(avatar.skeleton().name(link));
  out.endArray();
}

void writeQuestion(const ReplayRequest& request, JsonWriter& out) {
  out.field("tolerance", request.tolerance);
  out.field("fidelity", toString(request.fidelity));
}

void writeSceneOptions(const ReplayRequest& request, JsonWriter& out) {
  out.field("scene_scale", request.sceneScale);
  out.field("up", nameOf(request.sceneUp));
  out.field("ignore", request.ignore);
}

void writePolicies(const ReplayRequest& request, JsonWriter& out) {
  if (request.policies.empty()) return;
  out.list("policy", request.policies, [&](const PolicyRule& rule) { writeRule(rule, out); });
}

void writeSurface(const ReplayRequest& request, JsonWriter& out) {
  const bool isExact =
      request.fidelity == Fidelity::Exact ||
      std::any_of(request.policies.begin(), request.policies.end(),
                  [](const PolicyRule& r) { return r.fidelity == Fidelity::Exact; });
  if (isExact) {
    out.field("leaves", toString(request.leafMethod));
  } else if (request.fidelity == Fidelity::Skinned) {
    writeFileName("skin", request.skinPath, out);
    out.field("skin_scale", request.skinScale);
    out.field("skin_up", nameOf(request.skinUp));
  }
}

std::string headerLine(const ReplayInputs& inputs) {
  const ReplayRequest& request = inputs.request;
  std::string text;
  JsonWriter out(text);
  beginResults(out);
  writeFileName("scene", request.scenePath, out);
  writeFileName("avatar", request.avatarPath, out);
  writeFileName("motion", request.motionPath, out);
  out.key("rate");
  if (request.rateHz) {
    out.value(*request.rateHz);
  } else {
    out.null();
  }
  out.field("k", inputs.steps.stride);
  out.field("frame_time", inputs.clip.frameTimeS);
  out.field("steps", inputs.steps.count);
  writeQuestion(request, out);
  writePlacement(request, out);
  writeSceneOptions(request, out);
  if (request.scope != Scope::EveryLink) out.field("scope", toString(request.scope));
  if (request.budgetUs > 0) out.field("budget_us", request.budgetUs);
  writePolicies(request, out);
  writeSurface(request, out);
  writeMotion(request, out);
  writeLinkNames(inputs.avatar, out);
  out.field("unmatched_joints", inputs.match.unmatchedAvatar);
  out.endObject();
  return text + "\n";
}

StepFormat::StepFormat(const Avatar& avatar, const Scene& scene) : scene_(scene) {
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    links_.push_back(jsonString(avatar.skeleton().name(link)));
  }
  for (const std::string& name : scene.objectNames()) objects_.push_back(jsonString(name));
}

std::string StepFormat::line(const StepAnswer& answer) const {
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  out.field("step", answer.step);
  out.field("t0", answer.t0S);
  out.field("t1", answer.t1S);
  out.list("contacts", answer.contacts,
           [&](const LinkContact& contact) { write(contact, answer, out); });
  out.key("latency_us");
  out.fixed(answer.latencyUs, 1);
  out.endObject();
  return text + "\n";
}

void StepFormat::write(const LinkContact& contact, const StepAnswer& answer,
                       JsonWriter& out) const {
  ContactWords words;
  words.link = links_[static_cast<std::size_t>(contact.link)];
  if (contact.verdict != Verdict::Undecided) {
    words.object = objects_[static_cast<std::size_t>(scene_.object(contact.triangle))];
    words.timeS = timeOf(contact, answer.t0S, answer.t1S);
  }
  out.beginObject();
  writeContact(contact, words, out);
  out.endObject();
}

}  // namespace foretouch::tools
