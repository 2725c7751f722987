"""The pages of the documents, and what is in them."""

import re

BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def pages(source):
    """The pages whose commands are run, from the root of the tree."""
    patterns = ("*.md", "docs/**/*.md", "clients/**/*.md", "tables/*.md", "tests/bench/*.md")
    return sorted(path.relative_to(source).as_posix() for pattern in patterns for path in source.glob(pattern))


def headings(page):
    """The names by which links reach the headings of a page."""
    found = re.findall(r"^#+ (.+)$", BLOCK.sub("", page.read_text()), re.MULTILINE)
    return {re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-") for heading in found}


def commands_not_run(text):
    """The commands of ```sh blocks, without comments; lines that end in a backslash joined."""
    for kind, content in BLOCK.findall(text):
        for line in content.replace("\\\n", " ").splitlines() if kind == "sh" else []:
            if command := re.sub(r"(^|\s)#.*", "", line).strip():
                yield command


def shown(content):
    """[(command as shown, lines shown below it)] of a ```console block."""
    found = []
    for line in content.splitlines():
        if line.startswith("$ "):
            found.append(([line[2:]], []))
        elif found and not found[-1][1] and found[-1][0][-1].endswith("\\"):
            found[-1][0].append(line)
        else:
            assert found, f"no command prints '{line}'"
            found[-1][1].append(line)
    return [("\n".join(command), output) for command, output in found]
