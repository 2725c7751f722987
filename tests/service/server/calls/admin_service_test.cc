#include <gmock/gmock.h>

#include <fstream>

#include "service/server/calls/health_service.h"
#include "tests/service/server/served_tables.h"

namespace albtpu::server {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class Admin : public ServedTables {
 protected:
  grpc::Status Reload(v1::ReloadTablesResponse& response) {
    const auto stub = v1::AdminService::NewStub(channel_);
    grpc::ClientContext context;
    context.set_wait_for_ready(true);
    context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(60));
    return stub->ReloadTables(&context, {}, &response);
  }
};

TEST_F(Admin, ReloadsTablesAndReportsEachChange) {
  WriteOrDie(testing::SyntheticTable({.factor = 5}), folder_ / "another.h5");
  std::filesystem::remove(folder_ / "published.h5");
  v1::ReloadTablesResponse response;
  ASSERT_TRUE(Reload(response).ok());
  std::vector<std::pair<std::string, int>> tables;
  for (const v1::ReloadedTable& table : response.tables()) tables.emplace_back(table.name(), table.change());
  EXPECT_EQ(tables, (std::vector<std::pair<std::string, int>>{{"another", v1::TABLE_CHANGE_LOADED},
                                                              {"survey", v1::TABLE_CHANGE_KEPT},
                                                              {"twice/2", v1::TABLE_CHANGE_KEPT},
                                                              {"twice/1", v1::TABLE_CHANGE_KEPT},
                                                              {"published", v1::TABLE_CHANGE_REMOVED}}));
  v1::GetTableResponse table;
  EXPECT_TRUE(GetTable("another", table).ok());
  EXPECT_EQ(GetTable("published", table).error_code(), grpc::StatusCode::NOT_FOUND);
}

TEST_F(Admin, NamesADamagedTableButNotItsFolder) {
  std::ofstream(folder_ / "survey.h5") << "not a table";
  v1::ReloadTablesResponse response;
  const grpc::Status status = Reload(response);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::FAILED_PRECONDITION);
  EXPECT_THAT(status.error_message(), AllOf(HasSubstr("survey.h5"), Not(HasSubstr(folder_.path().string()))));
  v1::GetTableResponse table;
  ASSERT_TRUE(GetTable("survey", table).ok());
  EXPECT_EQ(table.table().reference().digest(), survey_.digest());
}

TEST(AdminCallers, AreLocalByTheirAddress) {
  for (const char* peer :
       {"ipv4:127.0.0.1:4242", "ipv4:127.0.0.2:1", "ipv6:%5B::1%5D:4242", "ipv6:[::1]:4242", "unix:/run/albtpu"})
    EXPECT_TRUE(IsLocalPeer(peer)) << peer;
  for (const char* peer :
       {"", "ipv4:192.0.2.1:127", "ipv4:12.7.0.1:1", "ipv6:%5B2001:db8::1%5D:1", "ipv6:%5B::1:2%5D:1", "unknown"})
    EXPECT_FALSE(IsLocalPeer(peer)) << peer;
}

}  // namespace
}  // namespace albtpu::server
