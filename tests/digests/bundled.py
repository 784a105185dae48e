"""Cases that need no data but the bundled example: replays, pages, sweeps, logs, a live stream, C
and Python."""
import normalise
from case import ROOM, Case, foretouch, run, text

DANCER = "--avatar {examples}/dancer.avatar.json --motion {examples}/dancer.bvh"
BUNDLED = f"{ROOM} {DANCER} --rate 10 --threads 1"

POLICY = """
[[policy]]
links = ["*Hand*", "*Arm"]
tolerance = 0.0001

[[policy]]
links = ["*Foot", "*Toe*"]
objects = ["floor"]
ignore = true
"""

# Ways to ask about the bundled example that leave results of their own. None has --culler or
# --leaves: the program has those options no more. What they chose is held against what it does in
# tests/middleware/, tests/examples/ and tests/oracle/.
WAYS = {
    "every-pose": "--rate all",
    "first-of-avatar": "--scope avatar",
    "objects": "--scope objects --pass-separating",
    "own-links": "--self",
    "own-links-exact": "--self --fidelity exact --rate 5",
    "budget": "--budget-us 5",
    "budget-unspent": "--budget-us 100000",
    "fine": "--tolerance 1e-6",
    "coarse": "--tolerance 0.02",
    "two-threads": "--threads 2",
    "policy": "--policy policy.toml",
    "ignore": "--ignore *Foot:floor,Hips",
    "placed": "--place 0.3,0,0.2,30 --rate 5",
    "lying": "--motion-up z --place 0,1,0",
    "small-scene": "--scene-scale 0.8",
}
SHORT_WAYS = ("budget", "policy")


def way_cases():
    for name, options in WAYS.items():
        given = {word for word in options.split() if word.startswith("--")}
        usual = {"--rate": "10", "--threads": "1"}
        rest = " ".join(f"{key} {value}" for key, value in usual.items() if key not in given)
        yield Case(f"bundled/{name}",
                   [text("policy.toml", POLICY),
                    foretouch(f"replay {ROOM} {DANCER} {rest} {options} --output contacts.jsonl")],
                   {"contacts.jsonl": normalise.results}, short=name in SHORT_WAYS)


def bundled_cases():
    yield Case("bundled/demo", [foretouch("demo --output demo.jsonl --report demo.html")],
               {"demo.jsonl": normalise.results, "demo.html": normalise.document}, short=True)
    yield Case("bundled/inputs", [run("cp {examples}/room.obj {examples}/dancer.bvh "
                                      "{examples}/dancer.avatar.json .")],
               {"room.obj": normalise.plain, "dancer.bvh": normalise.plain,
                "dancer.avatar.json": normalise.plain}, short=True)
    yield Case("bundled/glb",
               [foretouch(f"replay {BUNDLED} --output contacts.jsonl --glb motion.glb"),
                foretouch(f"replay {BUNDLED} --output contacts.jsonl --glb few.glb "
                          "--glb-triangles 20000")],
               {"motion.glb": normalise.glb, "few.glb": normalise.glb}, short=True)
    yield Case("bundled/report",
               [text("policy.toml", POLICY),
                foretouch(f"replay {BUNDLED} --output contacts.jsonl --report few.html "
                          "--report-triangles 20000 --budget-us 5 --policy policy.toml")],
               {"few.html": normalise.document})
    yield Case("bundled/view",
               [foretouch(f"view {ROOM} {DANCER} --rate 10 --output all.html"),
                foretouch("view {examples}/dancer.avatar.json --output avatar.html"),
                foretouch("view {examples}/room.obj --scene-scale 0.01 --output room.html")],
               {"all.html": normalise.document, "avatar.html": normalise.document,
                "room.html": normalise.document})


def sweep_cases():
    sweep = f"sweep {DANCER} --rate 10 --links LeftHand,RightForeArm --from 2 --to 3 --error 0.004"
    yield Case("bundled/sweep",
               [foretouch(f"{sweep} --output outer.{kind}") for kind in ("ply", "obj", "glb")]
               + [foretouch(f"{sweep} --inner --output inner.{kind}") for kind in ("ply", "glb")],
               {"outer.ply": normalise.plain, "outer.obj": normalise.plain,
                "outer.glb": normalise.glb, "inner.ply": normalise.plain,
                "inner.glb": normalise.glb}, short=True)


# ---- logs and streams ----

SENT = ("publish {examples}/dancer.bvh --avatar {examples}/dancer.avatar.json --rate 10 "
        "--start 1700000000000000 --output sent.lcmlog")
REPLAY_SENT = (f"replay {ROOM} --avatar {{examples}}/dancer.avatar.json --motion sent.lcmlog "
               "--output answers.jsonl")


