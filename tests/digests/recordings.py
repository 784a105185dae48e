"""Cases of real recordings, models, robots and scenes.

How large they are, and where they stand in the scenes, is in places.json: settled once, so that
each touches something and is seldom stuck. Clips that are slower or shorter than a rate have their
own.
"""
import json
from pathlib import Path

import normalise
from case import ROOM, Case, foretouch, run, text

RATES = (5, 10, 30)

# Where a scene is, and how it lies.
SCENES = {
    "kitchen": ("scenes/kitchen_fatihrmutfak.ply", "--up z"),
    "office": ("scenes/cpr_office.dae", ""),
    "collision-world": ("scenes/collision-world.glb", ""),
    "undulating": ("scenes/undulating.obj", ""),
}


def places():
    return json.loads((Path(__file__).parent / "places.json").read_text(encoding="utf-8"))


def scene_options(scene):
    file, options = SCENES[scene]
    return "--scene {data}/" + f"{file} {options}"


def at_rates(made, asked, rates):
    """The steps and outputs of a replay at several rates."""
    replays = [foretouch(f"{asked} --rate {rate} --output {rate}Hz.jsonl") for rate in rates]
    return [*made, *replays], {f"{rate}Hz.jsonl": normalise.results for rate in rates}


def clip_cases():
    """Every clip in four scenes at three rates, by the links' volumes."""
    for file, place in places()["clips"].items():
        clip, scale = "{data}/mocap/" + file, f"--scale {place['scale']}"
        avatar = foretouch(f"avatar bvh {clip} {scale} -o avatar.json")
        needs = f"mocap/{file}"
        yield Case(f"avatar/{Path(file).stem}", [avatar], {"avatar.json": normalise.plain}, [needs])
        for scene, at in place["at"].items():
            asked = (f"replay {scene_options(scene)} --avatar avatar.json --motion {clip} {scale} "
                     f"--place={at} --threads 1")
            yield Case(f"clip/{Path(file).stem}/{scene}",
                       *at_rates([avatar], asked, place.get("rates", RATES)),
                       [needs, SCENES[scene][0]])


# Ways to ask about one clip in one scene, beside every link's own volume. Neither --culler nor
# --leaves among them or below: see bundled.py.
CLIP_WAYS = {
    "first-of-avatar": "--scope avatar",
    "budget": "--budget-us 10",
    "fine": "--tolerance 1e-5",
    "two-threads": "--threads 2",
    "policy": "--policy policy.toml",
}
CLIP_POLICY = """
[[policy]]
links = ["Hand_*", "*Arm_L"]
tolerance = 0.00001

[[policy]]
links = ["Foot_*", "Toes_*"]
ignore = true
"""


def asked_clip(file, scene):
    """A recording in a scene, by options of `replay`, and what it needs."""
    place = places()["clips"][file]
    scale = f"--scale {place['scale']}"
    made = foretouch("avatar bvh {data}/mocap/" + f"{file} {scale} -o avatar.json")
    options = (f"{scene_options(scene)} --avatar avatar.json --motion {{data}}/mocap/{file} "
               f"{scale} --place={place['at'][scene]}")
    return made, options, [f"mocap/{file}", SCENES[scene][0]]


def clip_way_cases():
    for file, scene in (("bandai1_kick_normal_001.bvh", "kitchen"), ("fair_dab.bvh", "office")):
        made, options, needs = asked_clip(file, scene)
        for name, way in CLIP_WAYS.items():
            threads = "" if "--threads" in way else "--threads 1"
            if name == "policy" and "bandai" not in file:
                continue  # its names are that skeleton's
            yield Case(f"way/{Path(file).stem}/{name}",
                       [made, text("policy.toml", CLIP_POLICY),
                        foretouch(f"replay {options} --rate 10 {threads} {way} "
                                  "--output contacts.jsonl")],
                       {"contacts.jsonl": normalise.results}, needs)


def width_cases():
    """A heavier scene at every width of vectors."""
    made, options, needs = asked_clip("bandai1_kick_normal_001.bvh", "office")
    yield Case("width/office",
               [made, foretouch(f"replay {options} --rate 10 --threads 1 --output contacts.jsonl")],
               {"contacts.jsonl": normalise.results}, needs, everyWidth=True)


def page_cases():
    """Reports, looks and GLB files of a heavy scene, which is simplified or clipped."""
    made, options, needs = asked_clip("bandai1_kick_normal_001.bvh", "kitchen")
    yield Case("page/kitchen",
               [made,
                foretouch(f"replay {options} --rate 10 --threads 1 --output contacts.jsonl "
                          "--report report.html --glb motion.glb --glb-triangles 150000"),
                foretouch(f"view {options} --rate 10 --output look.html")],
               {"report.html": normalise.document, "motion.glb": normalise.glb,
                "look.html": normalise.document}, needs)
    yield Case("page/kitchen-alone",
               [foretouch("view {data}/" + f"{needs[1]} --up z --output scene.html")],
               {"scene.html": normalise.document}, needs[1:])


# ---- animated models and robots: their meshes ----

def model_cases():
    """Animated models by their meshes, in two scenes."""
    for name, model in places()["models"].items():
        body, motion = model["body"], model.get("motion", model["body"])
        scale = f"--scale {model['scale']}"
        made = foretouch("avatar mesh {data}/avatars/" + f"{body} {scale} -o body.json")
        needs = [f"avatars/{body}", f"avatars/{motion}"]
        yield Case(f"model/{name}", [made],
                   {"body.json": normalise.plain, "body.mesh.glb": normalise.glb}, needs[:1])
        moves = "--avatar body.json --motion {data}/avatars/" + f"{motion} {scale}"
        if "animation" in model:
            moves += f" --animation {model['animation']}"
        for scene, at in model["at"].items():
            asked = (f"replay {scene_options(scene)} {moves} --place={at} --threads 1 "
                     "--fidelity exact")
            yield Case(f"model/{name}/{scene}", *at_rates([made], asked, (10, 30)),
                       [*needs, SCENES[scene][0]])


