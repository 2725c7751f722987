"""What is refused before anything is sent or read, with a message that says what is expected.

Usage: refusals_test.py TABLE.h5
"""

import sys
import unittest

import numpy as np

import albtpu
from albtpu import Sea, Water, geometry

TABLE = albtpu.open_table(sys.argv[1])
SERVICE = albtpu.connect("localhost:1", patience=0)  # Nothing is there.
CLOSED = albtpu.connect("localhost:1")
CLOSED.close()

PULSE = dict(wind_speed=5, incidence=10, azimuth=30, footprint=0.5, depth=8)
FLOWN = dict(**PULSE, altitude=400, beam_azimuth=90, located="local")
POINT = dict(east=1, north=2, height=400, depth=3)
CALM = Sea.calm()
F = [0.1, 0.2]
ASKED = dict(sea=CALM, footprint=0.5)


def columns(call, given):
    """What no column may be, refused by the function `call` with the other arguments `given`."""
    return [(call, {**given, "depth": depth}, message) for depth, message in (
        ("8", "depth is of type <U1: it should be numbers"), (None, "depth is of type object"),
        ([[1, 2], [3]], "depth is not an array"), (np.array([True]), "depth is of type bool"),
        ([1j], "depth is of type complex128"))]


def misspelt(wrong, right):
    return (TABLE.query, {wrong if name == right else name: value for name, value in PULSE.items()},
            f"'{wrong}' .did you mean '{right}'")


