"""Draws the figures of a validation report from its CSV files, as SVG.

    python3 draw.py CSV_FOLDER SVG_FOLDER FIGURE...

Each figure is drawn by the function of that name in one of the modules beside this file. The function receives `read`,
which reads a CSV file by its name without suffix into a NumPy record array (numbers where a column holds only numbers,
text otherwise), and returns a matplotlib Figure. If one figure fails, the others are still drawn.
"""

import csv
import importlib
import pathlib
import sys

import matplotlib

matplotlib.use("svg")
import numpy

STYLE = {
    "svg.hashsalt": "albtpu",  # so that the same numbers give the same bytes
    "font.size": 10,
    "axes.grid": True,
    "grid.alpha": 0.3,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "legend.frameon": False,
    "figure.figsize": (7, 4.2),
    "figure.constrained_layout.use": True,
}


def modules():
    here = pathlib.Path(__file__).resolve().parent
    sys.path.insert(0, str(here))
    names = sorted(path.stem for path in here.glob("*.py") if path.stem != "draw")
    return [importlib.import_module(name) for name in names]


def column(cells):
    try:
        return numpy.array([float(cell or "nan") for cell in cells])
    except ValueError:
        return numpy.array(cells)


def read_csv(path):
    with open(path, newline="", encoding="utf-8") as file:
        names, *rows = csv.reader(file)
    return numpy.rec.fromarrays([column(cells) for cells in zip(*rows)], names=names)


def main(csv_folder, svg_folder, figures):
    def read(name):
        return read_csv(pathlib.Path(csv_folder) / f"{name}.csv")

    drawers = {name: function for module in modules() for name, function in vars(module).items()}
    matplotlib.rcParams.update(STYLE)
    failed = []
    for figure in figures:
        try:
            drawn = drawers[figure](read)
            drawn.savefig(pathlib.Path(svg_folder) / f"{figure}.svg", metadata={"Date": None})
        except Exception as error:  # of any kind: the other figures are still drawn
            failed.append(f"{figure}: {error!r}")
    if failed:
        sys.exit("draw.py: " + "; ".join(failed))


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], sys.argv[3:])
