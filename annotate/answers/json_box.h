// A JSON value that a header can hold without the headers of the JSON library, which take long to compile.
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>

namespace albtpu::annotate {

class JsonBox {
 public:
  JsonBox();  // null
  explicit JsonBox(nlohmann::ordered_json json);
  JsonBox(const JsonBox& other);
  JsonBox(JsonBox&& other) noexcept;  // `other` may only be assigned to or destroyed.
  JsonBox& operator=(JsonBox other) noexcept;
  ~JsonBox();

  static JsonBox Object();  // {}

  nlohmann::ordered_json& operator*() { return *json_; }
  const nlohmann::ordered_json& operator*() const { return *json_; }
  nlohmann::ordered_json* operator->() { return json_.get(); }
  const nlohmann::ordered_json* operator->() const { return json_.get(); }

 private:
  std::unique_ptr<nlohmann::ordered_json> json_;
};

}  // namespace albtpu::annotate
