"""Cases of what moves: worlds, their events and triggers, solid avatars, a robot's edges, and
certificates. Most need the bundled examples alone; those of recordings are at the end."""
import normalise
from case import ROOM, Case, foretouch, run, text

EXAMPLES = ("room.obj", "dancer.avatar.json", "dancer.bvh", "ball.csv", "stage.toml", "desk.obj",
            "hand.avatar.json", "hand.bvh")
HERE = [run("cp " + " ".join(f"{{examples}}/{name}" for name in EXAMPLES) + " .")]
BUNDLED = f"{ROOM} --avatar {{examples}}/dancer.avatar.json --motion {{examples}}/dancer.bvh"

# ---- Worlds ----

HEAD = """format = "foretouch-world"
version = 1
"""
ROOM_AND_ANNA = """
[scene]
file = "room.obj"
[[body]]
name = "anna"
avatar = "dancer.avatar.json"
mass = 58
self = true
[body.clip]
file = "dancer.bvh"
rate = 20
from = 4
until = 6
"""

# Boxes and balls on clocks of their own, one group of which is not asked, with meshes that meet.
PROPS = HEAD + """ask_meshes = true
[query]
tolerance = 0.0005
""" + ROOM_AND_ANNA + """
[[body]]
name = "crate"
box = { low = [-0.3, 0, -0.3], high = [0.3, 0.5, 0.3] }
group = "freight"
[[body.pose]]
time = 0
position = [1.5, 0.3, 0.4]
[[body.pose]]
time = 0.7
position = [0.2, 0.1, 0.1]
yaw = 70
[[body.pose]]
time = 2
position = [-1.2, 0.4, -0.2]
yaw = 200
[[body]]
name = "second crate"
box = { low = [-0.2, 0, -0.2], high = [0.2, 0.4, 0.2] }
group = "freight"
position = [0.1, 0.5, 0.2]
[[body]]
name = "ball"
sphere = 0.11
group = "balls"
when_silent = "hold-still"
[[body.pose]]
time = 0.2
position = [-0.6, 1.4, 0.9]
[[body.pose]]
time = 0.9
position = [0.3, 0.9, -0.1]
[[body]]
name = "rod"
lss = [{ a = [-0.5, 0, 0], b = [0.5, 0, 0], radius = 0.02 },
       { a = [0.5, 0, 0], b = [0.5, 0.3, 0], radius = 0.04 }]
group = "balls"
when_silent = "undecided"
[[body.pose]]
time = 0.1
position = [0.4, 1.1, 0.5]
[[body.pose]]
time = 1.3
position = [-0.2, 1.0, 0.1]
rotation = [0.8, 0, 0.6, 0]
[[ask]]
group = "freight"
with = "scene"
asked = false
[[ask]]
group = "balls"
with = "balls"
asked = false
"""

# Carriers of carriers: a tray in a hand, a cup that slides on it, taken by another hand, let go of.
CARRIERS = HEAD + ROOM_AND_ANNA + """
[[body]]
name = "ben"
avatar = "dancer.avatar.json"
mass = 71
when_silent = "undecided"
[body.clip]
file = "dancer.bvh"
place = "0.2,0,0.45,180"
rate = 15
from = 5
until = 7
speed = 1.25
[[body]]
name = "tray"
box = { low = [-0.2, -0.01, -0.15], high = [0.2, 0.01, 0.15] }
mass = 1.2
[[body.attach]]
time = 0
to = "anna"
link = "LeftHand"
position = [0.1, -0.1, 0]
[[body.attach]]
time = 1.1
to = "ben"
link = "RightHand"
[[body.detach]]
time = 1.25
position = [0.2, 0.8, 0.4]
[[body]]
name = "cup"
lss = [{ a = [0, 0.04, 0], b = [0, 0.09, 0], radius = 0.035 }]
mass = 0.3
[[body.attach]]
time = 0.1
to = "tray"
moves = true
position = [0.1, 0.02, 0]
[[body.pose]]
time = 0.5
position = [-0.1, 0.02, 0.05]
[[body.pose]]
time = 0.8
position = [-0.15, 0.02, 0.1]
[[body.detach]]
time = 0.8
[[body.pose]]
time = 1.3
position = [0, 0.05, 0.3]
"""

