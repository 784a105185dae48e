"""What a C library's mathematics answer, as a digest: those functions that answers follow from and
that are not rounded correctly. glibc has some of them once for processors that multiply and add in
one rounding and once for all others, so PLAIN asks for the latter, which every x86-64 runs alike.

    env $PLAIN python3 mathematics.py
"""
import hashlib
import math
import struct

PLAIN = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-FMA,-FMA4"}

FUNCTIONS = (math.sin, math.cos, math.tan, math.atan, math.exp,
             lambda x: math.asin(x / 32), lambda x: math.acos(x / 32),
             lambda x: math.atan2(x, 1.3), lambda x: math.log(abs(x) + 0.1),
             lambda x: math.log10(abs(x) + 0.1), lambda x: math.pow(abs(x) + 0.1, 1.7))


def fingerprint():
    answers = hashlib.sha256()
    for function in FUNCTIONS:
        for i in range(8000):
            answers.update(struct.pack("<d", function((i - 4000) * 0.0078125001)))
    return answers.hexdigest()[:16]


if __name__ == "__main__":
    print(fingerprint())
