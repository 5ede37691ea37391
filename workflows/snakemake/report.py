"""What a run of the workflow did, as Markdown: python3 report.py RESULTS SLICES >report.md"""

import csv
import re
import statistics
import sys
from pathlib import Path

results, slices = Path(sys.argv[1]), int(sys.argv[2])
STEPS = ("converted", "corrected", "measured")
folders = [results / "slices" / str(number) for number in range(1, slices + 1)]


def sums(step):
    """nade's tables: a name and a number a row. Times do not add up."""
    total = {}
    for folder in folders:
        for line in (folder / f"{step}.txt").read_text().splitlines():
            row = re.fullmatch(r"(\S.*?) +(\d+)", line)
            if row and not row[1].startswith("frames a second"):
                total[row[1]] = total.get(row[1], 0) + int(row[2])
    return total


def measured():
    for folder in folders:
        with open(folder / "measured.csv", newline="") as file:
            yield from csv.DictReader(file)


def said(step):
    for folder in folders:
        for line in (folder / f"{step}.err").read_text(errors="replace").splitlines():
            if not re.match(r"nade: \d+ of \d+ recordings could not be ", line):
                yield line


def number(text):
    try:
        return float(text)
    except ValueError:
        return None


for step in STEPS[:2]:
    print(f"| {step} | |\n|---|--:|")
    for name, value in sums(step).items():
        print(f"| {name} | {value} |")
    print()

rows = list(measured())
print(f"{len(rows)} recordings were measured.\n")
print("| metric | lowest | median | highest | lowest in | highest in |\n|---|--:|--:|--:|---|---|")
for metric in rows[0] if rows else ():
    values = [(number(row[metric]), row["tracked"]) for row in rows]
    values = sorted(value for value in values if value[0] is not None)
    if values:
        median = statistics.median(value for value, _ in values)
        (low, low_in), (high, high_in) = values[0], values[-1]
        print(f"| {metric} | {low:.4g} | {median:.4g} | {high:.4g} | {low_in} | {high_in} |")

for step in STEPS:
    for i, line in enumerate(said(step)):
        if i == 0:
            print(f"\nSaid while it was {step}:\n")
        print(f"    {line}")
