#include "tests/fuzz/call_inputs.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <foretouch/world.h>
#include <string_view>
#include <vector>

#include "tests/fuzz/promise.h"

namespace foretouch::fuzz {
namespace {

constexpr std::size_t kMostVertices = 24, kMostTriangles = 8, kMostLinks = 4;
/// Of a call's byte: from here on it is one of a moving world.
constexpr std::uint8_t kFirstOfWorlds = 192;

/// Hands the input out; zeros at its end.
class Supply {
 public:
  Supply(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}
  [[nodiscard]] bool isEmpty() const { return left_ == 0; }
  [[nodiscard]] std::uint8_t byte() {
    std::uint8_t value = 0;
    fill(&value, 1);
    return value;
  }
  void fill(void* place, std::size_t bytes) {
    const std::size_t taken = std::min(bytes, left_);
    std::memcpy(place, data_, taken);
    std::memset(static_cast<char*>(place) + taken, 0, bytes - taken);
    data_ += taken;
    left_ -= taken;
  }
  /// Mostly small numbers, so that queries are answered; any bits now and then.
  [[nodiscard]] double number() {
    const std::uint8_t kind = byte();
    if (kind < 250) return (static_cast<double>(kind) - 125.0) / 50.0;
    double value = 0.0;
    fill(&value, sizeof value);
    return value;
  }
  template <typename Struct>
  void overwriteSome(Struct& given) {
    if ((byte() & 3) != 0) return;
    fill(&given, sizeof given);
    // Whoever says more than there is has the library read what is behind: that is not asked here.
    if ((byte() & 1) == 0 || given.size > sizeof given) given.size = sizeof given;
  }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};

ft_status known(ft_status status) {
  require(std::string_view(ft_status_name(status)) != "unknown", "a status is one of the list");
  require(status != FT_ERROR_INTERNAL, "no call fails by the library's own mistake");
  require(status == FT_OK || ft_last_error()[0] != '\0', "a failure has a reason");
  return status;
}

class Calls {
 public:
  explicit Calls(Supply& supply) : supply_(supply) {}
  Calls(const Calls&) = delete;
  Calls& operator=(const Calls&) = delete;
  ~Calls() {
    ft_world_destroy(world_);
    ft_query_destroy(query_);
    ft_pair_rules_destroy(rules_);
    ft_avatar_destroy(avatar_);
    ft_scene_destroy(scene_);
  }

  [[nodiscard]] bool run() {
    makeScene();
    makeAvatar();
    makeQuery();
    for (int i = 0; i < 32 && !supply_.isEmpty(); ++i) callOne();
    return answered_;
  }

 private:
  void makeScene() {
    std::array<double, 3 * kMostVertices> positions{};
    for (double& value : positions) value = supply_.number();
    std::array<std::uint32_t, 3 * kMostTriangles> corners{};
    constexpr std::uint32_t kCorners = kMostVertices + 1;  // the last one is none
    for (std::uint32_t& corner : corners) corner = supply_.byte() % kCorners;
    std::array<std::int32_t, kMostTriangles> objects{};
    for (std::int32_t& object : objects) object = supply_.byte() % 3;
    const std::array<const char*, 2> names{"floor", "table"};
    ft_scene_arrays arrays{};
    known(ft_scene_arrays_init(&arrays, sizeof arrays));
    arrays.positions = positions.data();
    arrays.vertex_count = kMostVertices;
    arrays.indices = corners.data();
    arrays.triangle_count = supply_.byte() % (kMostTriangles + 1);
    if ((supply_.byte() & 1) != 0) {
      arrays.objects = objects.data();
      arrays.object_names = names.data();
      arrays.object_count = names.size();
    }
    const ft_status status = known(ft_scene_create(&arrays, &scene_));
    require((scene_ != nullptr) == (status == FT_OK), "a handle is there where a call succeeds");
  }

