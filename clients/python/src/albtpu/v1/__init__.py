"""The wire, as protoc and grpc_python_plugin make it of proto/albtpu/v1; `uncertainty_service.proto` explains it."""
