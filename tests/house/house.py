"""A tree as its files, includes and CMake files show it, and the law of its rooms.toml."""

import collections
import functools
import graphlib
import os
import pathlib
import re
import tomllib

# Not of the tree: made by builds and by tools. Nor is a folder that holds a CMakeCache.txt.
NOT_OURS = ("build", "out", "b", ".git", ".cache", "__pycache__")
MADE = ("_pb2", "_pb2_grpc")  # By protoc; a test of the Python package holds them to the .proto files.
CODE = (".h", ".cc", ".py", ".sh", ".proto", ".cmake")
WIRE = ("albtpu/v1/", "google/rpc/", "grpc/health/v1/")  # What protoc makes of proto/.
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)
SYSTEM = re.compile(r"(sys|arpa|netinet)/\w+\.h|"
                    r"(dlfcn|fcntl|limits|malloc|netdb|poll|pthread|spawn|stdio|stdlib|unistd)\.h")
COMMAND = re.compile(r"^\s*(\w+)\s*\(", re.MULTILINE)


def sources_in(folder):
    return sorted(path for path in folder.rglob("*") if path.suffix in (".h", ".cc"))


def within(path, folders):
    """The longest of the folders that holds a path; "." holds all; None if no folder does."""
    holding = [folder for folder in folders if folder == "." or f"{path}/".startswith(folder + "/")]
    return max(holding, key=lambda folder: len(folder) if folder != "." else 0, default=None)


class Tree:
    """The files of a tree, by their paths from its root."""

    def __init__(self, root):
        self.root = pathlib.Path(root)
        self.law = Law(self.root / "rooms.toml")
        self.rooms = sorted({room.split("/")[0] for room in self.law.rooms})  # at the top

    @functools.cached_property
    def files(self):
        found = []
        for folder, subfolders, names in os.walk(self.root):
            folder = pathlib.Path(folder)
            subfolders[:] = [name for name in subfolders
                             if name not in NOT_OURS and not (folder / name / "CMakeCache.txt").exists()]
            found += [(folder / name).relative_to(self.root).as_posix() for name in names if name not in NOT_OURS]
        return sorted(found)

    @functools.cached_property
    def code(self):
        """The text of each file of code that people write."""
        return {path: (self.root / path).read_text() for path in self.files
                if path.endswith(CODE) and not pathlib.Path(path).stem.endswith(MADE)}

    def code_in(self, folders, suffixes):
        return [(path, text) for path, text in self.code.items()
                if path.endswith(suffixes) and within(path, folders) is not None]


class Law:
    """What rooms.toml says."""

    def __init__(self, path):
        law = tomllib.loads(path.read_text())
        self.rules = law.get("rules", {})
        self.libraries = law["libraries"]
        self.rooms = law["rooms"]
        self.uses = {name: self._expand(room.get("uses", [])) - {name} for name, room in self.rooms.items()}
        self.allowed_libraries = {name: set(room.get("libraries", [])) for name, room in self.rooms.items()}

    def _expand(self, names):
        expanded = set()
        for name in names:
            inside = {room for room in self.rooms if (room + "/").startswith(name)} if name.endswith("/") else {name}
            unknown = [room for room in inside if room not in self.rooms]
            if unknown or not inside:
                raise ValueError(f"rooms.toml: '{name}' is no room")
            expanded |= inside
        return expanded

    def room_of(self, path):
        """The room of a file or header, given from the root of the tree; None if it lies in none."""
        path = str(path)
        if path.startswith(WIRE):
            return "proto"
        inside = [room for room in self.rooms if path.startswith(room + "/")]
        return max(inside, key=len, default=None)

    def library_of(self, header):
        """The library that a header comes from; None if no library has it."""
        for name, library in self.libraries.items():
            if header.startswith(tuple(library["headers"])):
                return name
        return None

    def library_of_target(self, target):
        for name, library in self.libraries.items():
            if library["targets"] and target.startswith(tuple(library["targets"])):
                return name
        return None


def includes(root, folders):
    """(file, header) of each #include in the folders, files from the root of the tree."""
    for folder in folders:
        for path in sources_in(root / folder):
            for header in INCLUDE.findall(path.read_text()):
                yield path.relative_to(root).as_posix(), header


def component_of(path):
    """A header and its source are one component, and so is a -inl.h beside its header."""
    return re.sub(r"(-inl)?\.(h|cc)$", "", path)


def circle_in(graph):
    """Nodes of which each leads to the next, and the first is the last; None if the graph has no circle."""
    try:
        graphlib.TopologicalSorter(graph).prepare()
    except graphlib.CycleError as error:
        return error.args[1]
    return None


def circle_of_includes(root, folders):
    """Components that include each other in a circle, a header counted together with its source; or None."""
    files = {path.relative_to(root).as_posix() for folder in folders for path in sources_in(root / folder)}
    graph = collections.defaultdict(set)
    for path, header in includes(root, folders):
        if header in files and component_of(header) != component_of(path):
            graph[component_of(path)].add(component_of(header))
    return circle_in(graph)


def commands(text):
    """(name, arguments) of each command of a CMake file; comments and quotes left out."""
    text = re.sub(r"#[^\n]*", "", text)
    for match in COMMAND.finditer(text):
        depth, end = 1, match.end()
        while depth and end < len(text):
            depth += {"(": 1, ")": -1}.get(text[end], 0)
            end += 1
        yield match[1], text[match.end():end - 1].replace('"', "").split()


class Targets:
    """The libraries and programs that the CMake files of some folders make."""

    def __init__(self, root, folders):
        self.sources = collections.defaultdict(set)  # of each target, from the root of the tree
        self.links = collections.defaultdict(set)
        self.aliases = {}
        for folder in folders:
            for path in sorted((root / folder).rglob("CMakeLists.txt")):
                self._read(root, path)

    def _read(self, root, path):
        variables = {}
        for name, arguments in commands(path.read_text()):
            arguments = [value for word in arguments for value in variables.get(word, [word])]
            if name == "albtpu_sources":  # Of cmake/house_rules.cmake: all sources in folders but those of programs.
                found = [source for folder in arguments[1:] for source in (path.parent / folder).resolve().glob("*.cc")]
                variables[f"${{{arguments[0]}}}"] = [
                    source.as_posix() for source in found if not re.search(r"(^|_)main\.cc$", source.name)]
            elif name == "list" and arguments[0] == "FILTER" and arguments[2] == "EXCLUDE":
                pattern, variable = arguments[4].replace("\\\\", "\\"), f"${{{arguments[1]}}}"
                variables[variable] = [value for value in variables.get(variable, []) if not re.search(pattern, value)]
            elif name == "add_library" and "ALIAS" in arguments:
                self.aliases[arguments[0]] = arguments[-1]
            elif name in ("add_library", "add_executable", "target_sources"):
                for source in arguments[1:]:
                    if source.endswith(".cc") and "$" not in source:
                        file = (path.parent / source).resolve().relative_to(root.resolve())
                        self.sources[arguments[0]].add(file.as_posix())
            elif name == "target_link_libraries":
                self.links[arguments[0]].update(
                    word for word in arguments[1:] if word not in ("PUBLIC", "PRIVATE", "INTERFACE"))

    def named(self, target):
        return self.aliases.get(target, target)
