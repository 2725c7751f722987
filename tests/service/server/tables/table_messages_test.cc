#include <gmock/gmock.h>

#include "tests/service/server/served_tables.h"

namespace albtpu::server {
namespace {

using ::testing::ElementsAre;
using ::testing::ElementsAreArray;
using ::testing::HasSubstr;

using TablesOfServer = ServedTables;

TEST_F(TablesOfServer, AreListedByNameAndNewestVersionFirst) {
  v1::ListTablesResponse response;
  ASSERT_TRUE(ListTables(response).ok());
  std::vector<std::string> names, versions;
  for (const v1::TableSummary& table : response.tables()) {
    names.push_back(table.reference().name());
    versions.push_back(table.reference().version());
    EXPECT_EQ(table.reference().id(), "synthetic");
    EXPECT_EQ(table.reference().digest().size(), 64u);
    EXPECT_EQ(table.title(), survey_.provenance().title);
  }
  EXPECT_THAT(names, ElementsAre("published", "survey", "twice/2", "twice/1"));
  EXPECT_THAT(versions, ElementsAre("1", "1", "second", "first"));
  EXPECT_EQ(response.default_table(), "survey");
}

TEST_F(TablesOfServer, AreDescribedWithAxesAndQuantities) {
  v1::GetTableResponse response;
  ASSERT_TRUE(GetTable("survey", response).ok());
  const v1::Table& table = response.table();
  EXPECT_EQ(table.reference().name(), "survey");
  EXPECT_EQ(table.reference().digest(), survey_.digest());
  EXPECT_EQ(table.title(), survey_.provenance().title);
  EXPECT_EQ(table.campaign(), survey_.provenance().campaign);
  ASSERT_EQ(table.axes_size(), 6);
  for (AxisId id : kAxes) {
    const v1::TableAxis& axis = table.axes(static_cast<int>(Index(id)));
    EXPECT_EQ(axis.axis(), static_cast<int>(Index(id)) + 1);
    EXPECT_EQ(axis.name(), Describe(id).name);
    EXPECT_EQ(axis.units(), Describe(id).units);
    EXPECT_EQ(axis.long_name(), Describe(id).long_name);
    EXPECT_EQ(axis.scale() == v1::SCALE_LOG, survey_.axis(id).scale() == Scale::kLog);
    EXPECT_THAT(axis.nodes(), ElementsAreArray(survey_.axis(id).nodes()));
  }
  ASSERT_EQ(table.quantities_size(), 6);
  for (Quantity id : kQuantities) {
    const v1::TableQuantity& quantity = table.quantities(static_cast<int>(Index(id)));
    EXPECT_EQ(quantity.quantity(), static_cast<int>(Index(id)) + 1);
    EXPECT_EQ(quantity.name(), Describe(id).name);
    EXPECT_EQ(quantity.units(), Describe(id).units);
    EXPECT_EQ(quantity.scale(), v1::SCALE_LINEAR);
    EXPECT_TRUE(quantity.has_standard_error());
  }
}

TEST_F(TablesOfServer, IncludeTheirProvenance) {
  v1::GetTableResponse response;
  ASSERT_TRUE(GetTable("", response).ok());
  const auto& attributes = response.table().attributes();
  EXPECT_EQ(attributes.size(), survey_.provenance().attributes.size());
  EXPECT_EQ(attributes.at("source").text(), "a smooth formula");
  EXPECT_EQ(attributes.at("realizations").integer(), 500);
  EXPECT_EQ(attributes.at("refractive_index").number(), 1.34);
  EXPECT_THAT(attributes.at("interpolation_error").numbers().values(), ElementsAre(0.01, 0.02, 0.03));
}

TEST_F(TablesOfServer, ListOnlyTheQuantitiesThatTheyHold) {
  v1::GetTableResponse response;
  ASSERT_TRUE(GetTable("published", response).ok());
  ASSERT_EQ(response.table().quantities_size(), 4);
  EXPECT_FALSE(response.table().quantities(0).has_standard_error());
  EXPECT_EQ(response.table().campaign(), "");
}

TEST_F(TablesOfServer, AreNotFoundByAnotherName) {
  v1::GetTableResponse response;
  const grpc::Status status = GetTable("twice/3", response);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_THAT(status.error_message(), HasSubstr("twice/2, twice/1"));
}

}  // namespace
}  // namespace albtpu::server
