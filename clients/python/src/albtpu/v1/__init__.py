"""The wire, as protoc and grpc_python_plugin make it of the .proto files in proto/albtpu/v1."""
