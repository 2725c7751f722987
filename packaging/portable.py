"""Makes installed programs relocatable, with the libraries of this machine that they need, and packs them.

Usage: portable.py INSTALLED OUTPUT VERSION

INSTALLED is a prefix of `cmake --install`, which this changes. OUTPUT gets albtpu-VERSION-linux-x86_64.tar.xz and
albtpu-VERSION-py3-none-manylinux_2_36_x86_64.whl. Debian 12 has the oldest C library that the programs then need.
"""

import collections
import os
import pathlib
import re
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
PLATFORM = "manylinux_2_36_x86_64"
# The C library belongs to the system, and the policy of manylinux_2_36 expects these two of it as well.
SYSTEM = re.compile(r"(ld-linux-x86-64|lib(c|m|dl|rt|pthread|resolv|util|gcc_s|stdc\+\+))\.so\.\d+")
# Libraries whose place an empty one takes, and why nothing misses them. They would bring 35 more, among them 33 MB of
# ICU, a second TLS library that needs security updates, and libjbig, which is under the GPL.
EMPTY = {"libcurl-gnutls.so.4": "PROJ and NetCDF would read from the network", "libcurl.so.4": "HDF5 would, too",
         "libxml2.so.2": "NetCDF would read what DAP servers describe",
         "libjbig.so.0": "PROJ's grids are no fax images"}
DATABASE = pathlib.Path("/usr/share/proj/proj.db")
GPL_PROGRAM = "albtpu-generate"  # Links FFTW.

Library = collections.namedtuple("Library", "name package version source")


def output(*command):
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout


def needed(file):
    return output("patchelf", "--print-needed", str(file)).split()


def system_libraries():
    lines = re.findall(r"^\s+(\S+) \(libc6,x86-64[^)]*\) => (\S+)$", output("/sbin/ldconfig", "-p"), re.MULTILINE)
    return dict(reversed(lines))  # The first one that ldconfig lists is the one that the loader takes.


def copy_libraries(programs, folder):
    """Copies what the programs need into the folder. Returns where each library was."""
    known, copied, files = system_libraries(), {}, list(programs)
    while files:
        for name in needed(files.pop()):
            if name in copied or name in EMPTY or SYSTEM.fullmatch(name):
                continue
            copied[name] = pathlib.Path(known[name]).resolve()
            shutil.copyfile(copied[name], folder / name)
            files.append(folder / name)
    return copied


def symbols(flag, file):
    return set(re.findall(r"^[0-9a-f ]* [UTDBRVWi] (\S+)$", output("nm", "-D", flag, str(file)), re.MULTILINE))


def write_empty_library(name, folder):
    """Writes a library with the symbols that the other ones in the folder want of `name`: functions that return 0."""
    wanted = set().union(*(symbols("--undefined-only", file) for file in folder.glob("*.so*")))
    exported = {symbol.replace("@@", "@") for symbol in symbols("--defined-only", system_libraries()[name])}
    versions = collections.defaultdict(list)
    for symbol in sorted(wanted & exported):
        symbol, _, version = symbol.partition("@")
        versions[version].append(symbol)
    assert versions, f"nothing needs {name}"
    script = folder / "versions"
    script.write_text("".join(f"{version} {{ {'; '.join(names)}; }};\n" for version, names in versions.items()))
    source = "".join(f"long {symbol}(void) {{ return 0; }}\n" for names in versions.values() for symbol in names)
    command = ["gcc", "-shared", "-fPIC", "-O1", "-s", f"-Wl,-soname,{name}", "-o", folder / name, "-x", "c", "-"]
    if "" not in versions:
        command.insert(1, f"-Wl,--version-script={script}")
    subprocess.run(command, check=True, input=source, text=True)
    script.unlink()


def find_beside_themselves(programs, libraries):
    """RPATH instead of RUNPATH: an LD_LIBRARY_PATH that is meant for other programs does not replace the libraries."""
    for files, path in ((programs, "$ORIGIN/../lib"), (libraries, "$ORIGIN")):
        for file in files:
            subprocess.run(["patchelf", "--force-rpath", "--set-rpath", path, file], check=True)


