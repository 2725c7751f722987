#include "service/server/calls/describe_sea.h"

#include <string>

#include "service/server/ground/errors.h"
#include "service/server/tables/table_messages.h"
#include "tables/file/table_encoding.h"

namespace albtpu::server {

absl::Status DescribeSea(AnswerSources& sources, const v1::CompileSeaRequest& request,
                         v1::CompileSeaResponse& response) {
  if (!request.has_sea())
    return FieldViolation("sea", "sea is missing (its table is what is asked for); send a SeaState");
  const absl::StatusOr<const ServedTable*> table = sources.Find(request.sea());
  if (!table.ok()) return table.status();
  *response.mutable_table() = WriteTableMessage(**table);
  if (!request.with_file()) return absl::OkStatus();
  absl::StatusOr<std::string> file = EncodeTable((*table)->table);
  if (!file.ok()) return file.status();
  response.set_file(*std::move(file));
  return absl::OkStatus();
}

}  // namespace albtpu::server
