"""What may differ from one run of the program to the next, masked; all else stays byte for byte.

Masked are
- times that were measured (latencies, when a message came and went): they are the machine's;
- the version of the program: a new version is no other answer, and what is a mark of it;
- the identity of an event log, which is drawn at random, and the check sums that it seeds;
- the time at which a live sender began, and the order of events in a service's journal, which is
  that of arrival.
Sentences for people in reports are a part of their own, as their wording may be mended.
"""
import hashlib
import json
import re
import struct

MASK = b"#"


def _masked(pattern, text):
    """`text` with everything but the first group of each match masked."""
    return re.sub(pattern, lambda match: match.group(1) + MASK, text)


def _without_version(text):
    text = _masked(rb'("(?:tool|build)":")[^"]*', text)
    return _masked(rb'("generator":"foretouch )\d+\.\d+\.\d+', text)


def plain(content):
    """Nothing may differ."""
    return {"": content}


def results(content):
    """Results of `replay`: the version, and how long each query took."""
    return {"": _masked(rb'("latency_us":)[0-9.e+-]+', _without_version(content))}


def summary(content):
    """What `--json` prints of a replay: how long questions took, and where files are that were
    named by their folders."""
    content = re.sub(rb'("latency_us":)\{[^}]*\}', rb"\1#", content)
    return {"": re.sub(rb'":"/[^"]*/', b'":"', content)}


def marked(content):
    """Shown poses: the version, and the marks of lines, which follow from it. Not those of poses
    and of input files."""
    return {"": _masked(rb'("mark":")[^"]*', _without_version(content))}


def figures(content):
    """The numbers of a summary, line by line, whatever words stand between them. Not those of
    lines that tell times (us, s) or where files are."""
    lines = []
    for line in content.decode().splitlines():
        if re.search(r"\bus\b|\blatency\b|/", line):
            continue
        numbers = re.findall(r"(?<![\w.])-?\d+(?:\.\d+)?(?:e-?\d+)?(?!\w)", line)
        if numbers:
            lines.append(" ".join(numbers))
    return {"": "\n".join(lines).encode() + b"\n"}


def _members(text):
    """The members of a JSON object as they are written: name, text of the value."""
    decoder, at = json.JSONDecoder(), 1
    while text[at] != "}":
        name, at = decoder.raw_decode(text, at + (text[at] == ","))
        begin = at + 1
        _, at = decoder.raw_decode(text, begin)
        yield name, text[begin:at]


def document(content):
    """A view document, alone or in its page: latencies, the version. The page around it is the
    viewer's own. A member a line, those that hold sentences as a part of their own."""
    found = re.search(rb'id="foretouch-view">(.*?)</script>', content, re.DOTALL)
    text = _without_version(found.group(1) if found else content).strip()
    text = _masked(rb'("latency_us":\{"f64":")[^"]*', text)
    text = re.sub(rb"p50 [0-9.]+ us, p99 [0-9.]+ us", b"p50 # us, p99 # us", text)
    parts = {"data": [], "words": []}
    for name, value in _members(text.decode()):
        isWords = name in ("title", "settings", "summary", "notes")
        parts["words" if isWords else "data"].append(f"{name}: {value}\n")
    return {part: "".join(lines).encode() for part, lines in parts.items()}


def glb(content):
    """A GLB: the version in its JSON. Its binary chunk as it is."""
    magic, _, _, size = struct.unpack_from("<4sIII", content)
    text, rest = content[20:20 + size].rstrip(b" "), content[20 + size + 8:]
    return {"json": magic + b" " + _without_version(text) + b"\n", "binary": rest}


LOG_EVENT = struct.Struct(">IqqII")


def _unseeded(payload):
    """A block event without what follows from the log's random id: the id and both hashes."""
    return payload[:8] + bytes(8) + payload[16:88] + bytes(16) + payload[104:]


def event_log(content):
    """An LCM event log, a line an event: the ids and check sums of its blocks."""
    lines, at = [], 0
    while at < len(content):
        _, number, stamp, name, size = LOG_EVENT.unpack_from(content, at)
        at += LOG_EVENT.size
        channel, payload = content[at:at + name], content[at + name:at + name + size]
        at += name + size
        if channel == b"FORETOUCH_LOG_BLOCK":
            payload = _unseeded(payload)
        lines.append(f"{number} {stamp} {channel.decode()} {payload.hex()}\n")
    return {"": "".join(lines).encode()}


def _since(session):
    """Turns a time of this session into microseconds since it began."""
    return lambda match: match.group(1) + re.sub(
        rb"\d+", lambda time: b"%d" % (int(time.group()) - session), match.group(2))


def _answer(line):
    """A line of a live stream: times since its sender began; none of the machine's."""
    line = _masked(rb'("(?:receive_utime|query_us)":)[0-9.e+-]+', _without_version(line))
    session = re.search(rb'"session":(\d+)', line)
    if session is None:
        return line
    line = re.sub(rb'("utime":)(\[?[\d,]+)', _since(int(session.group(1))), line)
    return _masked(rb'("(?:session|send_utime)":)\d+', line)


def answers(content):
    """Answers of a live stream, and results of its journal; in the order of their poses."""
    return {"": b"".join(_answer(line) for line in content.splitlines(keepends=True)
                         if not line.startswith(b'{"status"'))}


def journal(content):
    """A service's journal as lines: skeletons, poses and answers, each kind in its own order, as
    often as they differ. Heartbeats are left out: how many there are is a matter of time."""
    lines = set()
    for line in content.splitlines(keepends=True):
        event = json.loads(line)
        if "status" in event or "bytes" in event:
            continue
        kind = next(key for key in ("contacts", "pose", "skeleton") if key in event)
        sequence = event[kind].get("sequence", 0)
        order = (kind, sequence[1] if kind == "contacts" else sequence)
        line = _masked(rb'("(?:event|received)":)\d+', line)
        lines.add((order, _answer(line)))
    return {"": b"".join(line for _, line in sorted(lines))}


def log_info(content):
    """`log info --json`: where the file lies, and the ids that findings may name."""
    return {"": _masked(rb'("file":")[^"]*', content)}


def metrics(content):
    """A service's /metrics: which there are and what they mean. Their values are the machine's, the
    version and the scene's place labels of one."""
    content = re.sub(rb'(build|scene)="[^"]*"', rb'\1="#"', content)
    names = [line if line.startswith(b"#") else re.sub(rb" \S+$", b" #", line)
             for line in content.splitlines()]
    return {"": b"\n".join(names) + b"\n"}


def example(content):
    """What the Python example prints: how long steps took, and whether it can plot."""
    content = content.replace(b"no matplotlib: no plot\n", b"")
    return {"": re.sub(rb" +[0-9.]+ us", b" # us", content)}


def digest(content):
    return hashlib.sha256(content).hexdigest()


def holds(content):
    """What a normalised output holds, in a few words, so that a moved digest says by how much."""
    if content.startswith(b'{"format":"foretouch-results"'):
        newlines = content.count(b"\n")
        words = [f"{newlines - 1} lines"]
        for verdict in ("contact", "starts_in_contact", "undecided"):
            count = content.count(f'"verdict":"{verdict}"'.encode())
            words += [f"{count} {verdict}"] if count else []
        return ", ".join(words)
    return f"{len(content)} bytes"
