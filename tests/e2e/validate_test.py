"""The report of `albtpu-generate validate --quick`: its form, and the verdicts that physics predicts, agreements and
differences.

Usage: validate_test.py ALBTPU_GENERATE
"""

import collections
import csv
import html.parser
import importlib.util
import math
import re
import shutil
import sys
import unittest

from commands import make_folder, run

GENERATE = sys.argv[1]


def validate(*arguments):
    return run(GENERATE, "validate", *arguments, timeout=None)


class Page(html.parser.HTMLParser):
    """Collects the references of the page, and checks that its elements are nested correctly."""

    VOID = {"meta", "img", "br", "link"}

    def __init__(self, text):
        super().__init__()
        self.open, self.ids, self.anchors, self.images, self.foreign = [], set(), set(), [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        if tag not in self.VOID:
            self.open.append(tag)
        self.ids.add(attributes.get("id"))
        for name in ("href", "src"):
            target = attributes.get(name, "")
            if target.startswith("#"):
                self.anchors.add(target[1:])
            elif target.startswith("data:"):
                self.images.append(attributes)
            elif target:
                self.foreign.append(target)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag, tag


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = make_folder(cls.addClassCleanup) / "a report"
        cls.made = validate("--quick", "--output", cls.folder)
        assert cls.made.returncode == 0, cls.made.stderr
        cls.text = (cls.folder / "report.html").read_text()
        cls.page = Page(cls.text)

    def summary(self):
        with open(self.folder / "summary.csv", newline="") as file:
            return list(csv.DictReader(file))

    def comparisons(self, study):
        return [line for line in self.summary() if line["study"] == study]

    def table(self, name):
        """The rows of a table; what is no number is text."""
        def number(cell):
            try:
                return float(cell)
            except ValueError:
                return cell
        with open(self.folder / f"{name}.csv", newline="") as file:
            return [{column: number(cell) for column, cell in row.items()} for row in csv.DictReader(file)]

    def test_is_a_single_page_without_external_references(self):
        self.assertEqual(self.page.open, [])
        self.assertEqual(self.page.foreign, [])
        self.assertLessEqual(self.page.anchors, self.page.ids)

    def test_counts_its_verdicts(self):
        verdicts = [line["verdict"] for line in self.summary()]
        counts = {verdict: str(verdicts.count(verdict)) for verdict in ("agrees", "differs", "reported")}
        self.assertEqual(dict(line.split() for line in self.made.stdout.splitlines()), counts)

    def test_states_the_basis_of_every_comparison(self):
        for line in self.summary():
            self.assertTrue(line["basis"], line)
            self.assertTrue(line["ours"], line)
            if line["published"]:
                self.assertAlmostEqual(float(line["difference"]), float(line["ours"]) - float(line["published"]),
                                       delta=1e-6 * max(1, abs(float(line["published"]))))

    def test_has_every_table_and_figure_of_the_paper(self):
        studies = {line["study"] for line in self.summary()}
        for study in ("figures_2_and_3", "table_2", "table_3", "table_4", "table_5"):
            self.assertIn(study, studies)
        for table in self.folder.glob("*.csv"):
            with open(table, newline="") as file:
                rows = list(csv.reader(file))
            self.assertGreater(len(rows), 1, table.name)
            self.assertEqual({len(row) for row in rows}, {len(rows[0])}, table.name)

    def test_differs_only_where_physics_predicts_it(self):
        # Table 3 is sqrt 2 times the model along the wind, and across it rises with neither wind nor incidence; Table 4
        # rises with wind; Table 5 has another limit than S-44; and slopes: see below.
        differing = collections.Counter(line["study"] for line in self.summary() if line["verdict"] == "differs")
        self.assertEqual(differing, {"table_3": 2, "table_4": 2, "table_5": 1, "real_sea": 10})

    def test_traces_table_3_but_for_sqrt_2_along_the_wind(self):
        judged = {line["quantity"]: line for line in self.comparisons("table_3") if line["verdict"] != "reported"}
        self.assertEqual(sum("onte Carlo" in quantity for quantity in judged), 4)
        self.assertEqual(sum("from one" in quantity or "exceeds" in quantity for quantity in judged), 4)
        for quantity, line in judged.items():
            differs = "ratio of closed form to paper" in quantity or "cross wind, rms" in quantity
            self.assertEqual(line["verdict"], "differs" if differs else "agrees", quantity)
        # Which holds for small standard errors only.
        self.assertIn("at least 0.95", judged["Lowest R^2 of along wind over wind, fine Monte Carlo"]["basis"])

    def test_has_the_peak_of_the_laboratory_waves(self):
        found = self.comparisons("figures_2_and_3")
        # The spread of Table 2 about Eq. 5.
        self.assertLess(abs(float(found[0]["ours"]) / float(found[0]["published"]) - 1), 0.2)
        self.assertEqual(found[-1]["verdict"], "agrees")
        power = sum(row["power"] for row in self.table("figure_3_spot"))
        # Through still water a 0.25 m beam at 15 degrees lights an ellipse, 1.05 times wider 0.25 m down; no ray is
        # lost.
        lit = math.pi / 4 * 0.25 ** 2 / 0.966 * 1.05 ** 2 / 0.003 ** 2
        self.assertLess(abs(power / lit - 1), 0.02)

    def test_finds_elfouhailys_slopes_within_the_scatter_of_cox_and_munk_and_apels_above(self):
        # In light wind Elfouhaily's sea is too steep; over all winds it is therefore not within the scatter.
        slopes = [line for line in self.comparisons("real_sea") if "Mean square slope" in line["quantity"] and
                  not re.search(r" [12] m/s", line["quantity"])]
        for line in slopes:
            within = "Elfouhaily" in line["quantity"] and "1-14 m/s" not in line["quantity"]
            self.assertEqual(line["verdict"], "agrees" if within else "differs", line)
        self.assertEqual(len(slopes), 2 * (3 * 2 + 2))
        # The ratio of the two spectra is the same in the Monte Carlo and in the closed form, except for the
        # nonlinearity of each, up to 0.3 of the mean square slopes (0.13 and 0.06 at 10 m/s).
        simulated = self.table("spectra_monte_carlo")
        self.assertTrue(simulated)
        for row in simulated:
            self.assertLess(abs(row["thu_ratio"] / row["thu_ratio_closed_form"] - 1),
                            0.03 + 3 * row["thu_ratio_standard_error"] / row["thu_ratio"], row)

    def test_agrees_between_monte_carlo_and_closed_form_where_waves_are_corrected(self):
        found = self.comparisons("corrected_waves")
        self.assertIn("agrees", {line["verdict"] for line in found})
        self.assertNotIn("differs", {line["verdict"] for line in found})
        # The vertical bias at nadir is of second order in slope, and waves of all lengths contribute to it: it is
        # proportional to the remaining mean square slope. The next order is smaller by about that slope.
        first, *others = self.table("corrected_waves_monte_carlo")
        self.assertTrue(others)
        for row in others:
            bias, slope = (row[name] / first[name] for name in ("nadir_bias_vertical_m", "mean_square_slope"))
            self.assertLess(abs(bias - slope), first["mean_square_slope"], row)
            self.assertLess(bias, 1, row)
        table = self.table("corrected_waves")
        self.assertGreater(len(table), 1)
        for before, row in zip(table, table[1:]):
            if row["corrected_above_m"] != "nothing":
                self.assertLessEqual(row["thu_per_depth"], before["thu_per_depth"] * (1 + 1e-6), row)

    def test_finds_the_response_theory_in_agreement_with_tracing(self):
        verdicts = [line["verdict"] for line in self.comparisons("response_theory")]
        self.assertGreaterEqual(verdicts.count("agrees"), 5)
        self.assertNotIn("differs", verdicts)

    def test_contains_its_figures(self):
        if importlib.util.find_spec("matplotlib") is None:
            self.assertIn("Figures are missing", self.text)
            self.skipTest("matplotlib is missing; apt-get install python3-matplotlib")
        self.assertNotIn("is missing", self.text)
        self.assertEqual(len(self.page.images), len(list(self.folder.glob("*.svg"))))
        for image in self.page.images:
            self.assertGreater(len(image["alt"]), 20)

    def test_fits_the_screens_of_a_phone_and_a_desktop(self):
        browser = shutil.which("chromium")
        if browser is None:
            self.skipTest("chromium is missing; apt-get install chromium")
        for width in (390, 1280):
            frame = self.folder / "frame.html"
            frame.write_text(
                f'<iframe id="f" src="report.html" style="width:{width}px;height:800px;border:0"></iframe>'
                "<p id=seen></p><script>f.onload = () => { const page = f.contentDocument.documentElement;"
                "seen.textContent = `widths ${page.scrollWidth} ${page.clientWidth}`; }</script>")
            seen = run(browser, "--headless", "--no-sandbox", "--disable-gpu", "--allow-file-access-from-files",
                       "--virtual-time-budget=20000", "--dump-dom", frame.as_uri()).stdout
            frame.unlink()
            scroll, client = map(int, re.search(r"widths (\d+) (\d+)", seen).groups())
            self.assertLessEqual(scroll, client, f"wider than {width} pixels")

    def test_is_replaced_only_with_overwrite(self):
        before = (self.folder / "report.html").stat().st_mtime_ns
        again = validate("--quick", "--output", self.folder)
        self.assertEqual(again.returncode, 1)
        self.assertIn("is not empty; give another folder, or replace what is there by --overwrite", again.stderr)
        self.assertEqual((self.folder / "report.html").stat().st_mtime_ns, before)

    def test_is_not_started_if_it_cannot_be_written(self):
        for output, code in ((self.folder / "none" / "deeper", 1), (self.folder / "summary.csv", 1)):
            run = validate("--output", output)
            self.assertEqual(run.returncode, code, run.stderr)
            self.assertNotIn("study 1", run.stderr)
        self.assertEqual(validate().returncode, 2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
