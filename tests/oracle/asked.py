"""asked.py [--record] LOG...: what ask_oracle printed into these files, added up, as Markdown. They are
of worlds that adjoin, asked as much each. With --record the tables are those of docs/measurements/asked.json
and docs/ask.md from now on. Exit code 1: something was wrong; 2: the files do not belong together."""
import json
import re
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
KINDS = ["ray", "sphere cast", "capsule cast", "hull cast", "overlap", "hull overlap", "nearest", "hull nearest",
         "point inside", "hull inside", "flight"]
COLUMNS = {
    "kinds": {"kind": "question", "questions": "asked", "hits": "with a hit", "wrong": "wrong, missed or late"},
    "worlds": {"worlds": "worlds", "parts": "parts looked at", "skins": "hits of skins", "motions": "motions",
               "instants": "instants of motions", "wrong": "wrong bounds"}}
TITLES = {"kinds": "Questions to random worlds, some of whose bodies have skins, part by part",
          "worlds": "What the judge looked at for them, and for closest approaches of motions"}


def refuse(why):
    print(f"asked.py: {why}", file=sys.stderr)
    sys.exit(2)


def command_of(text):
    runs = sorted(tuple(map(int, run)) for run in re.findall(
        r"^worlds (\d+) to (\d+), each: (\d+) questions, (\d+) flights, (\d+) clearances$", text, re.M))
    if not runs or len(runs) != len(re.findall(r"^clearances: .* wrong$", text, re.M)):
        refuse("expected whole runs with clearances: one has not ended")
    for one, other in zip(runs, runs[1:]):
        if other[0] != one[1] + 1 or other[2:] != one[2:]:
            refuse(f"expected world {one[1] + 1} after {one[1]}, asked as much, found {other[0]}")
    worlds = runs[-1][1] - runs[0][0] + 1
    return worlds, ("./run ask-oracle --seeds {} --first {} --questions {} --flights {} --clearances {}".format(
        worlds, runs[0][0], *runs[0][2:]))


def rows_of(text, worlds):
    def total(pattern):
        return sum(map(int, re.findall(pattern, text, re.M)))
    wrong = set(re.findall(r"^seed (\d+), (?:question (\d+) \((.*?)\)|(flight) (\d+)):", text, re.M))
    kinds = [{"kind": kind, "questions": total(rf"^{kind}: (\d+) questions"),
              "hits": total(rf"^{kind}: .* (\d+) with a hit"), "wrong": sum(kind in one for one in wrong)}
             for kind in KINDS]
    return {"kinds": kinds, "worlds": [{
        "worlds": worlds, "parts": total(r"(\d+) parts judged"), "skins": total(r"(\d+) of them of skins"),
        "motions": total(r"^clearances: (\d+)"), "instants": total(r"(\d+) instants judged"),
        "wrong": total(r"(\d+) wrong$")}]}


def shown(columns, rows):
    cells = [columns.values(), ["---"] * len(columns),
             *([f"{row[key]:,}" if isinstance(row[key], int) else row[key] for key in columns] for row in rows)]
    head, rule, *body = ["| " + " | ".join(row) + " |\n" for row in cells]
    return "".join([head, rule.replace(" ", ""), *body])


def record(command, rows):
    figures = {"format": "foretouch-figures", "version": 1, "title": "Questions and closest approaches, as judged",
               "tables": [{"name": name, "title": TITLES[name], "command": command,
                           "date": time.strftime("%Y-%m-%d"),
                           "columns": [{"key": key, "title": title} for key, title in columns.items()],
                           "rows": rows[name]} for name, columns in COLUMNS.items()]}
    (ROOT / "docs/measurements/asked.json").write_text(json.dumps(figures, indent=1) + "\n")
    page = ROOT / "docs/ask.md"
    text = re.sub(r"^\./run ask-oracle --seeds .* --first .*$", command, page.read_text(), flags=re.M)
    for name, columns in COLUMNS.items():
        mark = f"<!-- table: asked/{name} -->\n"
        text = re.sub(re.escape(mark) + r"(\|.*\n)*", mark + shown(columns, rows[name]), text)
    page.write_text(text)


def main():
    logs = [name for name in sys.argv[1:] if name != "--record"]
    text = "".join(Path(name).read_text() for name in logs)
    worlds, command = command_of(text)
    rows = rows_of(text, worlds)
    print(command)
    for name, columns in COLUMNS.items():
        print("\n" + shown(columns, rows[name]), end="")
    if "--record" in sys.argv:
        record(command, rows)
    problems = re.findall(r"^(?:clearance: )?seed .*$", text, re.M)
    print("\n" + "\n".join([*problems, f"{len(problems)} problems"]))
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
