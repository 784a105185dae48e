// The small avatars of tests/assets/vrm_writer.h as files, for vrm_oracle.mjs.
//   write_vrm FOLDER
#include <fstream>
#include <iostream>
#include <string>

#include "tests/assets/vrm_writer.h"

int main(int argc, char** argv) {
  using foretouch::test::VrmVersion;
  if (argc != 2) {
    std::cerr << "write_vrm FOLDER\n";
    return 2;
  }
  for (const auto& [version, name] :
       {std::pair(VrmVersion::Old, "/vrm_0.vrm"), std::pair(VrmVersion::One, "/vrm_1.vrm")}) {
    std::ofstream file(argv[1] + std::string(name), std::ios::binary);
    file << foretouch::test::vrmSample(version).file.glb();
    if (!file.flush()) return 1;
  }
}
