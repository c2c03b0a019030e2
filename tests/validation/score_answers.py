#!/usr/bin/env python3
"""Scores the answers of a method to hidden effects in simulated impacts.

score_answers.py TRUTH.csv ANSWERS.csv...

ANSWERS has the columns case, named and listed. `named` holds the causes that act for certain, `listed`
those of which one may act; ids, separated by blanks; both empty: nothing is wrong with the model.
A case without a row is not scored. TRUTH comes with the data sets."""

import csv
import sys


def rows_of(path, columns):
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    missing = [name for name in columns if rows and name not in rows[0]]
    if missing:
        sys.exit(f"{path}: there is no column {', '.join(missing)}")
    return rows


def share(count, of):
    return f"{count} of {of} ({100 * count / of:.0f} %)" if of else "-"


def score(truth, answers):
    """The counts of one method: a dictionary of (count, of)."""
    counted = [case for case in truth.values() if case["counted"] == "1" and case["case"] in answers]
    nothing = [case for case in truth.values() if case["arm"] == "correct" and case["case"] in answers]
    others = [case for case in truth.values()
              if case["counted"] != "1" and case["arm"] != "correct" and case["case"] in answers]

    def named(case):
        return set(answers[case["case"]]["named"].split())

    def listed(case):
        return named(case) | set(answers[case["case"]]["listed"].split())

    def hidden(case):
        return set(case["hidden"].split())

    ideal = [float(case["nameable"]) for case in counted if case["nameable"]]
    return {
        "visible effect named": (sum(named(c) == hidden(c) for c in counted), len(counted)),
        "an ideal judge": (round(sum(ideal)), len(ideal)),
        "named or listed": (sum(hidden(c) <= listed(c) for c in counted), len(counted)),
        "something else named": (sum(bool(named(c) - hidden(c)) for c in counted), len(counted)),
        "nothing hidden: something named or listed": (sum(bool(listed(c)) for c in nothing), len(nothing)),
        "other cases: something else named": (sum(bool(named(c) - hidden(c)) for c in others), len(others)),
    }


def main(arguments):
    if len(arguments) < 2:
        sys.exit(__doc__)
    truth = {row["case"]: row for row in rows_of(arguments[0], ["case", "hidden", "arm", "counted", "nameable"])}
    for path in arguments[1:]:
        answers = {row["case"]: row for row in rows_of(path, ["case", "named", "listed"])}
        unknown = sorted(set(answers) - set(truth))
        if unknown:
            sys.exit(f"{path}: there is no case {unknown[0]}")
        print(path)
        for words, (count, of) in score(truth, answers).items():
            print(f"  {words:<44}{share(count, of)}")


if __name__ == "__main__":
    main(sys.argv[1:])
