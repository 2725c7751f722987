"""Points of several scanners in one LAS file: each has the sensor of its channel, in one pass over the file."""

import json
import struct

import numpy as np

import programs
from las_file import LasFile
from programs import query
from simulated_survey import SimulatedSurvey

DECIDED = "[datum]\nsigma = 0.08\n[water]\ncolumn = 'none'\n"
WIND = "[sea]\nwind_speed = 6.5\nwind_from = 100\n"
OWN = """title = "Narrow"
[scan]
value = 0.004
unit = "degree"
source = "a test"
[bottom_range]
value = 0.012
unit = "m"
source = "a test"
[divergence]
value = 3
unit = "mrad"
source = "a test"
"""
# What is of each scanner: keys of its channel, and its table of sigmas. The first is installed, the second a file.
ARMS = ("0.3,-0.2,0.5", "-0.4,0.1,0.3")
KEYS = (f"name = 'riegl-vq-880-g'\nlever_arm = [{ARMS[0]}]\nfootprint = 0.7\n",
        f"name = 'own.toml'\nlever_arm = [{ARMS[1]}]\n")
SIGMA = ("", "attitude = [0.003, 0.003, 0.02]\n")
CHANNELS, USER_DATA = (0, 1), (7, 9)


def channel(number, mapping):
    sigma = f"[sensor.channel.sigma]\n{SIGMA[number]}" if SIGMA[number] else ""
    return f"[[sensor.channel]]\n{mapping}\n{KEYS[number]}{sigma}"


def write_las(path, head, records):
    """A file of the head of `head` and these records, whose counts and bounds it has."""
    data = bytearray(head.bytes[:head.offset_to_points])
    coordinates = records[:, :12].copy().view("<i4")
    least = coordinates.min(axis=0) * head.scale + head.offset
    greatest = coordinates.max(axis=0) * head.scale + head.offset
    struct.pack_into("<6d", data, 179, *np.stack([greatest, least], axis=1).ravel())
    struct.pack_into("<I", data, 107, len(records) if head.point_format < 6 else 0)
    struct.pack_into("<5I", data, 111, *(0,) * 5)
    if head.version_minor >= 4:
        struct.pack_into("<Q", data, 247, len(records))
        struct.pack_into("<15Q", data, 255, *(0,) * 15)
    path.write_bytes(bytes(data) + records.tobytes())
    return path


class Scanners:
    """Two simulated flights of one aircraft at one time, whose points are interleaved by time in one file."""

    def __init__(self, folder, *flags):
        flights = [SimulatedSurvey(folder / scanner, "--scanner", scanner, "--seconds", 6, "--pulse-rate", rate,
                                   "--lever-arm", arm, *flags)
                   for scanner, rate, arm in (("palmer", 2500, ARMS[0]), ("raster", 2100, ARMS[1]))]
        assert flights[0].sbet.read_bytes() == flights[1].sbet.read_bytes()
        self.sbet, self.level = flights[0].sbet, flights[0].water_level
        files = [LasFile(flight.las) for flight in flights]
        self.head = files[0]
        assert files[0].scale == files[1].scale and files[0].record_length == files[1].record_length
        modern = self.head.point_format >= 6
        parts = []
        for number, las in enumerate(files):
            records = las.records.copy()
            shift = np.rint((np.array(las.offset) - files[0].offset) / las.scale).astype("<i4")
            records[:, :12] = (records[:, :12].copy().view("<i4") + shift).astype("<i4").view(np.uint8)
            records[:, 17] = USER_DATA[number]
            if modern:
                records[:, 15] = records[:, 15] & 0xCF | CHANNELS[number] << 4
            parts.append(records)
        together = np.concatenate(parts)
        time = 22 if modern else 20
        times = together[:, time:time + 8].copy().view("<f8")[:, 0]
        together = together[np.argsort(times, kind="stable")]
        # Two points of noise at the corners of all, so that each file has the same bounds.
        corners = together[:2].copy()
        coordinates = together[:, :12].copy().view("<i4")
        corners[:, :12] = np.stack([coordinates.min(axis=0), coordinates.max(axis=0)]).view(np.uint8)
        corners[:, 16 if modern else 15] = 7
        self.records = np.concatenate([together, corners])
        self.noise = np.arange(len(self.records)) >= len(together)
        self.all = write_las(folder / "all.las", self.head, self.records)
        self.alone = [write_las(folder / f"alone_{number}.las", self.head, self.records[self.of(number) | self.noise])
                      for number in (0, 1)]

    def of(self, number):
        return (self.records[:, 17] == USER_DATA[number]) & ~self.noise