MODEL_WAYS = {
    "link": "--fidelity link",
    "first-of-avatar": "--fidelity exact --scope avatar",
    "budget": "--fidelity exact --budget-us 20",
    "skinned": "--fidelity skinned --skin {data}/avatars/cesium_man.gltf --skin-scale 1",
}


def model_way_cases():
    model = places()["models"]["cesium_man"]
    needs = ["avatars/cesium_man.gltf", SCENES["office"][0]]
    made = foretouch("avatar mesh {data}/avatars/cesium_man.gltf -o body.json")
    asked = (f"replay {scene_options('office')} --avatar body.json --motion "
             f"{{data}}/avatars/cesium_man.gltf --place={model['at']['office']} --rate 10 "
             "--threads 1 --output contacts.jsonl")
    for name, way in MODEL_WAYS.items():
        yield Case(f"model-way/{name}", [made, foretouch(f"{asked} {way}")],
                   {"contacts.jsonl": normalise.results}, needs)
    yield Case("model-way/page",
               [made, foretouch(f"{asked} --fidelity exact --report report.html "
                                "--glb motion.glb")],
               {"report.html": normalise.document, "motion.glb": normalise.glb}, needs)


def joint_positions(names):
    """A robot's log of one second: each joint swings by its own angle."""
    rows = ["time," + ",".join(names)]
    for i in range(31):
        swing = [f"{(-1) ** j * 0.02 * i * (30 - i) / (4 + j):.4f}" for j in range(len(names))]
        rows.append(f"{i / 30:.6f}," + ",".join(swing))
    return "\n".join(rows) + "\n"


# A robot's joints that move, and where it stands in the bundled room.
ROBOTS = {
    "kuka_iiwa/model.urdf": ([f"lbr_iiwa_joint_{i}" for i in range(1, 8)], "-0.6,0.75,-0.4"),
    "franka_panda/panda.urdf": ([f"panda_joint{i}" for i in range(1, 8)], "1,0.02,1"),
    "capsule_humanoid/humanoid.urdf": (["abdomen_z", "right_hip_x", "right_knee", "right_elbow"],
                                       "2,1.1,1.5"),
}


def robot_cases():
    for file, (joints, at) in ROBOTS.items():
        robot = "{data}/robots/" + file
        moves = f"--avatar robot.json --motion log.csv --robot {robot} --place={at}"
        yield Case(f"robot/{Path(file).parent}",
                   [text("log.csv", joint_positions(joints)),
                    foretouch(f"avatar urdf {robot} -o robot.json"),
                    foretouch(f"replay {ROOM} {moves} --threads 1 --fidelity exact "
                              "--output exact.jsonl")],
                   {"robot.json": normalise.plain, "exact.jsonl": normalise.results},
                   [f"robots/{file}"])


def mesh_language_cases():
    """An animated model's meshes in other languages, which read its motion from a BVH file."""
    model = places()["models"]["cesium_man"]
    man = "{data}/avatars/cesium_man.gltf"
    made = [foretouch(f"avatar mesh {man} -o body.json"),
            foretouch(f"publish {man} --avatar body.json --rate 30 --place={model['at']['office']} "
                      "--start 1700000000000000 --output walk.lcmlog"),
            foretouch("log convert walk.lcmlog --output walk.bvh")]
    needs = ["avatars/cesium_man.gltf", SCENES["office"][0]]
    asked = "{data}/" + f"{SCENES['office'][0]} body.json walk.bvh 3 exact work.txt"
    yield Case("c/exact", [*made, run(f"{{c}}/contacts {asked}", "said.txt")],
               {"walk.bvh": normalise.plain, "said.txt": normalise.plain,
                "work.txt": normalise.plain}, needs, ["c"])
    yield Case("python/exact",
               [*made, run(f"{{python}} {{source}}/tests/digests/contacts.py {asked} swept.txt",
                           "said.txt")],
               {"said.txt": normalise.plain, "work.txt": normalise.plain,
                "swept.txt": normalise.plain}, needs, ["packages"])


def check_cases():
    """What `scene check` and `avatar check` measure; whether they say yes."""
    for scene in SCENES:
        asked = scene_options(scene).replace("--scene ", "scene check ")
        yield Case(f"check/{scene}", [foretouch(asked, "figures", None)],
                   {"figures": normalise.figures}, [SCENES[scene][0]])
    made = {"cesium_man": "avatar mesh {data}/avatars/cesium_man.gltf",
            "kuka_iiwa": "avatar urdf {data}/robots/kuka_iiwa/model.urdf",
            "mocapbank": "avatar bvh {data}/mocap/mocapbank.bvh --scale 0.01"}
    for name, make in made.items():
        file = make.split()[2].replace("{data}/", "")
        yield Case(f"check/{name}", [foretouch(f"{make} -o made.json"),
                                     foretouch("avatar check made.json", "figures", None)],
                   {"figures": normalise.figures}, [file])


def every_case():
    for kind in (check_cases, mesh_language_cases, width_cases, robot_cases, model_way_cases,
                 page_cases, clip_way_cases, model_cases, clip_cases):
        yield from kind()
