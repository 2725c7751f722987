// What is asked, as messages; and tables, from messages. Answers: answer_reader.h.
#pragma once

#include "albtpu/v1/uncertainty_service.pb.h"
#include "service/client/uncertainty_source.h"
#include "service/column_message.h"

namespace albtpu::client {

// What the columns of the answers that are not null ask for.
void ToWire(const Query& query, const AnswerColumns& wanted, albtpu::v1::QueryColumnsRequest& request);

// Adds the field `pulses` of a QueryColumnsRequest. A message tells the number of its pulses by its longest
// column: where all columns are one number for all, the depth is written for each.
void AddPulses(const PulseColumns& pulses, ColumnMessage& request);

TableSummary FromWire(const albtpu::v1::Table& table);

}  // namespace albtpu::client
