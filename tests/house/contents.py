"""Rules on what stands in C++ files: namespaces, and keys with their ranges. Each takes a house.Tree and yields what
breaks it."""

import itertools
import re

import house

# Comments, raw strings, strings and characters of C++; a quote after a digit parts the digits of a number.
NOT_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|'
                      r"(?<!\w)'(?:\\.|[^'\\\n])+'", re.DOTALL)
OPENS = re.compile(r"\bnamespace(?:\s+(?!\w+\s*=)([\w:]+))?\s*\{|[{}]")
FORWARD = re.compile(r"(?:template\s*<[^>]*>\s*)?\b(?:enum\s+class|class|struct|enum)\s+\w+(?:\s*:\s*[\w:]+)?\s*;")
EMPTY = re.compile(r"\bnamespace\s+[\w:]+\s*\{\s*\}")

NAME = re.compile(r'"[a-z][a-z0-9_.]*"')
UNITS_LIKE_NAMES = ("m", "s", "h", "ns", "nm", "degree", "rad", "mrad")
UNIT = re.compile(r'"[\w/%]{1,8}"')
FLAG = re.compile(r'"--[\w-]+"')
DESIGNATOR = re.compile(r"\.\w+\s*=\s*")
TEXT = re.compile(r'"[^"]*"')
NUMBER = re.compile(r"-?\s*(\d[\d'.]*(e[-+]?\d+)?|k[A-Z]\w*|\w*::infinity\(\))(\s*[-*/]\s*\d[\d'.]*)?", re.IGNORECASE)
LIST = re.compile(r"\w*\{(.*)\}", re.DOTALL)
RANGE_OF_FLAG = re.compile(r"\b(?:NumberIn|WholeIn|Range)\(\s*-?[\d.]")


def without_comments(text, strings=True):
    """Comments, and strings where asked, as blanks; lines keep their numbers."""
    def blank(match):
        kept = not strings or match[0].startswith(("//", "/*"))
        return re.sub(r"[^\n]", " ", match[0]) if kept else match[0]
    return NOT_CODE.sub(blank, text)


def opened_namespaces(text):
    """(line, name, whether it holds only forward declarations) of each namespace that is opened."""
    text = without_comments(text, strings=False)
    around = []  # (name or None for other braces, where its contents begin)
    for match in OPENS.finditer(text):
        if match[0] == "}":
            if around:
                name, begin = around.pop()
                if name:
                    contents, before = FORWARD.sub("", text[begin:match.start()]), None
                    while contents != before:
                        before, contents = contents, EMPTY.sub("", contents)
                    full = "::".join([*(outer for outer, _ in around if outer), name])
                    yield text.count("\n", 0, begin) + 1, full, not contents.strip()
        else:
            around.append((match[1] if match[0] != "{" else None, match.end()))


def namespaces_follow_rooms(tree):
    """A file opens its room's namespace and those below it that are no other room's. Other namespaces are opened for
    forward declarations alone, or are listed."""
    named, foreign = tree.law.rules["namespaces"], tree.law.rules["foreign_namespaces"]

    def owner(namespace):
        return house.within(namespace.replace("::", "/"), [name.replace("::", "/") for name in named.values()])

    for path, text in tree.code_in((*tree.rooms, "tests"), (".h", ".cc")):
        own = {named[folder] for folder in (house.within(path, named),
                                            house.within(path.removeprefix("tests/"), named)) if folder}
        if not own:
            yield f"{path}: rooms.toml gives its room no namespace"
            continue
        for line, namespace, forward in opened_namespaces(text):
            if not forward and namespace not in foreign and \
                    owner(namespace) not in [name.replace("::", "/") for name in own]:
                yield f"{path}:{line} opens {namespace}: expected {' or '.join(sorted(own))}"


def elements(group):
    """The parts of a bracketed list between its commas."""
    parts, depth, begin = [], 0, 0
    for match in re.finditer(r'"(?:\\.|[^"\\\n])*"|[({\[\]}),]', group):
        if match[0] in "({[":
            depth += 1
        elif match[0] in ")}]":
            depth -= 1
        elif match[0] == "," and depth == 0:
            parts.append(group[begin:match.start()].strip())
            begin = match.end()
    return [*parts, group[begin:].strip()]


