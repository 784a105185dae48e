#include "tests/world_fuzz/fuzz_in_c.h"

#include <cstdint>
#include <foretouch/events.h>
#include <foretouch/triggers.h>
#include <foretouch/world.h>
#include <memory>
#include <utility>
#include <vector>

#include "lss/index.h"
#include "tests/bindings/c_world.h"

namespace foretouch::test {
namespace {

struct Destroy {
  void operator()(ft_world* world) const { ft_world_destroy(world); }
};

class InC {
 public:
  InC(const FuzzWorld& drawn, const tools::LoadedWorld& loaded) : drawn_(drawn), loaded_(loaded) {}

  std::string tell(const FuzzTold& told) {
    make();
    for (int i = 0; i < drawn_.numSegments() && isWell_; ++i) {
      for (const int body : drawn_.ranks[slotOf(i)]) pushSegment(body, i);
    }
    check(ft_world_follow_from(world_.get(), told.beginUs, nullptr));
    check(ft_world_follow(world_.get(), told.endUs));
    if (!isWell_) return ft_last_error();
    return compare(told);
  }

 private:
  void check(ft_status status) { isWell_ = isWell_ && status == FT_OK; }
  void make();
  void addBody(const FuzzBody& drawn, const tools::LoadedBody& body);
  void addTrigger(const FuzzBody& drawn);
  void pushSegment(int body, int segment);
  [[nodiscard]] std::string compare(const FuzzTold& told) const;