class ChannelsTest(programs.Test):
    def setUp(self):
        super().setUp()
        self.write("own.toml", OWN)

    def annotate(self, source, name, survey, *flags, code=0):
        out = self.folder / name
        result = query("las", source, out, "--survey", self.toml(survey, f"{name}.toml"), "--table", self.table,
                       "--details", "--overwrite", *flags)
        self.assertEqual(result.returncode, code, result.stderr)
        return (LasFile(out), json.loads((self.folder / f"{name}.json").read_text())) if code == 0 else result

    def compare(self, scanners, mappings):
        common = f"[trajectory]\nfiles = ['{scanners.sbet}']\n[surface]\nlevel = {scanners.level}\n" + DECIDED + WIND
        together, summary = self.annotate(
            scanners.all, "together.las", common + "".join(channel(i, mappings[i]) for i in (0, 1)))
        extra = together.records[:, scanners.head.record_length:]
        counts = []
        for number in (0, 1):
            keys = KEYS[number].replace("footprint = 0.7\n", "")
            sigma = f"[sigma]\n{SIGMA[number]}" if SIGMA[number] else ""
            flags = ("--footprint", 0.7) if number == 0 else ()
            alone, alone_summary = self.annotate(scanners.alone[number], f"alone_{number}_out.las",
                                                 common + f"[sensor]\n{keys}{sigma}", *flags)
            bits = alone.records[:-2, scanners.head.record_length:]
            np.testing.assert_array_equal(extra[scanners.of(number)], bits)
            counts.append((alone.columns()["total_thu"] >= 0).sum())
            self.assertGreater(counts[-1], 2000)
            of_channel = summary["answers"]["channels"][number]
            self.assertEqual(of_channel["total"]["all"], alone_summary["answers"]["total"]["all"])
            numbers = summary["parameters"]["channels"][number]["total"]["numbers"]
            self.assertEqual(numbers, alone_summary["parameters"]["total"]["numbers"])
        self.assertEqual((together.columns()["total_thu"] >= 0).sum(), sum(counts))
        self.assertNotIn("total", summary["parameters"])
        return together, summary

    def test_have_the_numbers_of_files_of_their_own_bit_for_bit(self):
        scanners = Scanners(self.folder)
        together, summary = self.compare(scanners, ("scanner_channels = [0]", "scanner_channels = [1]"))
        # The scanners differ in all that is theirs.
        columns = together.columns()
        first, second = (scanners.of(i) & (columns["total_thu"] >= 0) for i in (0, 1))
        self.assertGreater(columns["incidence"][first].min(), columns["incidence"][second].min() + 5)
        self.assertEqual(set(columns["footprint"][first]), {np.float32(0.7)})
        self.assertGreater(columns["footprint"][second].min(), 1)
        self.assertEqual([each["name"] for each in summary["answers"]["channels"]],
                         ["scanner channel 0", "scanner channel 1"])
        assumed = summary["answers"]["total"]["assumed"]
        self.assertEqual(sum("boresight" in line for line in assumed), 1)
        self.assertTrue(any(line.startswith("scanner channel 0: attitude") for line in assumed), assumed)

    def test_are_told_apart_by_user_data_in_old_point_formats(self):
        scanners = Scanners(self.folder, "--las-version", 2, "--point-format", 3)
        self.compare(scanners, [f"user_data = [{number}]" for number in USER_DATA])
        survey = (f"[trajectory]\nfiles = ['{scanners.sbet}']\n[surface]\nlevel = {scanners.level}\n" + DECIDED + WIND +
                  channel(0, "scanner_channels = [0]"))
        result = self.annotate(scanners.all, "no_channel.las", survey, code=1)
        self.assert_fails(result, 1, "points of format 3 have no scanner channel", "user_data")
        self.assertFalse((self.folder / "no_channel.las").exists())

    def test_of_no_channel_have_no_number_and_are_counted(self):
        scanners = Scanners(self.folder)
        survey = (f"[trajectory]\nfiles = ['{scanners.sbet}']\n[surface]\nlevel = {scanners.level}\n" + DECIDED + WIND +
                  channel(0, "scanner_channels = [0]\nuser_data = [7]"))
        las, summary = self.annotate(scanners.all, "out.las", survey)
        none = scanners.of(1)
        numbers = las.columns()
        self.assertTrue((numbers["total_thu"][none] == -1).all())
        bathymetric = int((none & np.isin(las.classes, (40, 43))).sum())
        self.assertGreater(bathymetric, 1000)
        self.assertEqual(summary["answers"]["outcomes"]["NO_CHANNEL"], bathymetric)
        dry = none & ~np.isin(las.classes, (7, 18, 40, 43, 44, 45, 46))  # Neither noise nor under water.
        self.assertEqual(summary["answers"]["dry"]["no_channel"], int(dry.sum()))
        self.assertGreater(dry.sum(), 1000)
        # A report counts them with their reason.
        query("report", self.folder / "out.las", "--output", self.folder / "report", "--no-page", check=0)
        report = json.loads((self.folder / "report" / "report.json").read_text())
        self.assertEqual(report["wanted"]["without_number"]["NO_CHANNEL"], bathymetric)
        self.assertIn("scan, scanner channel 0 with user data 7", [each["name"] for each in report["numbers"]])

    def test_of_cones_have_the_incidence_of_their_channel(self):
        flight = LasFile(programs.make_flight(self.folder / "line.las"))
        records = flight.records.copy()
        records[:, 17] = np.arange(len(records)) % 2
        source = write_las(self.folder / "cones.las", flight, records)
        common = "[surface]\nlevel = 0\n" + DECIDED + WIND
        flags = ("--altitude", 400, "--beam-azimuth", 90)
        survey = common + "".join(
            f"[[sensor.channel]]\nuser_data = [{i}]\nname = 'riegl-vq-880-g'\nincidence = {angle}\n"
            for i, angle in enumerate((15, 20)))
        together, _ = self.annotate(source, "together.las", survey, *flags)
        extra = together.records[:, flight.record_length:]
        for i, angle in enumerate((15, 20)):
            alone, _ = self.annotate(source, "alone.las", common + "[sensor]\nname = 'riegl-vq-880-g'\n", *flags,
                                     "--incidence", angle)
            np.testing.assert_array_equal(extra[i::2], alone.records[i::2, flight.record_length:])
        self.assertGreater((together.columns()["total_thu"] >= 0).sum(), 100)

    def test_are_refused_where_the_survey_is_wrong(self):
        flight = programs.make_flight(self.folder / "line.las")
        first, second = channel(0, "scanner_channels = [0]"), channel(1, "scanner_channels = [1]")
        level = "[surface]\nlevel = 0\n" + DECIDED + WIND
        for text, part, code in (
                (first + second.replace("[1]", "[0, 1]"), "maps points of scanner channel 0, 1, and another one", 1),
                (first + channel(1, "user_data = [3]"), "maps points of user data 3, and another one", 1),
                (first.replace("scanner_channels = [0]\n", ""), "maps no points", 1),
                (first.replace("name = 'riegl-vq-880-g'\n", ""), "name is missing", 1),
                ("[sensor]\nname = 'riegl-vq-880-g'\n" + first, "'sensor.name' contradicts [[sensor.channel]]", 1),
                (first.replace("[0]", "[4]"), "'sensor.channel.scanner_channels' has 4", 1),
                (first + "[sensor.channel.sigma]\nindex = 0.1\n", "'sensor.channel.sigma.index' is no key", 1),
                (first.replace("footprint = 0.7", "footprint = 0.7\ndivergence = 1"), "is given beside divergence", 1),
                (first.replace("880", "88"), "did you mean riegl-vq-880-g?", 1)):
            with self.subTest(part):
                result = self.annotate(flight, "out.las", level + text, "--incidence", 20, "--altitude", 400,
                                       "--beam-azimuth", 90, code=code)
                self.assert_fails(result, code, part)
                self.assertFalse((self.folder / "out.las").exists())
        # Pulses of a CSV file have no channel; one sensor may be named in their place, as for a file of one of them.
        pulses = self.folder / "pulses.csv"
        pulses.write_text("incidence,beam_azimuth,depth,altitude,footprint\n20,90,10,400,0.5\n")
        arguments = ("csv", pulses, self.folder / "out.csv", "--survey", self.toml(level + first + second), "--table",
                     self.table)
        self.assert_fails(query(*arguments), 2, "names several sensors", "--sensor")
        query(*arguments, "--sensor", "riegl-vq-880-g", check=0)


if __name__ == "__main__":
    programs.main()
