"""Cases of what is asked about a clip or a world besides its touches: feet, mended clips, persons
within bounds, questions at an instant, and where a body would stand."""
import normalise
from bundled import DANCER
from case import ROOM, Case, foretouch, run

QUESTIONS = {
    "ray": "--from 0,1.2,3 --along 0,0,-1",
    "all": "--from -3,1.1,0.1 --along 1,0.02,0 --all",
    "ball": "--from 2,0.9,0 --radius 0.1 --along -1,0,0 --without scene",
    "capsule": "--from 0,2.5,0 --to 0.4,2.5,0.1 --radius 0.05 --along 0,-1,0",
    "overlap": "--from 0,1,0 --radius 0.4",
    "nearest": "--from 0.5,1.4,0.5 --within 3 --without scene --all",
}


def person_cases():
    learned = foretouch("bounds learn {examples}/dancer.bvh --rates 10,30 --between cubic-late,constant-rate "
                        "--quantile 0.99 -o dancer.bounds.json", "learned.txt")
    yield Case("asked/person",
               [learned] + [foretouch(f"replay {ROOM} {DANCER} --rate {rate} --threads 1 --self --bounds "
                                      f"dancer.bounds.json --between {model} -o {model}.jsonl", f"{model}.txt")
                            for rate, model in ((10, "cubic-late"), (30, "constant-rate"))],
               {"dancer.bounds.json": normalise.plain, "cubic-late.jsonl": normalise.results,
                "constant-rate.jsonl": normalise.results, "cubic-late.txt": normalise.figures}, short=True)


def question_cases():
    steps = [run("cp {examples}/stage.toml {examples}/room.obj {examples}/dancer.bvh "
                 "{examples}/dancer.avatar.json {examples}/ball.csv .")]
    for name, asked in QUESTIONS.items():
        steps += [foretouch(f"ask stage.toml --at 1.7 {asked} --json", f"{name}.json")]
    yield Case("asked/questions", steps, {f"{name}.json": normalise.plain for name in QUESTIONS}, short=True)


def feet_cases():
    lowered = "--place 0,-0.02,0,0"
    yield Case("asked/feet",
               [foretouch(f"feet {ROOM} {DANCER} -o feet.csv --labels labels.csv", "feet.txt"),
                foretouch(f"feet {ROOM} {DANCER} {lowered} --ground fit -o fit.csv", "fit.txt")],
               {"feet.csv": normalise.plain, "labels.csv": normalise.plain, "feet.txt": normalise.figures,
                "fit.csv": normalise.plain, "fit.txt": normalise.figures}, short=True)
    yield Case("asked/repair",
               [foretouch(f"repair {ROOM} {DANCER} {lowered} --from 0.5 --to 2 -o mended.bvh", "mended.txt", None)],
               {"mended.bvh": normalise.plain, "mended.txt": normalise.figures})


def place_cases():
    yield Case("asked/setup",
               [foretouch("setup {examples}/room.obj {examples}/dancer.bvh --yes", "setup.txt", None)],
               {"foretouch.toml": normalise.plain, "setup.txt": normalise.figures})


def every_case():
    for kind in (person_cases, question_cases, feet_cases, place_cases):
        yield from kind()