# Volumes of every kind: who is in them, by body and by link; they stand, move and are carried.
TRIGGERS = CARRIERS + """
[[trigger]]
name = "middle"
box = { low = [-0.4, 0, -0.4], high = [0.4, 1.2, 0.4] }
by_link = true
watches = [{ body = "anna" }, { body = "cup" }]
[[trigger]]
name = "about the hand"
sphere = 0.35
watches = [{ body = "ben", link = "RightHand" }, { body = "ben", link = "LeftHand" },
           { body = "tray" }]
[[trigger.attach]]
time = 0
to = "anna"
link = "RightHand"
position = [0, 0, 0]
[[trigger]]
name = "scanner"
lss = [{ a = [-1, 0, 0], b = [1, 0, 0], radius = 0.05 }]
[[trigger.pose]]
time = 0
position = [0, 0.1, 0.2]
[[trigger.pose]]
time = 1.5
position = [0, 1.7, 0.2]
[[trigger]]
name = "desk"
mesh = "cube.obj"
scale = 0.6
position = [0.3, 0.4, 0.3]
yaw = 25
"""
CUBE = "".join(f"v {x} {y} {z}\n" for x in (0, 1) for y in (0, 1) for z in (0, 1)) + \
    "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n"

FIVE = "--json --output contacts.jsonl --events events.jsonl --report report.html --glb world.glb"
FIVE_OUTPUTS = {"summary": normalise.summary, "contacts.jsonl": normalise.results,
                "events.jsonl": normalise.results, "report.html": normalise.document,
                "world.glb": normalise.glb}


def world_cases():
    stage = "world replay stage.toml"
    yield Case("world/stage", [*HERE, foretouch(f"{stage} --until 4 {FIVE}", "summary")],
               FIVE_OUTPUTS, short=True)
    yield Case("world/stage-all", [*HERE, foretouch(f"{stage} {FIVE}", "summary")], FIVE_OUTPUTS)
    yield Case("world/stage-rate",
               [*HERE, foretouch(f"{stage} --rate 8 --from 1 --until 5 --tolerance 0.01 "
                                 "--output contacts.jsonl", "figures")],
               {"contacts.jsonl": normalise.results, "figures": normalise.figures}, short=True)
    yield Case("world/check",
               [*HERE, text("cube.obj", CUBE), text("props.toml", PROPS),
                text("triggers.toml", TRIGGERS),
                *(foretouch(f"world check {name}.toml --json", f"{name}.json")
                  for name in ("stage", "props", "triggers")),
                foretouch("world check props.toml", "figures")],
               {"stage.json": normalise.plain, "props.json": normalise.plain,
                "triggers.json": normalise.plain, "figures": normalise.figures}, short=True)
    yield Case("world/view",
               [*HERE, text("props.toml", PROPS), foretouch("world view stage.toml -o stage.html"),
                foretouch("world view props.toml --report-triangles 20000 -o props.html")],
               {"stage.html": normalise.document, "props.html": normalise.document})
    yield Case("world/props",
               [*HERE, text("props.toml", PROPS),
                foretouch("world replay props.toml --json --output contacts.jsonl --report "
                          "report.html --glb world.glb", "summary")],
               {name: normal for name, normal in FIVE_OUTPUTS.items() if name != "events.jsonl"},
               short=True, everyWidth=True)
    yield Case("world/carriers",
               [*HERE, text("carriers.toml", CARRIERS),
                foretouch(f"world replay carriers.toml {FIVE}", "summary")],
               FIVE_OUTPUTS, short=True)
    yield Case("world/triggers",
               [*HERE, text("cube.obj", CUBE), text("triggers.toml", TRIGGERS),
                foretouch(f"world replay triggers.toml {FIVE}", "summary")],
               FIVE_OUTPUTS, short=True, everyWidth=True)


def stream_cases():
    """A world's log as a sender writes it, and what a service makes of it."""
    yield Case("world/sent",
               [*HERE,
                foretouch("publish --world stage.toml --start 1700000000000000 "
                          "--output sent.lcmlog"),
                foretouch("log convert sent.lcmlog --output sent.jsonl"),
                foretouch("log convert sent.lcmlog --avatar 2 --output ben.bvh"),
                foretouch("log info --json sent.lcmlog", "info.json"),
                foretouch("log replay sent.lcmlog --world stage.toml --json", "replayed", None)],
               {"sent.lcmlog": normalise.event_log, "sent.jsonl": normalise.plain,
                "ben.bvh": normalise.plain, "info.json": normalise.log_info,
                "replayed": normalise.log_info}, short=True)