  void makeAvatar() {
    std::array<char, 2048> text{};
    if (supply_.byte() < 32) {
      supply_.fill(text.data(), text.size() - 1);
      known(ft_avatar_create_from_text(text.data(), std::strlen(text.data()), "input", &avatar_));
    }
    if (avatar_ != nullptr) return;
    constexpr std::string_view kBody =
        R"({"format":"foretouch-avatar","version":1,"links":[
{"name":"a","parent":null,"offset":[0,0,0],"lss":[{"a":[0,0,0],"b":[0,1,0],"radius":0.1}]},
{"name":"b","parent":"a","offset":[0,1,0],"lss":[{"a":[0,0,0],"b":[0,0.5,0],"radius":0.1}]}]})";
    const ft_status status =
        known(ft_avatar_create_from_text(kBody.data(), kBody.size(), "body", &avatar_));
    require(status == FT_OK, "a legal avatar is made");
  }

  void makeQuery() {
    if (scene_ == nullptr) return;
    ft_query_options options = asked();
    const ft_status status = known(ft_query_create(scene_, avatar_, &options, &query_));
    require((query_ != nullptr) == (status == FT_OK), "a handle is there where a call succeeds");
    if (query_ == nullptr) known(ft_query_create(scene_, avatar_, nullptr, &query_));
  }

  /// Legal ones, with some bytes of the input's: never its pointers.
  ft_query_options asked() {
    ft_query_options options{};
    known(ft_query_options_init(&options, sizeof options));
    const ft_query_options usual = options;
    supply_.overwriteSome(options);
    options.ignored = usual.ignored;
    options.ignored_count = usual.ignored_count;
    options.policies = usual.policies;
    options.policy_count = usual.policy_count;
    options.object_policies = usual.object_policies;
    options.object_policy_count = usual.object_policy_count;
    // Hours are not what is looked for here.
    options.work_budget = std::min<std::uint64_t>(options.work_budget, 10'000);
    if (options.work_budget == 0) options.work_budget = 10'000;
    return options;
  }

  ft_pose pose(std::vector<double>& rotations, std::vector<double>& translations) {
    std::size_t joints = 0;
    known(ft_avatar_joint_count(avatar_, &joints));
    joints = std::min(joints, kMostLinks);
    for (std::size_t j = 0; j < joints; ++j) {
      const bool isIdentity = (supply_.byte() & 3) != 0;
      for (int k = 0; k < 4; ++k) {
        rotations.push_back(isIdentity ? (k == 0 ? 1.0 : 0.0) : supply_.number());
      }
      for (int k = 0; k < 3; ++k) translations.push_back(supply_.number());
    }
    ft_pose made{};
    known(ft_pose_init(&made, sizeof made));
    made.joint_count = static_cast<std::uint32_t>(joints);
    made.rotations = rotations.data();
    made.translations = translations.data();
    return made;
  }

  void step() {
    std::vector<double> values[4];
    const ft_pose from = pose(values[0], values[1]), to = pose(values[2], values[3]);
    const bool hasFirst = (supply_.byte() & 7) != 0;
    answered_ = known(ft_query_step(query_, hasFirst ? &from : nullptr, &to)) == FT_OK || answered_;
  }

  void readLists() {
    std::array<ft_contact, kMostLinks> contacts{};
    std::array<ft_other_link, kMostLinks> others{};
    contacts[0].size = (supply_.byte() & 15) == 0 ? supply_.byte() : sizeof(ft_contact);
    const std::size_t capacity = supply_.byte() % (kMostLinks + 1);
    std::size_t count = 0;
    known(ft_query_links(query_, contacts.data(), capacity, &count));
    contacts[0].size = sizeof(ft_contact);
    known(ft_query_contacts(query_, contacts.data(), capacity, &count));
    known(ft_query_objects(query_, contacts.data(), capacity, &count));
    known(ft_query_pairs(query_, contacts.data(), others.data(), capacity, &count));
    ft_counters counters{};
    counters.size = sizeof counters;
    known(ft_query_counters(query_, &counters));
  }

  void readMotion() {
    const double t = supply_.number();
    std::array<ft_transform, kMostLinks> transforms{};
    std::size_t count = 0;
    known(ft_motion_transforms(query_, t, transforms.data(), supply_.byte() % (kMostLinks + 1),
                               &count));
    std::int32_t link = 0, touches = 0;
    supply_.fill(&link, sizeof link);
    known(ft_touches_at(query_, (link & 1) != 0 ? link : link & 3, t, &touches));
    ft_contact_details details{};
    details.size = sizeof details;
    known(ft_query_details(query_, supply_.byte() % 5, supply_.byte() % 5, &details));
  }

  void makeRules() {
    ft_pair_rule_options options{};
    known(ft_pair_rule_options_init(&options, sizeof options));
    const ft_status status = known(ft_pair_rules_create(avatar_, &options, &rules_));
    if (status == FT_OK) known(ft_query_set_pair_rules(query_, rules_));
    ft_pair_rules_destroy(rules_);
    rules_ = nullptr;
  }

  void setOptions() {
    const ft_query_options options = asked();
    known(ft_query_set_options(query_, &options));
  }

  void callWorld(int which) {
    if (world_ == nullptr) makeWorld();
    switch (which) {
      case 0: carryBody(); break;
      case 1: askWorld(); break;
      default: tellWorld(); break;
    }
  }

  void callOne() {
    const std::uint8_t kind = supply_.byte();
    if (kind >= kFirstOfWorlds) return callWorld(kind % 4);
    switch (kind % 6) {
      case 0:
      case 1: step(); break;
      case 2: readLists(); break;
      case 3: readMotion(); break;
      case 4: makeRules(); break;
      default: setOptions(); break;
    }
  }

  /// Two avatars, and a mesh if there is one.
  void makeWorld() {
    ft_world_options options{};
    known(ft_world_options_init(&options, sizeof options));
    supply_.overwriteSome(options);
    const ft_scene* const still = (supply_.byte() & 1) != 0 ? scene_ : nullptr;
    const ft_status status = known(ft_world_create(still, &options, &world_));
    require((world_ != nullptr) == (status == FT_OK), "a handle is there where a call succeeds");
    if (world_ == nullptr) known(ft_world_create(nullptr, nullptr, &world_));
    std::int32_t body = 0;
    for (int i = 0; i < 3; ++i) {
      ft_body_options ofBody{};
      known(ft_body_options_init(&ofBody, sizeof ofBody));
      ofBody.when_silent = supply_.byte() % 4;
      ofBody.group = supply_.byte() % 34;
      if (i == 2 && scene_ != nullptr) {
        known(ft_world_add_mesh(world_, scene_, &ofBody, &body));
      } else {
        known(ft_world_add_avatar(world_, avatar_, &ofBody, &body));
      }
    }
  }

  /// Mostly the next one.
  std::int64_t instant() {
    const std::uint8_t kind = supply_.byte();
    if (kind < 250) return now_ += kind % 50;
    std::int64_t any = 0;
    supply_.fill(&any, sizeof any);
    return any;
  }

  void tellWorld() {
    std::vector<double> values[2];
    ft_pose next = pose(values[0], values[1]);
    const std::int32_t body = supply_.byte() % 4 - (supply_.byte() == 0 ? 1 : 0);
    if (body == 2) next.joint_count = 1;
    known(ft_world_push(world_, body, instant(), &next));
    if (supply_.byte() < 16) {
      known(ft_world_forget_before(world_, instant()));
      known(ft_world_thin_before(world_, instant(), supply_.number()));
    }
    if (supply_.byte() < 16) {
      known(ft_world_ask(world_, supply_.byte() % 33, supply_.byte() % 33, supply_.byte() % 3));
      known(ft_world_ask_still(world_, supply_.byte() % 33, supply_.byte() % 3));
    }
  }

  void carryBody() {
    std::vector<double> values[2];
    ft_pose place = pose(values[0], values[1]);
    const std::int32_t body = supply_.byte() % 3;
    if (body == 2) place.joint_count = 1;
    ft_carrier carrier{};
    supply_.overwriteSome(carrier);
    carrier.size = sizeof carrier;
    if ((supply_.byte() & 7) != 0) {
      carrier.body = supply_.byte() % 3;
      carrier.link = supply_.byte() % 3;
      carrier.moves_in_frame = supply_.byte() % 2;
    }
    if ((supply_.byte() & 1) != 0) {
      known(ft_world_attach(world_, body, &carrier, instant(), &place));
    } else {
      known(ft_world_detach(world_, body, instant(), &place));
    }
  }

  void askWorld() {
    std::int64_t until = 0;
    std::int32_t waitsFor = 0;
    known(ft_world_known_until(world_, &until, &waitsFor));
    const std::int64_t to = (supply_.byte() & 7) != 0 ? until : instant();
    known(ft_world_answer(world_, (supply_.byte() & 7) != 0 ? until - 60 : instant(), to));
    std::array<ft_world_contact, 2 * kMostLinks> contacts{};
    contacts[0].size = sizeof(ft_world_contact);
    std::array<ft_silent_body, 3> silent{};
    silent[0].size = sizeof(ft_silent_body);
    ft_world_counters counters{};
    counters.size = sizeof counters;
    std::size_t count = 0;
    known(ft_world_contacts(world_, contacts.data(), contacts.size(), &count));
    known(ft_world_silent(world_, silent.data(), silent.size(), &count));
    known(ft_world_get_counters(world_, &counters));
  }

  Supply& supply_;
  ft_scene* scene_ = nullptr;
  ft_avatar* avatar_ = nullptr;
  ft_pair_rules* rules_ = nullptr;
  ft_query* query_ = nullptr;
  ft_world* world_ = nullptr;
  std::int64_t now_ = 0;
  bool answered_ = false;
};

}  // namespace

bool feedCalls(const std::uint8_t* data, std::size_t size) {
  Supply supply(data, size);
  Calls calls(supply);
  return calls.run();
}

}  // namespace foretouch::fuzz
