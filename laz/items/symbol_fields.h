// The fields of points of formats 6 to 10 that are coded as symbols: classes, flags and user data.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "laz/items/field_layers.h"

namespace albtpu::laz {

// A number that is coded as a symbol, by a model for the last one. `Place` accesses it, and `Circumstance` chooses one
// of 64 models.
template <typename Coder, typename Place, int kSymbols, typename Circumstance>
class SymbolField : public Place {
  using Models = std::array<typename Coder::template Model<kSymbols>, 64>;

 public:
  using typename Place::Number;

  void Start(std::size_t /*channel*/, Number first) {
    channels_.ForgetAll([](Models& models) {
      for (auto& model : models) model.Forget();
    });
    last_.fill(first);
  }

  class Pass {
   public:
    Pass(SymbolField& field, const ChannelRun& run)
        : models_(field.channels_[run.models].data()), number_(field.last_[run.from]) {}
    [[gnu::always_inline]] Number Code(Coder& coder, const PointContexts& contexts, std::size_t i, Number known) {
      return number_ = static_cast<Number>(coder.Symbol(models_[Circumstance()(number_, contexts.place[i])], known));
    }
    void End(SymbolField& field, const ChannelRun& run) const { field.last_[run.to] = number_; }

   private:
    typename Models::value_type* models_;
    Number number_;
  };

 private:
  ChannelHistories<Models> channels_;
  std::array<Number, kChannels> last_{};
};

// The flags, which lie in one byte with the scanner channel.
struct FlagsPlace {
  using Number = std::uint8_t;

  static Number Load(const char* record) {
    return static_cast<Number>(PointFlags(static_cast<std::uint8_t>(record[kFlagsOffset])));
  }
  static void Store(Number flags, std::size_t channel, char* record) {
    record[kFlagsOffset] = static_cast<char>(FlagsByte(flags, static_cast<std::uint32_t>(channel)));
  }
};

// By the last class, and whether the return is the only one of its pulse.
struct ClassCircumstance {
  std::size_t operator()(std::uint8_t last, std::uint8_t place) const { return (last & 31u) << 1 | (place == 3); }
};
struct FlagsCircumstance {
  std::size_t operator()(std::uint8_t last, std::uint8_t /*place*/) const { return last; }
};
struct UserDataCircumstance {
  std::size_t operator()(std::uint8_t last, std::uint8_t /*place*/) const { return last / 4u; }
};

template <typename Coder>
using ClassField = SymbolField<Coder, PlainField<std::uint8_t, kClassOffset>, 256, ClassCircumstance>;
template <typename Coder>
using FlagsField = SymbolField<Coder, FlagsPlace, 64, FlagsCircumstance>;
template <typename Coder>
using UserDataField = SymbolField<Coder, PlainField<std::uint8_t, kUserDataOffset>, 256, UserDataCircumstance>;

}  // namespace albtpu::laz