# ---- Solid avatars ----

SOLID_WAYS = {
    "held-floor": "--floor hold --around 0",
    "own-links": "--self",
    "poor": "--budget-us 20",
    "thick": "--solid-skin 0.01 --tolerance 0.001 --catch-up 0.5",
    "snap": "--snap --place 0.9,0,0.4",
    "ignore": "--ignore *Foot,*Toe* --place 0,-0.2,0",
}


def shown(options):
    return foretouch(f"replay {options} --solid --json --output shown.jsonl --bvh shown.bvh "
                     "--report report.html", "summary")


SHOWN_OUTPUTS = {"summary": normalise.summary, "shown.jsonl": normalise.marked,
                 "shown.bvh": normalise.plain, "report.html": normalise.document}


def solid_cases():
    hand = ("--scene {examples}/desk.obj --avatar {examples}/hand.avatar.json "
            "--motion {examples}/hand.bvh")
    yield Case("solid/hand",
               [shown(hand), foretouch("solid check shown.jsonl --scene {examples}/desk.obj "
                                       "--avatar {examples}/hand.avatar.json --json", "checked")],
               {**SHOWN_OUTPUTS, "checked": normalise.summary}, short=True, everyWidth=True)
    yield Case("solid/dancer", [shown(f"{BUNDLED} --rate 30 --place 0.3,-0.04,0.2,30")],
               SHOWN_OUTPUTS, short=True)
    for name, way in SOLID_WAYS.items():
        yield Case(f"solid/{name}",
                   [foretouch(f"replay {BUNDLED} --rate 15 {way} --solid --output shown.jsonl")],
                   {"shown.jsonl": normalise.marked}, short=name == "snap")
    yield Case("solid/stream",
               [foretouch("publish {examples}/dancer.bvh --avatar {examples}/dancer.avatar.json "
                          "--rate 15 --start 1700000000000000 --output sent.lcmlog"),
                foretouch(f"replay {ROOM} --avatar {{examples}}/dancer.avatar.json --motion "
                          "sent.lcmlog --solid --output shown.jsonl")],
               {"shown.jsonl": normalise.results})


# ---- Certificates, and edges of a robot ----

LINK = """<link name="{0}"><collision><origin xyz="0 0 {1}"/><geometry><cylinder radius="{2}"
length="{3}"/></geometry></collision></link>"""
JOINT = """<joint name="{0}" type="revolute"><parent link="{1}"/><child link="{2}"/>
<origin xyz="0 0 {3}"/><axis xyz="{4}"/><limit lower="-3" upper="3" effort="1" velocity="1"/>
</joint>"""
ARM = '<robot name="arm">' + "".join((
    LINK.format("base", 0.2, 0.08, 0.4), LINK.format("upper", 0.25, 0.05, 0.4),
    LINK.format("lower", 0.2, 0.04, 0.3), JOINT.format("turn", "base", "upper", 0.5, "0 0 1"),
    JOINT.format("bend", "upper", "lower", 0.55, "0 1 0"))) + "</robot>\n"
TABLE = """v -2 -2 -0.05
v 2 -2 -0.2
v 2 2 -0.2
v -2 2 -0.2
v 0.3 -0.2 0.9
v 0.3 0.4 0.9
v 0.3 0.1 1.4
f 1 2 3
f 1 3 4
f 5 6 7
"""
EDGES = "edge,turn,bend\n" + "".join(
    f"{i},{0.3 * i - 2.4:.2f},{0.5 + 0.06 * i:.2f}\n{i},{0.3 * i - 2.1:.2f},{0.6 + 0.05 * i:.2f}\n"
    for i in range(16))
SWING = "time,turn,bend\n" + "".join(f"{0.1 * i:.1f},{0.2 * i - 2:.2f},{0.05 * i:.2f}\n"
                                     for i in range(21))
PROOF = {f"proof/{name}": normalise.plain
         for name in ("scene.obj", "avatar.json", "certificate.txt")}


