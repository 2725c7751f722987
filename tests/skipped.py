"""Prints which tests CTest or their own framework skipped, and why.

Usage: skipped.py RESULTS.xml, as `ctest --output-junit RESULTS.xml` writes it
"""

import re
import sys
import xml.etree.ElementTree as ElementTree

# GoogleTest, unittest, and our own scripts that exit with SKIP_RETURN_CODE.
REASONS = (re.compile(r": Skipped\n(.+)"), re.compile(r"\.\.\. skipped '(.+)'"),
           re.compile(r"^skipped: (.+)", re.MULTILINE))


def main():
    for case in ElementTree.parse(sys.argv[1]).getroot().iter("testcase"):
        output = case.findtext("system-out") or ""
        reasons = [reason for pattern in REASONS for reason in pattern.findall(output)]
        if case.find("skipped") is not None and not reasons:
            reasons = ["no reason given"]
        for reason in dict.fromkeys(reasons):
            print(f"skipped: {case.get('name')}: {reason}")


if __name__ == "__main__":
    main()
