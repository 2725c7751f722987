"""Connections by names and addresses, large queries in batches, and servers that fail during a query.

Usage: stream_test.py TABLE.h5
"""

import io
import pathlib
import sys
import threading
import unittest
from contextlib import redirect_stderr
from unittest import mock

import grpc
import numpy as np

import albtpu
from albtpu.query import Query
from albtpu.uncertainties import AnswerColumns
from albtpu.v1 import uncertainty_service_pb2 as pb
from fake_service import FakeService, Running

TABLE = sys.argv[1]
BATCH = 32768
PULSES = 3 * BATCH + 100
DEPTHS = np.linspace(0, 25, PULSES)  # The greatest depths are out of domain.
PULSE = dict(wind_speed=5, incidence=10, azimuth=30, footprint=0.5)
HOSTS = pathlib.Path("/etc/hosts")  # Missing in some minimal containers, where no name can be resolved.
LOCALHOST = HOSTS.is_file() and "localhost" in HOSTS.read_text().split()


class Stream(unittest.TestCase):
    def run_service(self, before_answer=None):
        service = FakeService(TABLE, before_answer)
        running = Running(service)
        self.addCleanup(running.stop)
        return service, running

    def connect(self, running, **options):
        client = albtpu.connect(running.address, **{"patience": 0.3, **options})
        self.addCleanup(client.close)
        return client

    def assert_right(self, answer, **options):
        with albtpu.open_table(TABLE) as table:
            expected = table.query(**PULSE, depth=DEPTHS, **options)
        for name, array in expected.to_dict().items():
            np.testing.assert_array_equal(answer.to_dict()[name], array, name)

    def test_connects_to_names_and_addresses(self):
        _, running = self.run_service()
        port = running.address.rpartition(":")[2]
        names = (f"localhost:{port}", f"dns:///localhost:{port}") if LOCALHOST else ()
        for target in (running.address, f"dns:///{running.address}", f"ipv4:{running.address}", *names):
            with albtpu.connect(target, patience=5) as client:
                self.assertEqual([table.reference.name for table in client.tables()], ["fake"], target)
                self.assertTrue(client.tables()[0].is_default)

    def test_takes_no_totals_without_the_water_from_a_server_of_an_earlier_version(self):
        class Earlier(FakeService):
            def QueryBudget(self, request, context):
                number = np.float32(0.1).tobytes()
                return pb.QueryBudgetResponse(table=self.reference(), coverage=1, pulse_count=1, outcomes=b"\1",
                                              outcome_axes=b"\0", budget=dict(total_thu=number, total_tvu=number))

        running = Running(Earlier(TABLE))
        self.addCleanup(running.stop)
        query = dict(**PULSE, depth=5, altitude=400, beam_azimuth=90, located="local")
        client = self.connect(running)
        self.assertEqual(client.query_budget(**query).total_thu, np.float32(0.1))
        with self.assertRaisesRegex(albtpu.ServiceError, "computes no water: .* of an earlier version"):
            client.query_budget(**query, water=albtpu.Water(secchi=5))

    def test_puts_the_answers_to_all_batches_into_their_places(self):
        service, running = self.run_service()
        options = dict(coverage="p95", standard_errors=True, s44_order="1b", best_s44_order=True)
        self.assert_right(self.connect(running).query(**PULSE, depth=DEPTHS, **options), **options)
        lengths = [len(request.pulses.depth) // 4 for request in service.requests]
        self.assertEqual(lengths, [BATCH] * 3 + [100])

    def test_sends_constants_once_and_requests_only_the_chosen_quantities(self):
        service, running = self.run_service()
        client = self.connect(running)
        wind = np.repeat([5.0, 6.0], BATCH)  # Constant in each batch.
        answer = client.query(wind_speed=wind, incidence=10, azimuth=30, footprint=0.5,
                              depth=np.linspace(0, 9, 2 * BATCH), quantities=["tvu", "thu"])
        alike = client.query(**PULSE, depth=np.full((3, 4), 5.0), quantities=["thu", "tvu"])
        for request, depths in zip(service.requests, (BATCH, BATCH, 1)):
            self.assertEqual(list(request.quantities), [3, 4])
            self.assertEqual(len(request.pulses.depth), 4 * depths)
            for axis in PULSE:
                self.assertEqual(len(getattr(request.pulses, axis)), 4, axis)
            self.assertEqual(request.pulses.fetch, b"")
        self.assertEqual(list(answer.values), ["thu", "tvu"])
        self.assertEqual((alike.thu.shape, len(np.unique(alike.thu))), ((3, 4), 1))

    def test_sends_at_most_eight_batches_ahead_of_the_answers(self):
        eighth_is_sent = threading.Event()
        leads, answered = [], []

        class Watched(Query):
            def batch(self, begin, end):
                leads.append(begin // BATCH - len(answered))
                if begin == 7 * BATCH:
                    eighth_is_sent.set()
                return super().batch(begin, end)

        _, running = self.run_service(lambda *_: eighth_is_sent.wait())
        pulses = {axis: np.float64([number]) for axis, number in PULSE.items()}
        query = Watched((12 * BATCH,), pulses, {**pulses, "depth": np.zeros(12 * BATCH)}, ("thu",), "2sigma",
                        False, None, False, None)
        client = self.connect(running)
        client._answer(query, AnswerColumns.for_query(query), answered.append)
        self.assertEqual(len(leads), 12)
        self.assertEqual(max(leads), 7)

    def test_continues_after_the_last_answer_of_a_failed_server(self):
        def abort_once(service, request, context):
            if len(service.requests) == 3:
                context.abort(grpc.StatusCode["UNAVAILABLE"], "restarting")

        service, running = self.run_service(abort_once)
        self.assert_right(self.connect(running).query(**PULSE, depth=DEPTHS))
        first = [np.frombuffer(request.pulses.depth, "<f4")[0] for request in service.requests]
        self.assertEqual(first[2], np.float32(DEPTHS[2 * BATCH]))
        self.assertEqual(first.count(first[0]), 1)  # Answered batches are not sent again.

    def test_gives_up_on_an_absent_server(self):
        _, running = self.run_service()
        running.stop()
        with self.assertRaisesRegex(albtpu.UnreachableError, f"{running.address}.*start albtpu-serve there"):
            self.connect(running).query(**PULSE, depth=DEPTHS)
        with self.assertRaises(ConnectionError):
            self.connect(running).tables()

    def test_gives_up_on_a_server_that_stops_answering(self):
        released = threading.Event()
        self.addCleanup(released.set)
        _, running = self.run_service(lambda service, *_: len(service.requests) == 2 and released.wait())
        with self.assertRaisesRegex(albtpu.UnreachableError, "no answer in 0.2 s"):
            self.connect(running, timeout=0.2).query(**PULSE, depth=DEPTHS)

    def test_reports_the_message_of_the_server(self):
        for code, kind in (("NOT_FOUND", albtpu.TableNotFoundError),
                           ("INVALID_ARGUMENT", albtpu.ServiceError),
                           ("FAILED_PRECONDITION", albtpu.TableNotFoundError),
                           ("RESOURCE_EXHAUSTED", albtpu.ServiceError)):
            _, running = self.run_service(lambda *call: call[-1].abort(grpc.StatusCode[code], "the reason"))
            with self.assertRaisesRegex(kind, "the reason") as failure:
                self.connect(running).query(**PULSE, depth=DEPTHS, table="nowhere")
            self.assertEqual(failure.exception.code, code)

    def test_refuses_an_answer_of_the_wrong_length(self):
        service, running = self.run_service()
        whole = service.answer

        def shortened(query):
            message = whole(query)
            message.sea_surface.tvu = message.sea_surface.tvu[:-4]
            return message

        service.answer = shortened
        with self.assertRaisesRegex(albtpu.ServiceError, "32768 pulses with a column of 131068 bytes"):
            self.connect(running).query(**PULSE, depth=DEPTHS)

    def test_refuses_a_stream_that_ends_early(self):
        service, running = self.run_service()
        service.StreamColumns = lambda requests, context: iter(())
        with Running(service) as running:
            with self.assertRaisesRegex(albtpu.ServiceError, "ended the stream after 0 of"):
                self.connect(running).query(**PULSE, depth=DEPTHS)

    def test_shows_progress_on_standard_error(self):
        _, running = self.run_service()
        shown = io.StringIO()
        with redirect_stderr(shown), mock.patch.dict(sys.modules, {"tqdm": None, "tqdm.auto": None}):
            self.connect(running).query(**PULSE, depth=DEPTHS, progress=True)
        self.assertIn(f"{PULSES} of {PULSES} pulses", shown.getvalue())

    def test_shows_a_bar_where_tqdm_is_installed(self):
        bar = mock.MagicMock()
        tqdm = mock.MagicMock(auto=mock.MagicMock(tqdm=mock.MagicMock(return_value=bar)))
        _, running = self.run_service()
        with mock.patch.dict(sys.modules, {"tqdm": tqdm, "tqdm.auto": tqdm.auto}):
            self.connect(running).query(**PULSE, depth=DEPTHS, progress=True)
        updates = [call.args[0] for call in bar.__enter__.return_value.update.call_args_list]
        self.assertEqual(updates, [BATCH] * 3 + [100])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