  const FuzzWorld& drawn_;
  const tools::LoadedWorld& loaded_;
  std::unique_ptr<ft_world, Destroy> world_;
  bool isWell_ = true;
};

void InC::make() {
  ft_world_options options = initialised(ft_world_options_init);
  options.tolerance = drawn_.tolerance;
  ft_world* made = nullptr;
  check(ft_world_create(nullptr, &options, &made));
  world_.reset(made);
  for (std::size_t i = 0; i < drawn_.bodies.size() && isWell_; ++i) {
    const FuzzBody& body = drawn_.bodies[i];
    body.isTrigger ? addTrigger(body) : addBody(body, loaded_.bodies[i]);
  }
  BodyGroup one = -1, other = -1;
  for (std::size_t g = 0; g < loaded_.groups.size(); ++g) {
    (loaded_.groups[g] == "one" ? one : other) = static_cast<BodyGroup>(g);
  }
  if (drawn_.areApart && one >= 0 && other >= 0) check(ft_world_ask(world_.get(), one, other, 0));
}

int whenSilent(const FuzzBody& body) {
  if (body.whenSilent == "wait") return FT_SILENT_WAIT;
  return body.whenSilent == "undecided" ? FT_SILENT_UNDECIDED : FT_SILENT_HOLD_STILL;
}

void InC::addBody(const FuzzBody& drawn, const tools::LoadedBody& body) {
  ft_body_options options = initialised(ft_body_options_init);
  options.group = body.group;
  options.when_silent = whenSilent(drawn);
  std::int32_t number = -1;
  if (body.isMesh()) {
    RawScene raw;
    raw.triangles = *body.shape.triangles;
    const SceneHandle mesh = makeScene(raw);
    check(ft_world_add_mesh(world_.get(), mesh.get(), &options, &number));
  } else {
    const AvatarHandle avatar = makeAvatar(*body.shape.avatar);
    check(ft_world_add_avatar(world_.get(), avatar.get(), &options, &number));
  }
}

void InC::addTrigger(const FuzzBody& drawn) {
  ft_trigger_options options = initialised(ft_trigger_options_init);
  options.when_silent = whenSilent(drawn);
  std::int32_t trigger = -1, number = -1;
  const double half[3] = {drawn.half, drawn.half, drawn.half};
  check(drawn.isBox ? ft_world_add_trigger_box(world_.get(), half, &options, &trigger, &number)
                    : ft_world_add_trigger_sphere(world_.get(), drawn.parts.front().radius,
                                                  &options, &trigger, &number));
  if (drawn.watches >= 0)
    check(ft_world_watch(world_.get(), trigger, drawn.watches, FT_EVERY_LINK));
}

/// The stretches that begin in the segment, as the file's reader has them.
void InC::pushSegment(int body, int segment) {
  const auto at = slotOf(segment);
  const std::int64_t fromUs = drawn_.cuts[at], toUs = drawn_.cuts[at + 1];
  bool isFirst = true;
  for (const tools::BodyStretch& stretch : loaded_.bodies[slotOf(body)].stretches) {
    const bool wasFirst = std::exchange(isFirst, false);
    const bool isHere = stretch.beginUs >= fromUs && stretch.beginUs < toUs;
    if (!isHere) continue;
    std::int64_t us = stretch.track.knownFromUs();
    const PoseArrays first(*stretch.track.pieceAt(us).from);
    const ft_pose pose = first.view();
    if (stretch.carrier) {
      ft_carrier carrier{};
      carrier.size = sizeof carrier;
      carrier.body = stretch.carrier->body;
      carrier.link = stretch.carrier->link;
      carrier.moves_in_frame = stretch.carrier->movesInFrame ? 1 : 0;
      check(ft_world_attach(world_.get(), body, &carrier, us, &pose));
    } else {
      check(wasFirst ? ft_world_push(world_.get(), body, us, &pose)
                     : ft_world_detach(world_.get(), body, us, &pose));
    }
    while (us < stretch.track.knownUntilUs()) {
      us = stretch.track.nextKnotUs(us);
      const PoseArrays next(*stretch.track.pieceAt(us).from);
      const ft_pose then = next.view();
      check(ft_world_push(world_.get(), body, us, &then));
    }
  }
}

/// All that a function of C lists.
template <typename Struct, typename List>
std::vector<Struct> listed(const List& list) {
  std::size_t count = 0;
  if (list(nullptr, 0, &count) != FT_OK) return {};
  std::vector<Struct> all(count);
  if (count == 0) return all;
  all[0].size = sizeof(Struct);
  if (list(all.data(), count, nullptr) != FT_OK) all.clear();
  return all;
}

std::string InC::compare(const FuzzTold& told) const {
  const auto events = listed<ft_event>([&](ft_event* list, std::size_t room, std::size_t* count) {
    return ft_world_events(world_.get(), list, room, count);
  });
  if (events.size() != told.events.size()) return "another number of events";
  for (std::size_t i = 0; i < events.size(); ++i) {
    const ft_event& one = events[i];
    const WorldEvent& other = told.events[i];
    const bool isSame =
        one.kind == static_cast<int>(other.kind) && one.cause == static_cast<int>(other.cause) &&
        one.time_us == other.time.us && one.time_fraction == other.time.fraction &&
        one.since_us == other.since.us && one.since_fraction == other.since.fraction &&
        one.a.body == other.a.body && one.b.body == other.b.body &&
        one.separation == other.separation && (one.is_assumed != 0) == other.isAssumed;
    if (!isSame) return "event " + std::to_string(i);
  }
  const auto inside =
      listed<ft_trigger_event>([&](ft_trigger_event* list, std::size_t room, std::size_t* count) {
        return ft_world_trigger_events(world_.get(), list, room, count);
      });
  if (inside.size() != told.triggerEvents.size()) return "another number of events of triggers";
  for (std::size_t i = 0; i < inside.size(); ++i) {
    const ft_trigger_event& one = inside[i];
    const TriggerEvent& other = told.triggerEvents[i];
    const bool isSame = one.kind == static_cast<int>(other.kind) && one.trigger == other.trigger &&
                        one.body == other.body && one.time_us == other.time.us &&
                        one.time_fraction == other.time.fraction && one.since_us == other.since.us;
    if (!isSame) return "event " + std::to_string(i) + " of triggers";
  }
  return "";
}

}  // namespace

std::string otherInC(const FuzzWorld& drawn, const tools::LoadedWorld& world,
                     const FuzzTold& told) {
  return InC(drawn, world).tell(told);
}

}  // namespace foretouch::test
