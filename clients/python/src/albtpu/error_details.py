"""The details that a server adds to an error: which fields of the request are wrong."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import grpc
from google.protobuf import descriptor_pb2, descriptor_pool, message_factory
from google.protobuf.message import DecodeError

_KEY = "grpc-status-details-bin"
_BAD_REQUEST = "type.googleapis.com/google.rpc.BadRequest"
# The parts of google/rpc/*.proto and google/protobuf/any.proto that are read here: field names in the order of
# their numbers. They are in a descriptor pool of their own: a program may have loaded Google's own files, and a
# pool accepts only one definition of a name.
_MESSAGES = {"Any": ("type_url", "*value"), "FieldViolation": ("field", "description"),
             "Status": (None, "message", "Any"), "BadRequest": ("FieldViolation",)}


def field_violations(error: grpc.RpcError) -> str:
    """`; FIELD: DESCRIPTION` for each wrong field that the text of `error` does not mention yet."""
    text = error.details() or ""
    return "".join(f"; {field}: {what}" for field, what in _violations(error) if what not in text)


def _violations(error: grpc.RpcError) -> Iterator[tuple[str, str]]:
    for key, value in error.trailing_metadata() or ():
        if key != _KEY:
            continue
        try:
            for detail in _CLASSES["Status"].FromString(value).Any:
                if detail.type_url == _BAD_REQUEST:
                    for violation in _CLASSES["BadRequest"].FromString(detail.value).FieldViolation:
                        yield violation.field, violation.description
        except DecodeError:  # Ignored: the text of the error stands alone.
            return


def _make_messages() -> dict[str, Any]:
    file = descriptor_pb2.FileDescriptorProto(name="error_details", package="albtpu.details", syntax="proto3")
    kinds = descriptor_pb2.FieldDescriptorProto
    for name, fields in _MESSAGES.items():
        message = file.message_type.add(name=name)
        for number, field in enumerate(fields, 1):
            if field in _MESSAGES:
                message.field.add(name=field, number=number, label=kinds.LABEL_REPEATED,
                                  type=kinds.TYPE_MESSAGE, type_name=f".albtpu.details.{field}")
            elif field:
                kind = kinds.TYPE_BYTES if field.startswith("*") else kinds.TYPE_STRING
                message.field.add(name=field.lstrip("*"), number=number, label=kinds.LABEL_OPTIONAL,
                                  type=kind)
    pool = descriptor_pool.DescriptorPool()
    pool.Add(file)
    make = getattr(message_factory, "GetMessageClass", None)
    if make is None:  # Protobuf before 4.22.
        make = message_factory.MessageFactory(pool).GetPrototype
    return {name: make(pool.FindMessageTypeByName(f"albtpu.details.{name}")) for name in _MESSAGES}


_CLASSES = _make_messages()
