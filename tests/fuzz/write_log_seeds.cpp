// write_log_seeds FOLDER: seeds for fuzz_log, into an existing folder. What they hold is of no
// consequence but for its shape; the ids of logs are drawn anew every time.
#include <cstdio>
#include <fstream>
#include <string>

#include "tests/network/log/log_samples.h"

int main(int argc, char** argv) {
  using namespace foretouch;
  using namespace foretouch::test;
  if (argc != 2) {
    std::fprintf(stderr, "usage: write_log_seeds FOLDER\n");
    return 2;
  }
  const auto write = [&](const std::string& name, const Bytes& bytes) {
    std::ofstream(std::string(argv[1]) + "/" + name, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  };
  LogWriteOptions small;
  small.blockBytes = 120;
  const Bytes own = ownLog(numberedEvents(6, 30), small);
  const Bytes foreign = foreignLog(numberedEvents(3, 20));
  write("own_one_block", ownLog(numberedEvents(3, 10)));
  write("own_blocks", own);
  write("own_empty", ownLog({}));
  write("own_torn", Bytes(own.begin(), own.end() - 200));
  write("foreign", foreign);
  write("foreign_no_payload", foreignLog(numberedEvents(4, 0)));
  Bytes both = foreign;
  append(both, own);
  write("foreign_then_own", both);
  both = own;
  append(both, ownLog(numberedEvents(2, 5)));
  write("own_then_own", both);
  both = own;
  append(both, foreign);
  write("own_then_foreign", both);
  Bytes damaged = own;
  damaged[own.size() / 2] ^= 0x40;
  write("own_flipped", damaged);
  std::vector<LogEvent> nesting = numberedEvents(3, 10);
  nesting[1].payload = foreign;
  write("foreign_in_foreign", foreignLog(nesting));
  nesting[1].payload = own;
  write("own_in_own", ownLog(nesting));
  Bytes lengths = foreign;
  lengths[24] = 0x7F;
  lengths[25] = lengths[26] = lengths[27] = 0xFF;
  write("huge_length", lengths);
  write("magic_only", {0xED, 0xA1, 0xDA, 0x01});
  write("nothing_of_a_log", Bytes(40, 'x'));
  write("empty", {});
}
