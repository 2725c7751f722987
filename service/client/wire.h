// Writes queries and seas as messages, and reads descriptions of tables and seas from messages. answer_reader.h reads
// answers.
#pragma once

#include "albtpu/v1/sea.pb.h"
#include "albtpu/v1/uncertainty_service.pb.h"
#include "albtpu/v1/water.pb.h"
#include "budget/query/budget_query.h"
#include "budget/water/known_water.h"
#include "service/client/uncertainty_source.h"
#include "service/column_message.h"
#include "service/seas/known_sea.h"
#include "service/seas/sea_summary.h"

namespace albtpu::client {

// Sets the options and quantities of a request: those that fill the columns of `requested` that are not null.
void ToWire(const Query& query, const AnswerColumns& requested, albtpu::v1::QueryColumnsRequest& request);

// Adds the field `pulses` of a QueryColumnsRequest. The longest column of a message determines its number of pulses, so
// if every column has one number for all pulses, the depth is written once for each pulse.
void AddPulses(const PulseColumns& pulses, ColumnMessage& request);

// Whether a column of this quantity is not null.
bool Wants(const BudgetAnswers& wanted, BudgetQuantity quantity);

// The same for the whole budget: options and quantities, and the fields `pulses` and `aircraft`.
void ToWire(const BudgetOptions& options, const BudgetPulses& pulses, const BudgetAnswers& wanted,
            albtpu::v1::QueryBudgetRequest& request);
void AddPulses(const BudgetPulses& pulses, ColumnMessage& request);

TableSummary FromWire(const albtpu::v1::Table& table);

// Seas and waters as messages, and their summaries from a server.

// Every number of the sea, bit for bit. The server checks the limits of sea.proto.
albtpu::v1::SeaState ToWire(const KnownSea& sea);

// Every number of the water, bit for bit. The server checks the limits of water.proto.
albtpu::v1::WaterState ToWire(const KnownWater& water);

SeaSummary FromWire(const albtpu::v1::SeaSummary& sea);
WaterSummary FromWire(const albtpu::v1::WaterSummary& water);

}  // namespace albtpu::client
