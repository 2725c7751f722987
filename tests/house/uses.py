"""Rules on who uses whom: includes, libraries, links, heavy headers, circles. Each takes a house.Tree and yields what
breaks it."""

import house

OUTSIDE = ("clients/", "tests/")  # Code of no room; what it uses is not restricted.


def code_lies_in_rooms(tree):
    for path in tree.code:
        if path.endswith((".h", ".cc")) and not path.startswith(OUTSIDE) and tree.law.room_of(path) is None:
            yield f"{path} lies in no room of rooms.toml"


def includes_follow_the_law(tree):
    law = tree.law
    for path, header in house.includes(tree.root, tree.rooms):
        here, there = law.room_of(path), law.room_of(header)
        if here is not None and there not in (None, here) and there not in law.uses[here]:
            yield f"{path} includes {header}: rooms.toml does not let {here} use {there}"


def libraries_are_allowed(tree):
    law = tree.law
    for path, header in house.includes(tree.root, tree.rooms):
        here = law.room_of(path)
        if here is None or law.room_of(header) or house.SYSTEM.fullmatch(header):
            continue
        if not ("/" in header or "." in header):  # of the standard library
            continue
        library = law.library_of(header)
        if library is None:
            yield f"{path} includes {header}, of no library in rooms.toml"
        elif library not in law.allowed_libraries[here]:
            yield f"{path} includes {header}: rooms.toml does not let {here} use {library}"


def headers_are_named_from_the_root(tree):
    folders = (*tree.rooms, "tests")
    for path, header in house.includes(tree.root, folders):
        own = header.split("/")[0] in folders and not header.startswith(house.WIRE)
        if own and not (tree.root / header).is_file():
            yield f"{path} includes {header}, which does not exist"


def heavy_headers_stay_out_of_headers(tree):
    for path, header in house.includes(tree.root, (*tree.rooms, "tests")):
        for rule in tree.law.rules["heavy_headers"]:
            if (path.endswith(".h") and header.startswith(tuple(rule["headers"]))
                    and house.within(path, rule["rooms"]) is None):
                yield f"{path} includes {header}: among headers only those of {', '.join(rule['rooms'])} may"


def links_follow_the_law(tree):
    law, targets = tree.law, house.Targets(tree.root, tree.rooms)

    def rooms_of(target):
        return {law.room_of(source) for source in targets.sources[targets.named(target)]}

    for target, links in sorted(targets.links.items()):
        rooms = rooms_of(target)
        if not rooms:  # made by protoc
            continue
        used = rooms.union(*(law.uses[room] for room in rooms if room))
        libraries = set().union(*(law.allowed_libraries[room] for room in rooms if room))
        by = ", ".join(sorted(map(str, rooms)))
        for link in sorted(link for link in links if "$" not in link):
            library = law.library_of_target(link)
            if link.startswith("albtpu"):
                if not (rooms_of(link) or {"proto"}) & used:
                    yield f"{target} links {link}: rooms.toml does not let {by} use it"
            elif library is None:
                yield f"{target} links {link}, of no library in rooms.toml"
            elif library not in libraries:
                yield f"{target} links {link}: rooms.toml does not let {by} use {library}"


def sources_are_compiled_once(tree):
    targets = house.Targets(tree.root, tree.rooms)
    compiled = [source for sources in targets.sources.values() for source in sources]
    for path, _ in tree.code_in(tree.rooms, (".cc",)):
        if compiled.count(path) != 1:
            yield f"{path} is compiled by {compiled.count(path)} targets"


def includes_make_no_circle(tree):
    if circle := house.circle_of_includes(tree.root, (*tree.rooms, "tests", "clients")):
        yield f"{', '.join(sorted(set(circle)))} include each other"


def the_law_has_no_circle(tree):
    if circle := house.circle_in({room: sorted(uses) for room, uses in tree.law.uses.items()}):
        yield f"rooms.toml lets {', '.join(sorted(set(circle)))} use each other"
