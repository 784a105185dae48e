"""executions.py [--record FILE] FOLDER TARGET...: a table of what libFuzzer says at the end of
FOLDER/TARGET.log, and the same as FOLDER/fuzzing.json. With --record it is added to the figures in FILE
(docs/measurements/fuzzing.json): executions, minutes and findings add up; of edges and inputs, which the
next run begins with, the more count."""
import datetime
import json
import re
import sys

COLUMNS = [("target", "target"), ("million_executions", "million executions"), ("minutes", "minutes"),
           ("edges", "edges covered"), ("inputs", "inputs kept"), ("findings", "findings")]


def last(pattern, text):
    found = re.findall(pattern, text)
    return int(found[-1]) if found else 0


def row_of(folder, target):
    text = open(f"{folder}/{target}.log", errors="replace").read()
    executions = last(r"stat::number_of_executed_units:\s*(\d+)", text)
    return {"target": target, "million_executions": round(executions / 1e6, 3 if executions < 1e7 else 1),
            "minutes": round(last(r"Done \d+ runs in (\d+) second", text) / 60, 1),
            "edges": last(r"\bcov: (\d+)", text), "inputs": last(r"\bcorp: (\d+)", text),
            "findings": len(re.findall(r"^SUMMARY: |^broken promise: ", text, re.M))}


def added(old, new):
    row = dict(new)
    for key in ("million_executions", "minutes", "findings"):
        row[key] = round(old[key] + new[key], 3)
    for key in ("edges", "inputs"):
        row[key] = max(old[key], new[key])
    return row


def record(path, rows):
    with open(path) as recorded:
        figures = json.load(recorded)
    table = figures["tables"][0]
    known = {row["target"]: row for row in table["rows"]}
    for row in rows:
        known[row["target"]] = added(known[row["target"]], row) if row["target"] in known else row
    table["rows"] = list(known.values())
    table["date"] = datetime.date.today().isoformat()
    with open(path, "w") as out:
        json.dump(figures, out, indent=1)
        out.write("\n")


def main():
    words = sys.argv[1:]
    recorded = words[1] if words[0] == "--record" else None
    folder, *targets = words[2:] if recorded else words
    rows = [row_of(folder, target) for target in targets]
    print("| " + " | ".join(title for _, title in COLUMNS) + " |")
    print("|" + "---|" * len(COLUMNS))
    for row in rows:
        print("| " + " | ".join(str(row[key]) for key, _ in COLUMNS) + " |")
    print(f"{sum(row['million_executions'] for row in rows):.1f} million executions, "
          f"{sum(row['findings'] for row in rows)} findings")
    table = {"name": "targets", "title": "Executions and findings", "command": "./run fuzz",
             "date": datetime.date.today().isoformat(),
             "columns": [{"key": key, "title": title} for key, title in COLUMNS], "rows": rows}
    with open(f"{folder}/fuzzing.json", "w") as out:
        json.dump({"format": "foretouch-figures", "version": 1, "title": "Fuzzing", "tables": [table]}, out, indent=1)
        out.write("\n")
    if recorded:
        record(recorded, rows)


if __name__ == "__main__":
    main()
