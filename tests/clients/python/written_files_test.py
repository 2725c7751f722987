"""Files that Python writes are whole or not there, also where the disk is full.

Usage: written_files_test.py ALBTPU_SYNTHETIC_TABLE
"""

import contextlib
import resource
import subprocess
import sys
import unittest

import albtpu
from albtpu.report.markup import write_document
from commands import make_folder

SYNTHETIC_TABLE = sys.argv[1]


@contextlib.contextmanager
def full_disk():
    """Within it no file grows beyond 1000 bytes: what is written beyond fails, as on a full disk."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1000, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


class Written(unittest.TestCase):
    def setUp(self):
        self.folder = make_folder(self.addCleanup)

    def names(self):
        return sorted(path.name for path in self.folder.iterdir())


class Pages(Written):
    def setUp(self):
        super().setUp()
        self.page = self.folder / "report.html"

    def test_replace_an_earlier_page(self):
        for title in ("Earlier", "Later"):
            write_document(self.page, title, "<p>Words</p>")
            self.assertIn(f"<title>{title}</title>", self.page.read_text())
            self.assertTrue(self.page.read_text().endswith("</html>\n"))
        self.assertEqual(self.names(), ["report.html"])

    def test_leave_an_earlier_page_as_it_is_on_a_full_disk(self):
        write_document(self.page, "Earlier", "<p>Words</p>")
        before = self.page.read_bytes()
        with full_disk(), self.assertRaises(OSError):
            write_document(self.page, "Later", "<p>Words</p>")
        self.assertEqual(self.page.read_bytes(), before)
        self.assertEqual(self.names(), ["report.html"])

    def test_are_of_a_folder_that_has_a_report(self):
        for folder in (self.folder, self.folder / "absent"):
            result = subprocess.run([sys.executable, "-m", "albtpu.report", folder], capture_output=True, text=True,
                                    check=False)
            self.assertEqual(result.returncode, 1)
            self.assertIn(f"{folder}: no report.json or plan.json", result.stderr)

    def test_leave_nothing_on_a_full_disk(self):
        with full_disk(), self.assertRaises(OSError):
            write_document(self.page, "First", "<p>Words</p>")
        self.assertEqual(self.names(), [])

    def test_are_written_where_a_link_points(self):
        link = self.folder / "link.html"
        link.symlink_to(self.page)
        write_document(link, "Linked", "<p>Words</p>")
        self.assertTrue(link.is_symlink())
        self.assertIn("<title>Linked</title>", self.page.read_text())


class Tables(Written):
    def setUp(self):
        super().setUp()
        path = self.folder / "synthetic.h5"
        subprocess.run([SYNTHETIC_TABLE, path], check=True)
        self.table, self.bytes = albtpu.open_table(path), path.read_bytes()
        self.saved = self.folder / "saved.h5"

    def test_are_saved_whole_and_overwrite_nothing(self):
        self.table.save(self.saved)
        self.assertEqual(self.saved.read_bytes(), self.bytes)
        self.saved.write_bytes(b"another file")
        with self.assertRaisesRegex(albtpu.TableFileError, "saved.h5"):
            self.table.save(self.saved)
        self.assertEqual(self.saved.read_bytes(), b"another file")

    def test_leave_nothing_on_a_full_disk(self):
        with full_disk(), self.assertRaisesRegex(albtpu.TableFileError, "saved.h5"):
            self.table.save(self.saved)
        self.assertEqual(self.names(), ["synthetic.h5"])
        self.table.save(self.saved)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
