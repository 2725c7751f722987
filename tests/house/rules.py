"""All rules of the house, with what they need of [rules] in rooms.toml."""

import contents
import shape
import uses

RULES = {
    uses.code_lies_in_rooms: None,
    uses.includes_follow_the_law: None,
    uses.libraries_are_allowed: None,
    uses.headers_are_named_from_the_root: None,
    uses.heavy_headers_stay_out_of_headers: "heavy_headers",
    uses.links_follow_the_law: None,
    uses.sources_are_compiled_once: None,
    uses.includes_make_no_circle: None,
    uses.the_law_has_no_circle: None,
    shape.folders_are_flat: "levels",
    shape.folders_are_not_crowded: "files_in_folder",
    shape.files_hold_one_idea: "lines_in_file",
    shape.files_are_not_slivers: "median_lines",
    shape.rooms_are_not_towers: "lines_in_room",
    shape.tests_mirror_the_tree: "tests_of_many_rooms",
    shape.rooms_say_who_lives_there: "lines_in_readme",
    shape.readmes_do_not_repeat_the_law: "left_to_rooms_toml",
    contents.namespaces_follow_rooms: "namespaces",
    contents.keys_are_declared_once: "keys",
}


def held(law):
    """The rules that a law states."""
    unknown = set(law.rules) - set(RULES.values()) - {"foreign_namespaces"}
    if unknown:
        raise ValueError(f"rooms.toml: no rule takes {', '.join(sorted(unknown))}")
    return [rule for rule, needed in RULES.items() if needed is None or needed in law.rules]