def verified(moves):
    return run(f"{{verify}} proof/scene.obj proof/avatar.json proof/{moves} proof/certificate.txt",
               "verified", None)


def proof_cases():
    yield Case("proof/dancer",
               [foretouch(f"certify {BUNDLED} --rate 10 --json --output proof", "summary"),
                verified("steps.txt")],
               {**PROOF, "proof/steps.txt": normalise.plain, "summary": normalise.summary,
                "verified": normalise.plain}, short=True)
    robot = [text("arm.urdf", ARM), text("table.obj", TABLE), text("edges.csv", EDGES),
             text("swing.csv", SWING)]
    asked = "certify --scene table.obj --scene-up z --robot arm.urdf"
    yield Case("proof/edges",
               [*robot, foretouch(f"{asked} --edges edges.csv --clearance 0.01 --self --json "
                                  "--output proof", "summary"), verified("edges.txt")],
               {**PROOF, "proof/edges.txt": normalise.plain, "summary": normalise.summary,
                "verified": normalise.plain}, short=True, everyWidth=True)
    yield Case("proof/swing",
               [*robot, foretouch("avatar urdf arm.urdf -o arm.json"),
                foretouch(f"{asked} --avatar arm.json --motion swing.csv --output proof", "said"),
                verified("steps.txt")],
               {**PROOF, "proof/steps.txt": normalise.plain, "verified": normalise.plain})


# ---- Other languages ----

def language_cases():
    stage = "{examples}/room.obj {examples}/dancer.avatar.json {examples}/dancer.bvh"
    for name, what in (("world", "world"), ("solid", "solid")):
        yield Case(f"c/{name}", [run(f"{{c}}/moving_world {stage} {what}", "said.txt")],
                   {"said.txt": normalise.plain}, tools=["c"], short=True)
    yield Case("c/examples", [run("{c}/table", "table.txt"), run("{c}/solid_hand", "hand.txt"),
                              run("{c}/swinging_door", "door.txt")],
               {"table.txt": normalise.plain, "hand.txt": normalise.plain,
                "door.txt": normalise.plain}, tools=["c"])
    for what in ("world", "solid", "solid-world", "edges"):
        yield Case(f"python/{what}",
                   [run(f"{{python}} {{source}}/tests/digests/moving_world.py {stage} {what}",
                        "said.txt")],
                   {"said.txt": normalise.plain}, tools=["packages"],
                   short=what in ("solid-world", "edges"))


# ---- Recordings ----

def recorded_world(body, scene):
    """An animated model by its meshes beside a dancer, in a real scene."""
    return HEAD + f"""
[scene]
file = "{scene}"
[[body]]
name = "man"
avatar = "body.json"
fidelity = "{body}"
mass = 70
[body.clip]
file = "man.gltf"
place = "-3.82,0.016,8.083,-139"
rate = 15
[[body]]
name = "crate"
box = {{ low = [-0.3, 0, -0.3], high = [0.3, 0.6, 0.3] }}
position = [-3.6, 0, 8.3]
[[body]]
name = "dancer"
avatar = "dancer.avatar.json"
[body.clip]
file = "dancer.bvh"
place = "-3.6,0.016,8.0,90"
rate = 20
"""


def recorded_cases():
    needs = ["avatars/cesium_man.gltf", "scenes/cpr_office.dae"]
    made = [*HERE, run("cp {data}/avatars/cesium_man.gltf man.gltf"),
            run("cp {data}/scenes/cpr_office.dae office.dae"),
            foretouch("avatar mesh man.gltf -o body.json")]
    yield Case("world/exact",
               [*made, text("exact.toml", recorded_world("exact", "office.dae")),
                foretouch("world replay exact.toml --output contacts.jsonl", "figures")],
               {"contacts.jsonl": normalise.results, "figures": normalise.figures}, needs)
    yield Case("world/office",
               [*made, text("link.toml", recorded_world("link", "office.dae")),
                foretouch(f"world replay link.toml {FIVE}", "summary")], FIVE_OUTPUTS, needs)


def every_case():
    for kind in (world_cases, stream_cases, solid_cases, proof_cases, language_cases,
                 recorded_cases):
        yield from kind()
