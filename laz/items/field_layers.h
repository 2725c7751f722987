// Layers of one stream and one field each, which are coded in one loop.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <tuple>
#include <utility>

#include "laz/items/layers.h"
#include "laz/items/point14_fields.h"
#include "laz/items/point_contexts.h"
#include "laz/items/record_run.h"

namespace albtpu::laz {

// A number that a record holds directly.
template <typename T, std::size_t kOffset>
struct PlainField {
  using Number = T;

  static Number Load(const char* record) {
    Number number;
    std::memcpy(&number, record + kOffset, sizeof number);
    return number;
  }
  static void Store(Number number, std::size_t /*channel*/, char* record) {
    std::memcpy(record + kOffset, &number, sizeof number);
  }
};

// Codes fields point after point: a processor works on some streams at a time, which do not depend on each other. A
// field provides access to its number (Number, Load and Store, as in PlainField) and its prediction:
//   void Start(channel, first);               // After the first point of a chunk, which has the number `first`.
//   class Pass: what it needs for a run of points, which stays in registers:
//     Pass(field, run);
//     Number Code(coder, contexts, i, known);
//     void End(field, run);
template <typename Coder, typename... Fields>
class FieldLayers final : public Layers<Coder> {
 public:
  using typename Layers<Coder>::Streams;

  std::size_t streams() const override { return kCount; }

  void Begin(const char* first_point) override {
    const std::size_t channel = ScannerChannel(static_cast<std::uint8_t>(first_point[kFlagsOffset]));
    ForEach([&]<std::size_t f>() {
      std::get<f>(first_) = Field<f>::Load(first_point);
      std::get<f>(fields_).Start(channel, std::get<f>(first_));
    });
  }

  void Code(Streams streams, const RecordRun<Coder>& points, const PointContexts& contexts) override {
    CodeTogether(streams, points, contexts, Indices());
  }

  void FindChanges(Streams streams, const RecordRun<Coder>& points) const override {
    ForEach([&]<std::size_t f>() {
      const auto differs = [&](const char* point) { return Field<f>::Load(point) != std::get<f>(first_); };
      streams[f].present |= points.Any(differs);
    });
  }

 private:
  static constexpr std::size_t kCount = sizeof...(Fields);
  using Indices = std::index_sequence_for<Fields...>;
  template <std::size_t f>
  using Field = std::tuple_element_t<f, std::tuple<Fields...>>;

  template <typename Function>
  static void ForEach(const Function& function) {
    [&]<std::size_t... f>(std::index_sequence<f...>) { (function.template operator()<f>(), ...); }
    (Indices());
  }

  template <std::size_t... f>
  void CodeTogether(Streams streams, const RecordRun<Coder>& points, const PointContexts& contexts,
                    std::index_sequence<f...>) {
    std::tuple coders(std::move(streams[f].coder)...);
    const std::array<bool, kCount> present = {streams[f].present...};
    for (const ChannelRun& run : contexts.runs) {
      std::tuple passes(typename Fields::Pass(std::get<f>(fields_), run)...);
      for (std::size_t i = run.begin; i < run.end; ++i)
        (CodeField<f>(std::get<f>(coders), std::get<f>(passes), present[f], points, contexts, i, run.models), ...);
      (std::get<f>(passes).End(std::get<f>(fields_), run), ...);
    }
    ((streams[f].coder = std::move(std::get<f>(coders))), ...);
  }

  template <std::size_t f>
  [[gnu::always_inline]] void CodeField(Coder& coder, typename Field<f>::Pass& pass, bool present,
                                        const RecordRun<Coder>& points, const PointContexts& contexts, std::size_t i,
                                        std::size_t channel) const {
    typename Field<f>::Number number = std::get<f>(first_);
    if constexpr (Coder::kEncodes) number = Field<f>::Load(points[i]);
    if (present) number = pass.Code(coder, contexts, i, number);
    if constexpr (!Coder::kEncodes) Field<f>::Store(number, channel, points[i]);
  }

  std::tuple<Fields...> fields_;
  std::tuple<typename Fields::Number...> first_;
};

}  // namespace albtpu::laz