def has_range(parts):
    """Two numbers side by side, in a list of their own or not."""
    numbers = [bool(NUMBER.fullmatch(part)) for part in parts]
    return any(a and b for a, b in zip(numbers, numbers[1:])) or \
        any(has_range(elements(match[1])) for part in parts if (match := LIST.fullmatch(part)))


class Key:
    """A key as a table declares it, with a range or a flag: {"kd", "1/m", 0.001, 10}, {.name = "scan",
    .unit = "degree", .greatest = 5}, {"water", "kd", NumberRange{...}}, {"level", "--water-level", kLevel}; in a table
    also without both, {"bias", "", Word{...}}.

    `statement` is the number of the statement that it stands in; a table is one."""

    def __init__(self, line, statement, parts, in_table):
        parts = [DESIGNATOR.sub("", part, count=1) if part.startswith(".") else part for part in parts]
        texts = [part.strip('"') for part in parts if TEXT.fullmatch(part)]
        names = [part.strip('"') for part in itertools.takewhile(NAME.fullmatch, parts)]
        self.line, self.statement = line, statement
        self.path = [name for name in names if name not in UNITS_LIKE_NAMES]
        self.name = self.path[-1] if self.path else ""
        self.flags = [text for text in texts if text.startswith("--")]
        greatest = len(parts) > 2 and UNIT.fullmatch(parts[1]) and NUMBER.fullmatch(parts[2])
        with_flag = len(parts) > 2 and (FLAG.fullmatch(parts[1]) or (in_table and parts[1] == '""'))
        self.stands = bool(self.path) and len(texts) > 1 and bool(greatest or with_flag or has_range(parts))


def declared_keys(text, in_table):
    text = without_comments(text)
    for match in re.finditer(r'[({]\s*(?=(?:\.\w+\s*=\s*)?"[a-z])', text):
        depth, end = 1, match.end()
        for bracket in re.finditer(r'"(?:\\.|[^"\\\n])*"|[({)}]', text[match.end():]):
            depth += {"(": 1, "{": 1, ")": -1, "}": -1}.get(bracket[0], 0)
            if depth == 0:
                end = match.end() + bracket.start()
                break
        key = Key(text.count("\n", 0, match.end()) + 1, text.count(";", 0, match.end()),
                  elements(text[match.end():end]), in_table)
        if key.stands:
            yield key


def keys_are_declared_once(tree):
    """A key with its range and unit stands in the tables of keys alone, once in one of them; its flag has no other
    range."""
    for rule in tree.law.rules["keys"]:
        tables, entries, holders, flags = rule["tables"], set(), {}, {}
        for path, text in tree.code_in(tables, (".h", ".cc")):
            for key in declared_keys(text, in_table=True):
                entry, holder = (path, key.statement, *key.path), holders.setdefault(key.name, path)
                if entry in entries or (holder != path and key.name not in rule["shared"]):
                    yield f"{path}:{key.line} declares the key '{key.name}', which {holder} declares, too"
                entries.add(entry)
                flags |= {flag: path for flag in key.flags}
        for table in tables:
            if table not in {path for path, *_ in entries}:
                yield f"{table}: no key was found there"
        for path, text in tree.code_in(rule["rooms"], (".h", ".cc")):
            if house.within(path, tables):
                continue
            for key in declared_keys(text, in_table=False):
                yield f"{path}:{key.line} declares the range of '{key.name}': only {', '.join(tables)} may"
            text = without_comments(text)
            for statement in re.finditer(r"[^;]+", text):
                for flag in re.finditer(r'"(--[\w-]+)', statement[0]):
                    if flag[1] in flags and RANGE_OF_FLAG.search(statement[0]):
                        line = text.count("\n", 0, statement.start() + flag.start()) + 1
                        yield f"{path}:{line} gives {flag[1]} a range, which {flags[flag[1]]} declares"