def damaged(copy, change):
    """A step that leaves a changed copy of the sent log."""
    def write(folder):
        (folder / copy).write_bytes(change((folder / "sent.lcmlog").read_bytes()))
    return write


def flipped(log):
    middle = len(log) // 2
    return log[:middle] + bytes([log[middle] ^ 0xff]) + log[middle + 1:]


def cut(log):
    return log[:len(log) * 3 // 4]


def log_cases():
    convert = [foretouch("log convert sent.lcmlog --output sent.jsonl"),
               foretouch("log convert sent.lcmlog --output sent.bvh"),
               foretouch("log info --json sent.lcmlog", "info.json"),
               foretouch("log recover sent.lcmlog --output again.lcmlog")]
    yield Case("log/sent", [foretouch(SENT), *convert],
               {"sent.lcmlog": normalise.event_log, "sent.jsonl": normalise.plain,
                "sent.bvh": normalise.plain, "info.json": normalise.log_info,
                "again.lcmlog": normalise.event_log}, short=True)
    yield Case("log/replayed", [foretouch(SENT), foretouch(f"{REPLAY_SENT} --report report.html")],
               {"answers.jsonl": normalise.results, "report.html": normalise.document}, short=True)
    yield Case("log/policy",
               [foretouch(SENT), text("policy.toml", POLICY),
                foretouch(f"{REPLAY_SENT} --policy policy.toml --budget-us 5")],
               {"answers.jsonl": normalise.results})
    for name, change in (("flipped", flipped), ("cut", cut)):
        yield Case(f"log/{name}",
                   [foretouch(SENT), damaged("torn.lcmlog", change),
                    foretouch("log convert torn.lcmlog --output torn.jsonl", "converted", None),
                    foretouch("log check --json torn.lcmlog", "check.json", 1),
                    foretouch("log recover torn.lcmlog --keep-tail --output whole.lcmlog")],
                   {"torn.jsonl": normalise.plain, "converted": normalise.figures,
                    "check.json": normalise.log_info,
                    "whole.lcmlog": normalise.event_log})
    for file in ("lcm_joint_test.lcmlog", "lcmcore_testlog.lcm"):
        log = "{data}/lcm/logs/" + file
        yield Case(f"log/{file}",
                   [run(f"cp {log} foreign.lcmlog"),
                    foretouch("log convert foreign.lcmlog --output lines.jsonl"),
                    foretouch("log info --json foreign.lcmlog", "info.json"),
                    foretouch("log recover foreign.lcmlog --output whole.lcmlog")],
                   {"lines.jsonl": normalise.plain, "info.json": normalise.log_info,
                    "whole.lcmlog": normalise.event_log}, [f"lcm/logs/{file}"])


def live_cases():
    """A service, a sender and a listener. What viewers are sent is left out: how many steps they
    are shown is a matter of time."""
    yield Case("live/bundled",
               [run("{source}/tests/network/in_namespace.sh {python} "
                    "{source}/tests/digests/live.py {foretouch} {examples}/room.obj "
                    "{examples}/dancer.avatar.json {examples}/dancer.bvh 137"),
                foretouch("log convert journal.lcmlog --output journal.jsonl"),
                foretouch(f"replay {ROOM} --avatar {{examples}}/dancer.avatar.json --motion "
                          "journal.lcmlog --output answers.jsonl")],
               {"heard.jsonl": normalise.answers, "journal.jsonl": normalise.journal,
                "answers.jsonl": normalise.answers, "view.json": normalise.document,
                "metrics": normalise.metrics}, tools=["network"])


# ---- other languages ----

def language_cases():
    room, dancer = "{examples}/room.obj", "{examples}/dancer.avatar.json {examples}/dancer.bvh"
    yield Case("c/example", [run("{c}/swing", "swing.txt")], {"swing.txt": normalise.plain},
               tools=["c"])
    yield Case("c/contacts", [run(f"{{c}}/contacts {room} {dancer} 6 link work.txt", "said.txt")],
               {"said.txt": normalise.plain, "work.txt": normalise.plain}, tools=["c"])
    yield Case("python/example",
               [run("{python} {source}/bindings/python/example/hand_through_railing.py --output .",
                    "said.txt")],
               {"said.txt": normalise.example, "hand.obj": normalise.plain}, tools=["packages"])
    yield Case("python/contacts",
               [run(f"{{python}} {{source}}/tests/digests/contacts.py {room} {dancer} 6 link "
                    "work.txt swept.txt", "said.txt")],
               {"said.txt": normalise.plain, "work.txt": normalise.plain,
                "swept.txt": normalise.plain}, tools=["packages"])



def every_case():
    for kind in (bundled_cases, way_cases, sweep_cases, log_cases, live_cases, language_cases):
        yield from kind()
