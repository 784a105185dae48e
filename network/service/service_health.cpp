#include "network/service/service_health.h"

namespace foretouch::internal {
namespace {

constexpr double kSPerMs = 1e-3, kSPerUs = 1e-6;

std::string secondsText(double value) {
  const std::string text = std::to_string(value);
  return text.substr(0, text.find('.') + 4) + " s";
}

std::string secondsOf(std::int64_t ms) {
  return secondsText(static_cast<double>(ms) * kSPerMs);
}

/// What ails the log harms no answer: it is not a reason to end a service.
void addJournal(const ServiceState& state, const HealthLimits& limits, ServiceHealth& health) {
  if (!state.hasJournal) return;
  if (state.journalIdleMs > limits.stuckAfter.count()) {
    health.text += "degraded: the log has not got on for " + secondsOf(state.journalIdleMs) + "\n";
  }
  if (state.journalFailures > 0) {
    health.text += "degraded: " + std::to_string(state.journalFailures) +
                   " events are not in the log: " + state.journalFailure + "\n";
  }
}

/// Senders that speak in vain. Any stranger can be one: the service is well.
void addRefused(const ServiceState& state, ServiceHealth& health) {
  for (const RefusedBody& body : state.refusedLongest) {
    health.text += "refused: " + describe(body) + "\n";
  }
  if (state.refusedBodies > state.refusedLongest.size()) {
    const std::size_t more = state.refusedBodies - state.refusedLongest.size();
    health.text += "refused: " + std::to_string(more) + " more bodies\n";
  }
}

}  // namespace

ServiceHealth healthOf(const ServiceState& state, const HealthLimits& limits) {
  ServiceHealth health;
  if (state.failure) {
    health.isAlive = false;
    health.text += "failed: " + describe(*state.failure) + "\n";
  }
  for (const ServiceState::Thread& thread : state.threads) {
    if (thread.idleMs <= limits.stuckAfter.count()) continue;
    health.isAlive = false;
    health.text +=
        "stuck: " + thread.name + " has not got on for " + secondsOf(thread.idleMs) + "\n";
  }
  health.isWell = health.isAlive;
  if (state.unacceptedMs >= limits.unacceptedAfter.count()) {
    health.isWell = false;
    health.text += "refusing: poses have come for " + secondsOf(state.unacceptedMs) +
                   ", and none was accepted\n";
  }
  if (health.isWell) health.text = "ok\n";
  addJournal(state, limits, health);
  addRefused(state, health);
  const double ago = static_cast<double>(state.nowUtimeUs - state.lastPoseUtimeUs) * kSPerUs;
  health.text +=
      state.lastPoseUtimeUs == 0 ? "no pose yet\n" : "last pose " + secondsText(ago) + " ago\n";
  return health;
}

}  // namespace foretouch::internal
