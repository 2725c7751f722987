#include "annotate/answers/json_box.h"

#include <nlohmann/json.hpp>
#include <utility>

namespace albtpu::annotate {

JsonBox::JsonBox() : JsonBox(nlohmann::ordered_json()) {}
JsonBox::JsonBox(nlohmann::ordered_json json) : json_(std::make_unique<nlohmann::ordered_json>(std::move(json))) {}
JsonBox::JsonBox(const JsonBox& other) : JsonBox(*other) {}
JsonBox::JsonBox(JsonBox&& other) noexcept = default;
JsonBox& JsonBox::operator=(JsonBox other) noexcept {
  json_ = std::move(other.json_);
  return *this;
}
JsonBox::~JsonBox() = default;

JsonBox JsonBox::Object() { return JsonBox(nlohmann::ordered_json::object()); }

}  // namespace albtpu::annotate
