"""Calls every method of the package albtpu on the path, and prints the answers as JSON.

Usage: python_calls.py HOST:PORT
"""

import json
import sys

import albtpu

PULSES = dict(incidence=[5, 10, 20, 30], footprint=0.5, depth=[1, 5, 10, 10])
FLIGHT = dict(altitude=400, beam_azimuth=[0, 90, 180, 270], located="pulse", datum=0.08, lever_arm=(0.3, -0.2, 0.5))
ERRORS = dict(position=(0.03, 0.03, 0.05), attitude=(0.0025, 0.0025, 0.005), scan=0.001, bottom_range=0.025)
SEA = albtpu.Sea.jonswap(hs=0.6, tp=3.2, waves_from=230).with_wind(5, from_=225).with_depth(12)


def numbers(answer):
    kinds = {"": answer.values, " standard error": getattr(answer, "standard_errors", {})}
    return {"outcome": list(map(str, answer.outcome)), "coverage": answer.coverage,
            **{name + kind: values.tolist() for kind, columns in kinds.items() for name, values in columns.items()}}


def main():
    with albtpu.connect(sys.argv[1]) as service:
        table = service.table("winds")
        answers = {
            "tables": [[each.reference.name, each.reference.digest, each.title] for each in service.tables()],
            "table": [table.campaign, {name: list(map(float, axis.nodes)) for name, axis in table.axes.items()},
                      {name: [each.units, each.long_name] for name, each in table.quantities.items()}],
            "query": numbers(service.query(**PULSES, wind_speed=5, fetch=6000, azimuth=45, coverage="p95",
                                           table="winds", standard_errors=True, best_s44_order=True, s44_order="1b")),
            "of a sea": numbers(service.query(**PULSES, azimuth=45, sea=SEA)),
            "in process": numbers(SEA.compile(service).query(**PULSES, azimuth=45)),
            "budget": numbers(service.query_budget(
                **PULSES, **FLIGHT, wind_speed=5, aircraft=dict(roll=[1, 2, 3, 4]), errors=ERRORS, table="winds",
                sea_axis=250, quantities=albtpu.BUDGET_QUANTITIES))}
    json.dump(answers, sys.stdout, indent=1)


if __name__ == "__main__":
    main()
