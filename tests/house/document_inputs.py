"""The files that the commands of the documents read: simulated surveys, pulses and a buoy's spectrum."""

import random
import shutil
import struct
import subprocess

# Simulated surveys, and the names that their files have in the documents: a line without errors, and overlapping lines
# whose points have the errors that survey files in the documents declare.
SURVEYS = [
    (["--surface-share", "1"], {"flight.las": "line.las"}),
    (["--start", "330000", "--lines", "5", "--cross-lines", "2", "--seconds", "12", "--pulse-rate", "2000",
      "--file-for-each-line", "--surface-share", "1", "--column-share", "0", "--trajectory-errors",
      "--scan-noise", "0.02", "--range-noise", "0.025", "--wave-slopes", "0.09,0.078", "--wind-from", "250"],
     {f"flight_{i}.las": f"lines/line_{i}.las" for i in range(1, 8)}),
]
PULSES = "id,depth,incidence\n1,2.5,12\n2,8,0\n"
# The record of a buoy: energy (m2/Hz), the first and second directions (degree) and r1, r2, by frequency (Hz).
BUOY = [
    (0.05, 0.00, 90, 0.5, 0.2), (0.07, 0.22, 62, 0.9, 0.6), (0.09, 0.04, 65, 0.8, 0.5), (0.12, 0.28, 84, 0.8, 0.4),
    (0.14, 0.64, 88, 0.8, 0.5), (0.17, 1.21, 97, 0.8, 0.5), (0.20, 0.29, 110, 0.7, 0.4), (0.25, 0.16, 131, 0.7, 0.3),
    (0.30, 0.11, 140, 0.6, 0.3), (0.36, 0.06, 146, 0.6, 0.3), (0.42, 0.03, 150, 0.5, 0.2), (0.48, 0.02, 152, 0.5, 0.2),
]


def write_buoy(folder):
    """A buoy's spectrum as NDBC writes it: buoy.data_spec, and its directions beside it."""
    for suffix, name, at in ((".data_spec", "spec", 1), (".swdir", "alpha1", 2), (".swdir2", "alpha2", 2),
                             (".swr1", "r1", 3), (".swr2", "r2", 4)):
        first = "Sep_Freq  < " if at == 1 else ""
        head = f"#YY  MM DD hh mm {first}{name}_1 (freq_1) {name}_2 (freq_2) {name}_3 (freq_3) ... >"
        record = "2020 06 08 03 50 " + ("0.225 " if at == 1 else "")
        pairs = " ".join(f"{row[at]:.3f} ({row[0]:.3f})" for row in BUOY)
        (folder / f"buoy{suffix}").write_text(f"{head}\n{record}{pairs}\n")


def write_check_points(path, flights):
    """40 points of the bottom of a flight without errors, each with an error of 2 cm."""
    rows = ["id,x,y,elevation"]
    draw = random.Random(1)
    for flight in flights:
        las = flight.read_bytes()
        begin, length = struct.unpack_from("<I", las, 96)[0], struct.unpack_from("<H", las, 105)[0]
        scale, offset = struct.unpack_from("<3d", las, 131), struct.unpack_from("<3d", las, 155)
        bottom = [at for at in range(begin, len(las) - length + 1, length) if las[at + 16] == 40]
        for at in draw.sample(bottom, 8):
            x, y, z = (n * s + o for n, s, o in zip(struct.unpack_from("<3i", las, at), scale, offset))
            rows.append(f"P{len(rows)},{x:.3f},{y:.3f},{z + draw.gauss(0, 0.02):.3f}")
    path.write_text("\n".join(rows) + "\n")


def make_inputs(folder, simulated_survey):
    """Writes them to folder/inputs."""
    for number, (flags, names) in enumerate(SURVEYS):
        made = folder / f"survey_{number}"
        subprocess.run([simulated_survey, made, *flags], check=True)
        trajectory = {"sbet.out": f"sbet/sbet_{number}.out", "smrmsg.out": f"smrmsg/smrmsg_{number}.out"}
        for name, given in {**names, **trajectory}.items():
            (folder / "inputs" / given).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(made / name, folder / "inputs" / given)
    right = folder / "right"
    flags = SURVEYS[1][0]
    flags = flags[:flags.index("--trajectory-errors")]
    subprocess.run([simulated_survey, right, *flags], check=True)
    write_check_points(folder / "inputs/points.csv", [right / f"flight_{i}.las" for i in range(1, 6)])
    write_buoy(folder / "inputs")
    (folder / "inputs/pulses.csv").write_text(PULSES)
