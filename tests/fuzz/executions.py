"""executions.py FOLDER TARGET...: a table of what libFuzzer says at the end of FOLDER/TARGET.log, and the
same as FOLDER/fuzzing.json, for docs/measurements."""
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


def main():
    folder, targets = sys.argv[1], sys.argv[2:]
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


if __name__ == "__main__":
    main()
