"""Prints how many tests the programs of GoogleTest have run, and which tests were skipped and why.

Usage: skipped.py RESULTS.xml, a file written by `ctest --output-junit RESULTS.xml`
"""

import re
import sys
import xml.etree.ElementTree as ElementTree

RAN = re.compile(r"^\[==========\] (\d+) tests? from .* ran", re.MULTILINE)
# As printed by GoogleTest, by unittest, and by our own scripts that exit with SKIP_RETURN_CODE.
REASONS = (re.compile(r": Skipped\n(.+)"), re.compile(r"""\.\.\. skipped ['"](.+)['"]$""", re.MULTILINE),
           re.compile(r"^skipped: (.+)", re.MULTILINE))


def main():
    cases = list(ElementTree.parse(sys.argv[1]).getroot().iter("testcase"))
    ran = [int(count) for case in cases for count in RAN.findall(case.findtext("system-out") or "")]
    print(f"GoogleTest: {sum(ran)} tests in {len(ran)} of the {len(cases)} tests of CTest")
    for case in cases:
        output = case.findtext("system-out") or ""
        reasons = [reason for pattern in REASONS for reason in pattern.findall(output)]
        if case.find("skipped") is not None and not reasons:
            reasons = ["no reason given"]
        for reason in dict.fromkeys(reasons):
            print(f"skipped: {case.get('name')}: {reason}")


if __name__ == "__main__":
    main()