def package_of(file):
    """The Debian package of a file of the system, as dpkg knows it: before or after /usr was merged."""
    for path in (file, pathlib.Path("/", *file.parts[2:])):
        found = subprocess.run(["dpkg-query", "--search", path], capture_output=True, text=True)
        if found.returncode == 0:
            return found.stdout.split(": ")[0]
    raise SystemExit(f"{sys.argv[0]}: no package has {file}")


def compiled_in():
    """The Debian packages of which the programs contain at least headers; these are built without MPI."""
    section = re.search(r"\n# libraries,.*\n([^#]*)\n#", (HERE.parent / "packages.txt").read_text())[1]
    return set(section.split()) - {"libopenmpi-dev"}


def write_licences(copied, compiled, folder):
    """Writes the licence of each package that was copied from or compiled in, and README.md, which lists them."""
    folder.mkdir()
    packages = collections.defaultdict(list)
    for name, file in copied.items():
        packages[package_of(file)].append(name)
    for package in compiled:
        packages[package].append("compiled into the programs")
    common, rows = set(), []
    for package, names in sorted(packages.items()):
        form = "${Package}\t${Version}\t${source:Package} ${source:Version}"
        package, version, source = output("dpkg-query", "--show", f"--showformat={form}", package).split("\t")
        text = pathlib.Path("/usr/share/doc", package, "copyright").read_text(errors="replace")
        (folder / f"{package}.txt").write_text(text)
        common |= set(re.findall(r"/usr/share/common-licenses/([\w.-]*\w)", text))
        short = sorted(set(re.findall(r"^License: *(\S.*?) *$", text, re.MULTILINE)))
        rows.append(f"| {', '.join(sorted(names))} | {package} {version} | {source} | {', '.join(short)} |\n")
    for name in sorted(common | {"GPL-3"}):
        shutil.copyfile(pathlib.Path("/usr/share/common-licenses", name), folder / f"{name}.txt")
    shutil.copyfile(HERE.parent / "LICENSE", folder / "albtpu.txt")
    (folder / "README.md").write_text(f"""\
# Licences

albtpu is under Apache-2.0 ([albtpu.txt](albtpu.txt)). `{GPL_PROGRAM}` links FFTW (GPL-2-or-later), so this program is
distributed under [GPL-3](GPL-3.txt); where it is absent, nothing here is under the GPL alone.

The libraries in lib/ and the database of PROJ (share/albtpu/proj) are those of Debian 12, unchanged but for the path on
which they find each other. PACKAGE.txt beside this file has the copyright and the licences of each package in full,
those of its tools and tests included. Debian publishes the sources: `apt-get source PACKAGE=VERSION`, or
snapshot.debian.org.

| library | package | source | licences in the package |
| --- | --- | --- | --- |
{''.join(rows)}
In place of these libraries there are empty ones of albtpu, which offer no function: {', '.join(EMPTY)}.
""")


def without_gpl(tree, target):
    """Copies the tree without the program under the GPL, what only it needs, and what the Python package has."""
    shutil.copytree(tree, target, symlinks=True, ignore=lambda folder, names: {
        name for name in names if name == GPL_PROGRAM or pathlib.Path(folder, name) in (
            tree / "LICENSES", tree / "share/doc", tree / "share/albtpu/campaigns", tree / "share/albtpu/python",
            tree / "share/albtpu/validation")})
    used = set()
    files = list((target / "bin").iterdir())
    while files:
        for name in needed(files.pop()):
            if name not in used and not SYSTEM.fullmatch(name):
                used.add(name)
                files.append(target / "lib" / name)
    for file in (target / "lib").iterdir():
        if file.name not in used:
            file.unlink()
    return used


def set_usual_modes(tree):
    """Those of this user's umask and of the checkout would be in the archive and in the wheel."""
    for path in (tree, *tree.rglob("*")):
        if not path.is_symlink():
            path.chmod(0o755 if path.is_dir() or path.stat().st_mode & 0o100 else 0o644)


