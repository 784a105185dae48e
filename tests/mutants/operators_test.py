"""The mutants of a text are those that one would make by hand, and no others."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
from operators import mutants_of  # noqa: E402

SAMPLE = '''#include <vector>  // a < b
std::vector<double> all(3 + n);
if (a < b && std::min(a, c) > 0.5) return true;  // x < y
/* p < q
   p + q */
const char* text = "a < b + 1";
static_assert(kMost < 7);
x = r[i] - ring[k + 1];
  out.push_back(-gap);
'''
EXPECTED = {
    (2, "+", "-"), (2, "+ n", "nothing"),
    (3, "<", "<="), (3, "<", ">="), (3, ">", ">="), (3, ">", "<="), (3, "&&", "||"), (3, "std::min(", "std::max("),
    (3, "0.5", "(0.5 * 0.5)"), (3, "return true;", "return false;"),
    (8, "-", "+"), (8, "+", "-"), (8, "[i]", "[i + 1]"), (8, "+ 1]", "]"),
    (9, "-", "nothing"), (9, "out.push_back(-gap);", ";"),
}

found = list(mutants_of("sample.cpp", SAMPLE))
said = {(m.line, m.before.strip(), m.after.strip() or "nothing") for m in found}
assert said >= EXPECTED, sorted(EXPECTED - said)
assert {line for line, _, _ in said} == {2, 3, 8, 9}, said
for mutant in found:
    changed = mutant.applied(SAMPLE).split("\n")
    different = [i for i, line in enumerate(SAMPLE.split("\n"), 1) if changed[i - 1] != line]
    assert different == [mutant.line], mutant
keys = [m.key for m in found]
assert len(set(keys)) == len(keys), "two mutants of one name"
print(f"{len(found)} mutants of the sample")
