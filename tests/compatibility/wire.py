"""Messages of the wire as a version wrote them: recorded between a client and a server, and answered again."""

from concurrent import futures

import grpc

from albtpu.v1 import admin_service_pb2, uncertainty_service_pb2

SERVICES = {service.full_name: service for module in (admin_service_pb2, uncertainty_service_pb2)
            for service in module.DESCRIPTOR.services_by_name.values()}


def method_of(path):
    """The descriptor of /PACKAGE.SERVICE/METHOD."""
    _, service, name = path.split("/")
    return SERVICES[service].methods_by_name[name]


def parse(kind, data):
    return kind._concrete_class.FromString(data)


def ask_for_index(request, index):
    """Sets the refractive index of a request that has a place for it; returns whether it has."""
    message = request.query if hasattr(request, "query") else request
    message = message if message.DESCRIPTOR.name == "CompileSeaRequest" else getattr(message, "options", None)
    if message is None:
        return False
    message.refractive_index = index
    return True


def _without_index(request):
    """As a server that does not know the index of requests reads it."""
    if (request.DESCRIPTOR.name != "QueryBudgetRequest") and ask_for_index(request, 0):
        message = request.query if hasattr(request, "query") else request
        message = message if message.DESCRIPTOR.name == "CompileSeaRequest" else message.options
        message.ClearField("refractive_index")
    return request


class Listener(grpc.GenericRpcHandler):
    """Answers every call with what `answer(path, request)` yields, in bytes."""

    def __init__(self, answer):
        self._answer = answer

    def service(self, details):
        def answer_all(requests, context):
            for request in requests:
                yield self._answer(details.method, request, context)
        return grpc.stream_stream_rpc_method_handler(answer_all)


class Between:
    """A server on a free port that passes each request on to another, and keeps the messages; or answers from `kept`.

    Every call of the service has one response for each request.
    """

    def __init__(self, address=None, kept=()):
        self.kept = list(kept)  # (path, request, response)
        self._channel = address and grpc.insecure_channel(address, options=[("grpc.enable_http_proxy", 0)])
        self._server = grpc.server(futures.ThreadPoolExecutor(8))
        self._server.add_generic_rpc_handlers([Listener(self._pass_on if address else self._answer)])
        self.address = f"127.0.0.1:{self._server.add_insecure_port('127.0.0.1:0')}"

    def _pass_on(self, path, request, _):
        (response,) = self._channel.stream_stream(path)(iter([request]))
        if not any(each[:2] == (path, request) for each in self.kept):
            self.kept.append((path, request, response))
        return response

    def _answer(self, path, request, context):
        asked = _without_index(parse(method_of(path).input_type, request))
        for kept_path, kept_request, response in self.kept:
            if path == kept_path and _without_index(parse(method_of(path).input_type, kept_request)) == asked:
                return response
        context.abort(grpc.StatusCode.UNIMPLEMENTED, f"{path} was not recorded with this request: {asked}")

    def __enter__(self):
        self._server.start()
        return self

    def __exit__(self, *_):
        self._server.stop(None).wait()
        if self._channel:
            self._channel.close()


def save(kept, folder):
    folder.mkdir()
    for i, (path, request, response) in enumerate(kept):
        name = f"{i:02}." + path.strip("/").replace("/", ".")
        (folder / f"{name}.request").write_bytes(request)
        (folder / f"{name}.response").write_bytes(response)


def load(folder):
    for request in sorted(folder.glob("*.request")):
        service, method = request.name.split(".", 1)[1].removesuffix(".request").rsplit(".", 1)
        yield f"/{service}/{method}", request.read_bytes(), request.with_suffix(".response").read_bytes()


def removed(old, new):
    """What a FileDescriptorSet has and a later one has not: files, messages, enumerations, fields, values, methods."""
    before, after = _names(old), _names(new)
    return sorted(f"{name}: {what}" + (f", now {after[name]}" if name in after else ", now gone")
                  for name, what in before.items() if after.get(name) != what)


def _names(files):
    found = {}

    def message(each, parent):
        name = f"{parent}.{each.name}"
        found[name] = "message"
        for field in each.field:
            oneof = each.oneof_decl[field.oneof_index].name if field.HasField("oneof_index") else ""
            found[f"{name}.{field.name}"] = f"{field.number} {field.type} {field.label} {field.type_name} {oneof}"
        for nested in each.nested_type:
            message(nested, name)
        for enum in each.enum_type:
            enumeration(enum, name)

    def enumeration(each, parent):
        for value in each.value:
            found[f"{parent}.{each.name}.{value.name}"] = str(value.number)

    for file in files.file:
        for each in file.message_type:
            message(each, file.package)
        for each in file.enum_type:
            enumeration(each, file.package)
        for service in file.service:
            for method in service.method:
                found[f"{file.package}.{service.name}.{method.name}"] = (
                    f"{method.input_type} {method.client_streaming} {method.output_type} {method.server_streaming}")
    return found
