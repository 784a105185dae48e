// tests/tools/stream/plain_subscriber.cpp: what a user of LCM writes who has nothing of ours but
// the types:
//   plain_subscriber URL N
// prints "ready", a line for each of N contacts_t, and one for the status_t that comes after them.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <lcm/lcm-cpp.hpp>
#include <string>

#include "foretouch/contacts_t.hpp"
#include "foretouch/status_t.hpp"

namespace {

class Subscriber {
 public:
  void onContacts(const lcm::ReceiveBuffer*, const std::string&,
                  const foretouch::contacts_t* message) {
    ++contacts_;
    std::printf("contacts %lld %d", static_cast<long long>(message->sequence_to),
                message->num_contacts);
    for (const std::string& name : message->link_names) std::printf(" %s", name.c_str());
    std::printf("\n");
    std::fflush(stdout);
  }
  void onStatus(const lcm::ReceiveBuffer*, const std::string&, const foretouch::status_t* message) {
    answered_ = message->answered;
    std::printf("status %lld of %lld in %s\n", static_cast<long long>(message->answered),
                static_cast<long long>(message->received), message->scene.c_str());
    std::fflush(stdout);
  }
  [[nodiscard]] bool hasAll(long count) const { return contacts_ >= count && answered_ >= count; }

 private:
  long contacts_ = 0;
  long long answered_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  lcm::LCM lcm(argv[1]);
  if (!lcm.good()) return 2;
  Subscriber subscriber;
  lcm.subscribe("FORETOUCH_CONTACTS", &Subscriber::onContacts, &subscriber)
      ->setQueueCapacity(10000);
  lcm.subscribe("FORETOUCH_STATUS", &Subscriber::onStatus, &subscriber);
  const long count = std::strtol(argv[2], nullptr, 10);
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!subscriber.hasAll(count)) {
    constexpr int kWaitMs = 100;
    if (std::chrono::steady_clock::now() > end) return 1;
    if (lcm.handleTimeout(kWaitMs) < 0) return 2;
  }
  return 0;
}