ARGUMENTS = {
    "the columns of all calls": [
        *columns(TABLE.query, PULSE), *columns(SERVICE.query, PULSE), *columns(SERVICE.query_budget, FLOWN),
        *columns(geometry.beams, POINT),
        (TABLE.query, PULSE | dict(depth="8"), "it should be numbers, in m$"),
        (TABLE.query, PULSE | dict(depth=[1, 2], incidence=[1, 2, 3]), r"incidence \(3,\), depth \(2,\)"),
        (SERVICE.query_budget, FLOWN | dict(depth=[1, 2], altitude=[1, 2, 3]), r"depth \(2,\), altitude \(3,\)"),
        (geometry.beams, POINT | dict(north=[1, 2], depth=[1, 2, 3]), "the shapes do not broadcast: north"),
        (geometry.footprint, dict(slant_range=F, divergence_mrad=[1, 2, 3]), "the shapes do not broadcast: slant_"),
        (geometry.azimuth_from_downwind, dict(beam_azimuth=F, wind_from=[1, 2, 3]), "the shapes do not broadcast"),
        (geometry.azimuth_on_sea, dict(beam_azimuth=F, x_azimuth=[1, 2, 3]), "the shapes do not broadcast")],
    "names that nothing has": [
        (TABLE.query, PULSE | dict(windspeed=5),
         r"no argument 'windspeed' \(did you mean 'wind_speed'\?\); its arguments are wind_"),
        (TABLE.query, PULSE | dict(zzz=5), "no argument 'zzz'; its arguments are wind_speed, incidence, footprint"),
        misspelt("windspeed", "wind_speed"), misspelt("incident", "incidence"), misspelt("footprnt", "footprint"),
        misspelt("Depth", "depth"),
        (SERVICE.query_budget, FLOWN | dict(altitud=5), "did you mean 'altitude'"),
        (SERVICE.query_budget, FLOWN | dict(located="here"), "located is 'here'"),
        (SERVICE.query_budget, FLOWN | dict(errors=dict(scann=1)), "errors is 'scann'.*did you mean 'scan'"),
        (SERVICE.query_budget, FLOWN | dict(aircraft=dict(rol=1)), "aircraft is 'rol'.*did you mean 'roll'"),
        *((SERVICE.query_budget, FLOWN | dict(aircraft={name: 100}), f"{name} and aircraft.'{name}'. are both given")
          for name in ("altitude", "beam_azimuth")),
        (CALM.with_tail, dict(tail="relaxed"), "did you mean 'relax'")],
    "options": [
        (TABLE.query, PULSE | dict(coverage="95"), r"is '95' \(did you mean 'p95'\?\): it should be '2sigma' or 'p95'"),
        (TABLE.query, PULSE | dict(coverage=["p95"]), r"coverage is \['p95'\]"),
        (TABLE.query, PULSE | dict(s44_order="1c"), "s44_order is '1c'.*: it should be 'exclusive' or"),
        (TABLE.query, PULSE | dict(table=5), "table is 5: it should be a name"),
        (TABLE.query, PULSE | dict(table="other"), "only the table 'synthetic': omit table='other'"),
        (TABLE.query, PULSE | dict(quantities="tuv"), r"did you mean 'tvu'\?\): it should be 'refraction_along_wind'"),
        (TABLE.query, PULSE | dict(quantities=5), "quantities is 5: it should be names"),
        (TABLE.query, PULSE | dict(quantities=[["thu"]]), "it should be names"),
        (TABLE.query, PULSE | dict(quantities=[]), "name at least one"),
        (SERVICE.query_budget, FLOWN | dict(quantities=("thu",)), "quantities is 'thu'"),
        (SERVICE.query_budget, FLOWN | dict(quantities=()), "name at least one")],
    "pulses": [
        (SERVICE.query_budget, FLOWN | dict(depth=[]), "there are no pulses: give at least one"),
        (SERVICE.query, PULSE | dict(wind_speed=None), "wind_speed is missing")],
    "numbers": [
        (SERVICE.query_budget, FLOWN | dict(errors=dict(position=1)), "three numbers: north, east, down"),
        (SERVICE.query_budget, FLOWN | dict(datum="x"), "datum is 'x': it should be a number"),
        (SERVICE.query_budget, FLOWN | dict(extra_vertical="x"), "extra_vertical is 'x': it should be a number"),
        *((call, given | dict(refractive_index=index), f"refractive_index is {index}: it should be 1 to 2")
          for call, given in ((TABLE.query, PULSE), (SERVICE.query, PULSE), (SERVICE.query_budget, FLOWN),
                              (SERVICE.sea_table, dict(sea=CALM)), (SERVICE.compile, dict(sea=CALM)))
          for index in (2.1, -1.34, np.nan)),
        (geometry.beams, POINT | dict(index=0.75), "index is 0.75"),
        (geometry.beams, POINT | dict(index=np.nan), "index is nan"),
        (geometry.beams, POINT | dict(index="water"), "index is 'water'"),
        (geometry.beams, POINT | dict(convergence=200), "convergence is beyond 180 degrees")],
    "seas": [
        (Sea.jonswap, dict(hs="high", tp=3, waves_from=0), "hs is 'high'"),
        (Sea.spectrum, dict(frequencies=F, energy=F, r2=F), "r2 and alpha2 belong together"),
        (Sea.spectrum, dict(frequencies=F, energy=F, r2=[0.1], alpha2=[3]), "have 2, 1 and 1 numbers"),
        (Sea.spectrum, dict(frequencies=[F], energy=F), "frequencies has the shape"),
        *((Sea.spectrum, dict(frequencies=F, energy=F, r2=[0.5, r2], alpha2=F), f"r2 has {r2}: it should be 0 to 1")
          for r2 in (-0.2, 1.1)),
        (Sea.spectrum(F, F).__add__, dict(other=CALM), "only seas given by heights"),
        (SERVICE.correlation, ASKED | dict(dx=(1, 0), dt=[]), "dt has 0 numbers"),
        (SERVICE.correlation, ASKED | dict(dx="far"), "dx is of type <U3: it should be numbers"),
        (SERVICE.correlation, ASKED | dict(dx=(1, 0), orientation=3), "orientation has no effect with dx"),
        (SERVICE.correlation, ASKED | dict(cell=[1], dt=5), "dt has no effect with cell"),
        (SERVICE.query, PULSE | dict(sea="calm"), "it should be an albtpu.Sea"),
        (SERVICE.query, PULSE | dict(sea=CALM, table="synthetic"), "omit one of them"),
        (TABLE.query, PULSE | dict(sea=CALM), "sea.compile")],
    "waters": [
        (Water, dict(detector="halve"), r"detector is 'halve' \(did you mean 'half'\?\)"),
        (Water, dict(kd=0.1, kd_kind="diffuse"), "kd_kind is 'diffuse'.*did you mean 'diffuse532'"),
        (Water, dict(jerlov="1c"), "jerlov is '1c'"),
        (Water, dict(secchi="deep"), "secchi is 'deep': it should be a number"),
        (Water, dict(calibration=5), "three numbers: depth, offset, sigma"),
        *((Water, dict(without_column=True) | given, "has no effect with without_column") for given in (
            dict(bias="none"), dict(residual_fraction=0.1), dict(calibration=(5, 0, 0)), dict(photons=100))),
        (SERVICE.query_budget, FLOWN | dict(water="murky"), "it should be an albtpu.Water"),
        (SERVICE.query_budget, FLOWN | dict(water=Water(secchi=5), aircraft=dict(water_noise=0.01)),
         r"water and aircraft\['water_noise'\] are both given")],
    "servers": [
        *((albtpu.connect, dict(target=target), "it should be HOST:PORT")
          for target in ("", "localhost", "two words:1", None, 50051)),
        *((albtpu.connect, dict(target=target), "its port should be at most 65535")
          for target in ("localhost:65536", "dns:///localhost:108614", "[::1]:99999")),
        *((albtpu.connect, dict(target="localhost:1", **files), message) for files, message in (
            (dict(ca="nowhere.pem"), "'ca', .*nowhere.pem: No such file"),
            (dict(ca=sys.argv[1]), "should be a PEM file"),
            (dict(cert="me.pem"), "give both 'cert' and 'key'"), (dict(key="me.key"), "give both 'cert' and 'key'"))),
        (CLOSED.tables, {}, "is closed: connect again"), (CLOSED.table, {}, "is closed: connect again"),
        (CLOSED.query, PULSE, "is closed: connect again")],
}


class Arguments(unittest.TestCase):
    def test_are_refused_with_a_message_that_says_what_is_expected(self):
        for what, cases in ARGUMENTS.items():
            for call, arguments, message in cases:
                with self.subTest(what, message=message), self.assertRaisesRegex(albtpu.ArgumentError, message):
                    call(**arguments)

    def test_that_are_missing_raise_as_in_python(self):
        with self.assertRaisesRegex(TypeError, "missing 1 required keyword-only argument: 'depth'"):
            TABLE.query(wind_speed=5, incidence=10, footprint=0.5)

    def test_raise_what_is_also_a_value_error(self):
        self.assertTrue(issubclass(albtpu.ArgumentError, (albtpu.Error, ValueError)))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
