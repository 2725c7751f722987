"""A service in Python that answers from a table file, and that a test can make misbehave."""

from concurrent import futures

import grpc
import numpy as np

import albtpu
from albtpu.schema import COVERAGES, S44_ORDERS
from albtpu.v1 import uncertainty_service_pb2 as pb
from albtpu.v1 import uncertainty_service_pb2_grpc


class FakeService(uncertainty_service_pb2_grpc.UncertaintyServiceServicer):
    """Calls `before_answer(service, request, context)` for each batch, and keeps all batches in `requests`."""

    def __init__(self, path, before_answer=None):
        self.source = albtpu.open_table(path)
        self.digest = self.source.table().reference.digest
        self.before_answer = before_answer or (lambda *_: None)
        self.requests = []

    def StreamColumns(self, requests, context):
        for request in requests:
            self.requests.append(request.query)
            self.before_answer(self, request.query, context)
            yield pb.StreamColumnsResponse(answer=self.answer(request.query))

    def ListTables(self, request, context):
        self.before_answer(self, request, context)
        only = dict(reference=self.reference(), title="Fake")
        return pb.ListTablesResponse(tables=[only], default_table="fake")

    def GetTable(self, request, context):
        table = self.source.table()
        axes = [dict(name=name, nodes=axis.nodes, units=axis.units) for name, axis in table.axes.items()]
        return pb.GetTableResponse(table=dict(reference=self.reference(), title="Fake", axes=axes))

    def reference(self):
        mine = self.source.table().reference
        return dict(name="fake", id=mine.id, version=mine.version, digest=self.digest)

    def answer(self, query):
        pulses = {axis.name: np.frombuffer(column, "<f4") for axis, column in query.pulses.ListFields()}
        quantities = [list(albtpu.QUANTITIES)[number - 1] for number in query.quantities]
        options = query.options
        answer = self.source.query(
            **pulses, coverage=list(COVERAGES)[max(options.coverage, 1) - 1], quantities=quantities or None,
            standard_errors=options.standard_errors, s44_order=S44_ORDERS[options.s44_order] or None,
            best_s44_order=options.best_s44_order)
        message = pb.QueryColumnsResponse(
            table=self.reference(), coverage=options.coverage or 1, pulse_count=answer.outcomes.size,
            outcomes=answer.outcomes.tobytes(), outcome_axes=answer.outcome_axes.tobytes())
        for name, values in answer.values.items():
            setattr(message.sea_surface, name, values.tobytes())
        for name, values in answer.standard_errors.items():
            setattr(message.sea_surface_standard_error, name, values.tobytes())
        if answer.best_s44_orders is not None:
            message.s44.best_orders = answer.best_s44_orders.tobytes()
        if answer.remaining_thu is not None:
            message.s44.remaining_thu = answer.remaining_thu.tobytes()
            message.s44.remaining_tvu = answer.remaining_tvu.tobytes()
        return message


class Running:
    """Runs `service` on a free port of the loopback."""

    def __init__(self, service):
        self.server = grpc.server(futures.ThreadPoolExecutor(4), options=[("grpc.so_reuseport", 0)])
        uncertainty_service_pb2_grpc.add_UncertaintyServiceServicer_to_server(service, self.server)
        self.address = f"127.0.0.1:{self.server.add_insecure_port('127.0.0.1:0')}"
        self.server.start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.stop()

    def stop(self):
        self.server.stop(grace=None).wait()
