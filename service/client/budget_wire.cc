#include "service/client/budget_wire.h"

#include <grpcpp/support/proto_buffer_reader.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "absl/strings/str_cat.h"
#include "service/client/column_exchange.h"
#include "service/client/wire.h"

namespace albtpu::client {
namespace {

namespace v1 = albtpu::v1;

// Bytes of columns in a message, which may have 4 MiB (uncertainty_service.proto). The rest is for everything else,
// most of it a sea.
constexpr std::size_t kMostColumnBytes = (std::size_t{4} << 20) - (std::size_t{192} << 10);

v1::NorthEastDown NorthEastDown(const std::array<double, 3>& numbers) {
  v1::NorthEastDown message;
  message.set_north(numbers[0]);
  message.set_east(numbers[1]);
  message.set_down(numbers[2]);
  return message;
}

v1::RollPitchHeading RollPitchHeading(const std::array<double, 3>& numbers) {
  v1::RollPitchHeading message;
  message.set_roll(numbers[0]);
  message.set_pitch(numbers[1]);
  message.set_heading(numbers[2]);
  return message;
}

v1::ForwardRightDown ForwardRightDown(const std::array<double, 3>& numbers) {
  v1::ForwardRightDown message;
  message.set_forward(numbers[0]);
  message.set_right(numbers[1]);
  message.set_down(numbers[2]);
  return message;
}

v1::AirErrors ToWire(const AirErrors& errors) {
  v1::AirErrors message;
  *message.mutable_position() = NorthEastDown(errors.position);
  *message.mutable_attitude() = RollPitchHeading(errors.attitude);
  *message.mutable_boresight() = ForwardRightDown(errors.boresight);
  message.set_lever_arm(errors.lever_arm);
  message.set_scan(errors.scan);
  message.set_time(errors.time);
  message.set_range_offset(errors.range_offset);
  message.set_bottom_range(errors.bottom_range);
  message.set_surface_height(errors.surface_height);
  message.set_index(errors.index);
  return message;
}

bool Wants(const BudgetAnswers& wanted, BudgetQuantity quantity) {
  if (quantity == BudgetQuantity::kBestS44Order) return wanted.best_s44_orders != nullptr;
  const auto first = wanted.columns.begin() + static_cast<std::ptrdiff_t>(FirstColumn(quantity));
  return std::any_of(first, first + static_cast<std::ptrdiff_t>(ColumnCount(quantity)),
                     [](const float* column) { return column != nullptr; });
}

// The column of a quantity: field i + 1 is quantity i.
const std::string& ColumnOf(const v1::BudgetColumns& budget, BudgetQuantity quantity) {
  const int field = static_cast<int>(quantity) + 1;
  static const std::string* const kScratch = new std::string();
  return budget.GetReflection()->GetStringReference(
      budget, v1::BudgetColumns::descriptor()->FindFieldByNumber(field), const_cast<std::string*>(kScratch));
}

absl::Status WrongLength(std::string_view name, std::size_t bytes, std::size_t count) {
  return absl::InternalError(
      absl::StrCat("answered ", bytes, " bytes of ", std::string(name), " for ", count, " pulses"));
}

// Copies one byte for each pulse, of which none may be outside `least` to `most`.
absl::Status CopyBytes(std::string_view name, const std::string& bytes, std::size_t count, int least,
                       int most, std::uint8_t* destination) {
  if (destination == nullptr) return absl::OkStatus();
  if (bytes.size() != count) return WrongLength(name, bytes.size(), count);
  std::memcpy(destination, bytes.data(), count);
  const auto* const unknown = std::find_if_not(destination, destination + count, [=](std::uint8_t number) {
    return number >= least && number <= most;
  });
  if (unknown == destination + count) return absl::OkStatus();
  return absl::InternalError(absl::StrCat("answered ", *unknown, " among the ", std::string(name),
                                          ", a number that this program does not know"));
}

absl::Status CopyFloats(const v1::BudgetColumns& budget, BudgetQuantity quantity, std::size_t begin,
                        std::size_t count, const BudgetAnswers& answers) {
  const std::string& bytes = ColumnOf(budget, quantity);
  const std::size_t columns = ColumnCount(quantity), size = count * sizeof(float);
  if (bytes.size() != columns * size) return WrongLength("the budget", bytes.size(), count);
  for (std::size_t i = 0; i < columns; ++i) {
    float* const column = answers.columns[FirstColumn(quantity) + i];
    if (column != nullptr) std::memcpy(column + begin, bytes.data() + i * size, size);
  }
  return absl::OkStatus();
}

}  // namespace

void ToWire(const BudgetOptions& options, const BudgetPulses& pulses, const BudgetAnswers& wanted,
            v1::QueryBudgetRequest& request) {
  v1::BudgetOptions& message = *request.mutable_options();
  message.set_coverage(ToWire(options.coverage));
  *message.mutable_errors() = ToWire(options.errors);
  message.set_located(static_cast<v1::SurfaceLocation>(static_cast<int>(options.located) + 1));
  *message.mutable_lever_arm() = ForwardRightDown(options.lever_arm);
  message.set_refractive_index(options.index);
  message.set_datum(options.datum);
  if (pulses.sea_axis.has_value()) message.set_sea_axis(*pulses.sea_axis);
  for (std::size_t i = 0; i < kBudgetQuantityCount; ++i) {
    if (Wants(wanted, static_cast<BudgetQuantity>(i))) {
      request.add_quantities(static_cast<v1::BudgetQuantity>(i + 1));
    }
  }
}

void AddPulses(const BudgetPulses& pulses, ColumnMessage& request) {
  static_assert(int{v1::QueryBudgetRequest::kPulsesFieldNumber} ==
                int{v1::QueryColumnsRequest::kPulsesFieldNumber});
  AddPulses(pulses.pulses, request);
  const std::size_t mark = request.Mark();
  for (std::size_t i = 0; i < kAircraftInputs.size(); ++i) {
    const std::span<const float> column = pulses.aircraft[kAircraftInputs[i]];
    if (column.empty()) continue;
    std::memcpy(request.AddColumn(static_cast<int>(i) + 1, column.size_bytes()), column.data(),
                column.size_bytes());
  }
  request.Nest(v1::QueryBudgetRequest::kAircraftFieldNumber, mark);
}

std::size_t MostPulses(const BudgetPulses& pulses, const BudgetAnswers& wanted) {
  std::size_t asked = sizeof(float);  // The depth may be repeated.
  for (const std::span<const float> column : pulses.pulses.axis)
    asked += column.size() > 1 ? sizeof(float) : 0;
  for (const BudgetInput input : kAircraftInputs)
    asked += pulses.aircraft[input].size() > 1 ? sizeof(float) : 0;
  std::size_t answered = 3;  // Outcome, axis and order.
  for (std::size_t i = 0; i < kBudgetQuantityCount; ++i) {
    const auto quantity = static_cast<BudgetQuantity>(i);
    if (Wants(wanted, quantity)) answered += ColumnCount(quantity) * sizeof(float);
  }
  return std::min(kMostPulses, kMostColumnBytes / std::max(asked, answered));
}

absl::StatusOr<std::string> ReadBudget(grpc::ByteBuffer& bytes, const BudgetOptions& options,
                                       std::size_t begin, std::size_t count, const BudgetAnswers& answers) {
  v1::QueryBudgetResponse response;
  grpc::ProtoBufferReader reader(&bytes);
  if (!reader.status().ok() || !response.ParseFromZeroCopyStream(&reader))
    return absl::InternalError("answered bytes that are not a valid message");
  const v1::Coverage coverage = ToWire(options.coverage);
  if (response.coverage() != coverage) {
    return absl::InternalError(
        absl::StrCat("answered coverage ", response.coverage(), "; expected ", coverage));
  }
  const auto at = [begin](std::uint8_t* column) { return column == nullptr ? nullptr : column + begin; };
  absl::Status status =
      CopyBytes("outcomes", response.outcomes(), count, 1, v1::Outcome_MAX, at(answers.outcomes));
  status.Update(
      CopyBytes("outcome axes", response.outcome_axes(), count, 0, v1::Axis_MAX, at(answers.outcome_axes)));
  status.Update(CopyBytes("best orders", response.budget().best_s44_orders(), count, 0, v1::S44Order_MAX,
                          at(answers.best_s44_orders)));
  for (std::size_t i = 0; i < kBudgetQuantityCount; ++i) {
    const auto quantity = static_cast<BudgetQuantity>(i);
    if (quantity == BudgetQuantity::kBestS44Order || !Wants(answers, quantity)) continue;
    status.Update(CopyFloats(response.budget(), quantity, begin, count, answers));
  }
  if (!status.ok()) return status;
  return response.table().digest();
}

}  // namespace albtpu::client
