"""python3 send_osc.py WORDS.json: sends its packets by liblo, numbers as floats."""

import json
import sys

import liblo

with open(sys.argv[1]) as file:
    words = json.load(file)
target = liblo.Address("127.0.0.1", words["port"])
for packet in words["packets"]:
    messages = [liblo.Message(address, *(a if isinstance(a, str) else ("f", a) for a in args))
                for address, *args in packet]
    if len(messages) == 1:
        liblo.send(target, messages[0])
    else:
        liblo.send(target, liblo.Bundle(*messages))
