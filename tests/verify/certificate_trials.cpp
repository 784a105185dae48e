// certificate_trials [EDGES] [LIES] [SEED]: until so many clear edges are verified (100,000) and so
// many lies told (10,000). Exit code 1 where a proof was refused or a lie believed.
#include <cstdint>
#include <cstdio>
#include <string>

#include <CLI/CLI.hpp>

#include "tests/verify/certificate_trial.h"

int main(int argc, char** argv) {
  using namespace foretouch::test;
  long long edges = 100'000, lies = 10'000;
  std::uint64_t seed = 0;
  CLI::App app{
      "Certifies random edges of an arm, verifies them, and tells lies that must be refused"};
  app.add_option("edges", edges, "Clear ones")->check(CLI::Range(1, 1'000'000'000));
  app.add_option("lies", lies, "About these")->check(CLI::Range(0, 1'000'000'000));
  app.add_option("seed", seed, "The first");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  CertificateTally tally;
  int broken = 0;
  for (; tally.clear < edges && broken < 20; ++seed) {
    // So that the lies are spread over all edges.
    const bool isDue = tally.lies * edges < lies * (tally.clear + 1);
    const int told = isDue ? static_cast<int>((lies + edges - 1) / edges) : 0;
    const std::string why = runCertificateTrial(seed, told, tally);
    if (why.empty()) continue;
    ++broken;
    std::printf("seed %llu: %s\n", static_cast<unsigned long long>(seed), why.c_str());
  }
  const double clear = static_cast<double>(tally.clear);
  std::printf(
      "%lld random edges, %lld clear: %lld verified, %lld without a proof\n"
      "an edge: %.1f spans, %.1f planes, %.0f bytes; %.0f us to answer, %.0f us to write, %.0f us "
      "to "
      "verify\n%lld lies, %lld believed\n",
      static_cast<long long>(tally.edges), static_cast<long long>(tally.clear),
      static_cast<long long>(tally.verified), static_cast<long long>(tally.unproven),
      static_cast<double>(tally.spans) / clear, static_cast<double>(tally.planes) / clear,
      static_cast<double>(tally.bytes) / clear,
      1e6 * tally.answerS / static_cast<double>(tally.edges), 1e6 * tally.writeS / clear,
      1e6 * tally.verifyS / clear, static_cast<long long>(tally.lies),
      static_cast<long long>(tally.believed));
  for (int kind = 0; kind < 8; ++kind) {
    std::printf("  %-22s%lld\n", kindOfLie(kind), static_cast<long long>(tally.ofKind[kind]));
  }
  return broken == 0 ? 0 : 1;
}
