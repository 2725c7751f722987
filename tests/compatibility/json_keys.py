"""Members of JSON that are keys of survey files: docs/json.md has their meaning, unit and range from
`albtpu-query keys`. Of such a member, the page names the key first: "key `[surface] level`"; what follows is made here.
"""

import re

# Types whose members are keys of a section, and keys of it that are not among them.
OF_SECTION = {"settings of sea": ("sea", {"fetch"}), "settings of waves": ("sea.waves", {"spreading"}),
              "settings of channel": ("sensor.channel", {"name"}), "project": ("project", set())}
OTHERWISE = {"sea", "coverage"}  # Named as a flag, but not what it takes.
ROW = re.compile(r"^(\| `(\w+)` \|[^|]*\| )([^|]*)( \|[^|]*\| )key `\[([\w.]+)\] (\w+)`[^|]*\|$", re.MULTILINE)


def range_of(key):
    if key["least"] is None:
        return "".join(f", {word}" for word in key["words"])
    return f", {key['least']:g} to " + ("inf" if key["greatest"] is None else f"{key['greatest']:g}")


def renewed(page, keys):
    """The page with what the keys say now."""
    known = {(key["section"], key["key"]): key for key in keys}

    def row(found):
        begin, _, unit, middle, section, name = found.groups()
        key = known[section, name]
        return f"{begin}{key['unit'] or unit}{middle}key `[{section}] {name}`{range_of(key)}: {key['help']} |"

    return ROW.sub(row, page)


def unnamed(page, types, keys):
    """(member, section, key) of keys that stand in the JSON, and of which the page does not say so."""
    wanted = set()
    for key in keys:
        place = key["section"], key["key"]
        wanted |= {(key["key"], *place) for section, absent in OF_SECTION.values()
                   if key["section"] == section and key["key"] not in absent}
        member = (key["flag"] or "")[2:].replace("-", "_")
        if member in types["parameters"].keys() - OTHERWISE:
            wanted.add((member, *place))
    return wanted - {found.group(2, 5, 6) for found in ROW.finditer(page)}
