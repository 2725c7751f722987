"""Rules on the size of files, folders and rooms. Each takes a house.Tree and yields what breaks it."""

import collections
import pathlib
import statistics

import house

COUNTED = (".h", ".cc", ".py")


def lines(text):
    return len(text.splitlines())


def of_tests(path):
    return path.startswith("tests/")


def folder_of(path):
    return pathlib.PurePosixPath(path).parent.as_posix()


def files_of_folders(tree):
    """How many files lie in each folder, beside its subfolders."""
    return collections.Counter(map(folder_of, tree.files))


def lines_of_files(tree):
    return {path: lines(text) for path, text in tree.code.items() if path.endswith(COUNTED)}


def median_of_product(tree):
    return statistics.median(length for path, length in lines_of_files(tree).items() if not of_tests(path))


def lines_of_rooms(tree):
    """The lines of each folder at the top."""
    sizes = collections.Counter()
    for path, length in lines_of_files(tree).items():
        sizes[path.split("/")[0] if "/" in path else "."] += length
    return sizes


def folders_are_flat(tree):
    """At most so many levels; folders whose shape a tool prescribes are listed with more."""
    most = tree.law.rules["levels"]
    for folder in files_of_folders(tree):
        levels = 0 if folder == "." else folder.count("/") + 1
        allowed = most[house.within(folder, most)]
        if levels > allowed:
            yield f"{folder} lies {levels} levels deep: {allowed} at most"


def folders_are_not_crowded(tree):
    most = tree.law.rules["files_in_folder"]
    for folder, count in files_of_folders(tree).items():
        if count > most:
            yield f"{folder} holds {count} files: {most} at most"


def files_hold_one_idea(tree):
    most = tree.law.rules["lines_in_file"]
    for path, text in tree.code.items():
        if lines(text) > most:
            yield f"{path} has {lines(text)} lines: {most} at most, split it"


def files_are_not_slivers(tree):
    least, median = tree.law.rules["median_lines"], median_of_product(tree)
    if median < least:
        yield f"the median of the product's files is {median:g} lines: {least} at least, a class lives with its helpers"


def rooms_are_not_towers(tree):
    most = tree.law.rules["lines_in_room"]
    for room, size in lines_of_rooms(tree).items():
        if room != "tests" and size > most:
            yield f"{room} has {size} lines: {most} at most"


def tests_mirror_the_tree(tree):
    for folder in sorted({folder_of(path) for path, _ in tree.code_in(["tests"], (".h", ".cc"))}):
        mirrored = folder.removeprefix("tests/")
        if mirrored.split("/")[0] not in tree.rooms or mirrored in tree.law.rules["tests_of_many_rooms"]:
            continue
        if not (tree.root / mirrored).is_dir():
            yield f"{folder} mirrors no room"


def rooms_say_who_lives_there(tree):
    least, most = tree.law.rules["lines_in_readme"]
    for room in tree.law.rooms:
        readme = tree.root / room / "README.md"
        if not readme.is_file():
            yield f"{room} has no README.md"
        elif not least <= lines(readme.read_text()) <= most:
            yield f"{room}/README.md has {lines(readme.read_text())} lines: {least} to {most} expected"


def readmes_do_not_repeat_the_law(tree):
    words = tree.law.rules["left_to_rooms_toml"]
    for path in tree.files:
        if path.endswith("/README.md"):
            text = " ".join((tree.root / path).read_text().lower().split())
            for word in words:
                if word in text:
                    yield f"{path} says '{word}': rooms.toml says what a room may use"
