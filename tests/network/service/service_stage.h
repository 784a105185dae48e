// tests/network/service/service_stage.h: a service with all that surrounds it, in this process and
// under a test's control, and messages for it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "network/service/service.h"
#include "network/wire/codec.h"
#include "tests/network/service/service_fakes.h"
#include "tests/network/small_stream.h"

namespace foretouch::test {

inline const std::string kContacts = kContactsChannel;
inline const std::string kPoses = kPoseChannel;
inline const std::string kSkeletons = kSkeletonChannel;

inline std::vector<StreamSolver> solversOf(std::int32_t avatars, bool areSolid = false) {
  const Scene scene = farWall();
  std::vector<StreamSolver> solvers;
  for (std::int32_t id = 0; id < avatars; ++id) {
    solvers.push_back(StreamSolver::make(id, smallAvatar(), scene, {}, {}).value());
    const bool isMade = !areSolid || solvers.back().makeSolid({}).ok();
    EXPECT_TRUE(isMade);
  }
  return solvers;
}

template <typename Message>
Bytes bytesOf(const Message& message) {
  Bytes payload;
  encode(message, payload);
  return payload;
}

inline Bytes skeletonOf(std::int32_t avatar) {
  SkeletonMessage message = skeletonMessage(smallSkeleton());
  message.avatar = avatar;
  return bytesOf(message);
}

/// Back and forth across the wall.
inline Bytes poseOf(std::int32_t avatar, std::int64_t sequence) {
  PoseMessage message = nthPose(sequence);
  message.avatar = avatar;
  message.translations[0].translation = {0.4 * static_cast<double>(sequence % 4 + avatar), 1, 0};
  return bytesOf(message);
}

inline ContactsMessage answerIn(const Bytes& payload) {
  ContactsMessage answer;
  EXPECT_EQ(decode(payload, answer), Reject::None);
  return answer;
}

inline std::uint64_t rejectsFor(const ServiceCounts& counts, Reject reason) {
  return counts.rejects[static_cast<std::size_t>(reason)];
}

/// A service with all that surrounds it.
class Stage {
 public:
  explicit Stage(std::int32_t avatars = 1, ServiceOptions options = {}, bool isRecorded = false,
                 StepObserver* observer = nullptr, bool areSolid = false,
                 std::optional<WorldSolver> world = std::nullopt,
                 std::vector<PersonStream> persons = {}) {
    ServiceParts parts;
    parts.receiver = std::make_unique<FakeReceiver>(inbox);
    parts.publisher = std::make_unique<FakePublisher>(outbox);
    if (isRecorded) parts.journal = std::make_unique<FakeSink>(book);
    parts.clock = &clock;
    parts.observer = observer;
    parts.world = std::move(world);
    parts.persons = std::move(persons);
    service_.emplace(
        Service::start(solversOf(avatars, areSolid), std::move(parts), options).value());
  }
  Service& service() { return *service_; }

  void sendSkeletons(std::int32_t avatars) {
    for (std::int32_t id = 0; id < avatars; ++id) inbox->send(kSkeletons, skeletonOf(id));
  }
  /// True once as many poses have come and each has its fate.
  bool settles(std::uint64_t received) {
    return eventually([&] {
      const ServiceCounts counts = service_->counts();
      return counts.received == received && counts.waiting == 0;
    });
  }

  FakeClock clock;
  std::shared_ptr<Inbox> inbox = std::make_shared<Inbox>();
  std::shared_ptr<Outbox> outbox = std::make_shared<Outbox>();
  std::shared_ptr<Book> book = std::make_shared<Book>();

 private:
  std::optional<Service> service_;
};

inline ServiceOptions withWorkers(int workers, std::size_t queue = 10'000) {
  ServiceOptions options;
  options.workers = workers;
  options.queue = queue;
  return options;
}

}  // namespace foretouch::test
