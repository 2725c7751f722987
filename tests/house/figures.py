"""Prints how large a tree is: files and lines of product and tests, the median, slivers, rooms, folders.

Usage: figures.py [SOURCE_FOLDER]
"""

import collections
import pathlib
import statistics
import sys

import house
import shape

SLIVER = 30  # lines at most
SHOWN = 5


def print_part(name, lengths, protos):
    """`lengths` of C++ and Python, for the median; `protos` counts in the total alone."""
    values = list(lengths.values())
    slivers = sum(value <= SLIVER for value in values)
    print(f"{name}: {len(values) + len(protos)} files, {sum(values) + sum(protos.values())} lines; median "
          f"{statistics.median(values):g}, {100 * slivers / len(values):.1f} % of at most {SLIVER} lines; the longest:")
    for path, length in collections.Counter(lengths).most_common(SHOWN):
        print(f"  {length:6} {path}")


def main():
    tree = house.Tree(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[2])
    lengths = shape.lines_of_files(tree)
    protos = {path: shape.lines(text) for path, text in tree.code.items() if path.endswith(".proto")}
    for name, wanted in (("product", False), ("tests", True)):
        print_part(name, *({path: length for path, length in of.items() if shape.of_tests(path) == wanted}
                           for of in (lengths, protos)))
    print("lines of C++ and Python in the rooms at the top:")
    for room, size in shape.lines_of_rooms(tree).most_common():
        print(f"  {size:6} {room}")
    counts = shape.files_of_folders(tree)
    print("files in the largest folders:")
    for folder, count in counts.most_common(SHOWN):
        print(f"  {count:6} {folder}")
    deepest = max(counts, key=lambda folder: folder.count("/"))
    print(f"{len(tree.files)} files in {len(counts)} folders, at most {deepest.count('/') + 1} levels deep: {deepest}")


if __name__ == "__main__":
    main()