def pack_archive(tree, file):
    time = os.environ.get("SOURCE_DATE_EPOCH", "0")
    set_usual_modes(tree)
    # One thread would make other blocks than two or more.
    threads = f"--threads={max(2, os.cpu_count() or 0)}"
    subprocess.run(["tar", "--create", "--xz", "--sort=name", "--owner=0", "--group=0", "--numeric-owner",
                    f"--mtime=@{time}", f"--file={file}", f"--directory={tree.parent}", tree.name],
                   check=True, env={"XZ_OPT": threads, **os.environ})


def pack_tree_as_wheel(tree, folder):
    set_usual_modes(tree)
    subprocess.run([sys.executable, "-B", "-m", "wheel", "pack", "--dest-dir", folder, tree], check=True,
                   stdout=subprocess.DEVNULL)


def pack_wheel(tree, copied, work, folder):
    """Adds the programs to the wheel that setuptools makes of the Python package."""
    source = work / "python"
    shutil.copytree(HERE.parent / "clients/python", source,
                    ignore=shutil.ignore_patterns("__pycache__", "build", "*.egg-info"))
    python = [sys.executable, "-B", "-m"]
    subprocess.run([*python, "pip", "wheel", "--quiet", "--no-index", "--no-deps", "--no-build-isolation",
                    "--wheel-dir", work, source], check=True)
    pure = next(work.glob("albtpu-*-py3-none-any.whl"))
    subprocess.run([*python, "wheel", "unpack", "--dest", work, pure], check=True, stdout=subprocess.DEVNULL)
    content = work / pure.name.removesuffix("-py3-none-any.whl")
    used = without_gpl(tree, content / "albtpu_programs")
    shutil.copyfile(HERE / "albtpu_programs/__init__.py", content / "albtpu_programs/__init__.py")
    information = next(content.glob("*.dist-info"))
    write_licences({name: file for name, file in copied.items() if name in used | {DATABASE.name}},
                   compiled_in() - {"libfftw3-dev"}, information / "licenses")
    with open(information / "entry_points.txt", "a") as file:
        file.write("\n[console_scripts]\nalbtpu-query = albtpu_programs:query\nalbtpu-serve = albtpu_programs:serve\n")
    with open(information / "top_level.txt", "a") as file:
        file.write("albtpu_programs\n")
    wheel = information / "WHEEL"
    wheel.write_text(wheel.read_text().replace("Root-Is-Purelib: true", "Root-Is-Purelib: false")
                     .replace("Tag: py3-none-any", f"Tag: py3-none-{PLATFORM}"))
    metadata = information / "METADATA"
    metadata.write_text(metadata.read_text().replace(
        "License: Apache-2.0\n", "License: Apache-2.0; the libraries of Debian as licenses/README.md says, none GPL\n"))
    pack_tree_as_wheel(content, folder)


def main(installed, folder, version):
    work = installed.parent / "packing"
    shutil.rmtree(work, ignore_errors=True)
    tree = work / f"albtpu-{version}-linux-x86_64"
    for part in ("bin", "share"):
        shutil.copytree(installed / part, tree / part)
    (tree / "lib").mkdir()
    programs = sorted((tree / "bin").iterdir())
    copied = copy_libraries(programs, tree / "lib")
    for name in EMPTY:
        write_empty_library(name, tree / "lib")
    find_beside_themselves(programs, sorted((tree / "lib").iterdir()))
    (tree / "share/albtpu/proj").mkdir()
    shutil.copyfile(DATABASE, tree / "share/albtpu/proj" / DATABASE.name)
    copied[DATABASE.name] = DATABASE
    write_licences(copied, compiled_in(), tree / "LICENSES")
    folder.mkdir(parents=True, exist_ok=True)
    pack_archive(tree, folder / f"{tree.name}.tar.xz")
    pack_wheel(tree, copied, work, folder)
    shutil.rmtree(work)


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve(), sys.argv[3])
