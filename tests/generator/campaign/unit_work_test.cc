#include "generator/campaign/unit_work.h"

#include <gmock/gmock.h>

#include <deque>
#include <map>
#include <mutex>
#include <thread>

#include "generator/campaign/table_maker.h"
#include "tests/generator/campaign/two_seas.h"
#include "tests/temporary_folder.h"

namespace albtpu {
namespace {

// The messages between ranks that are threads of this process.
class Post {
 public:
  void Put(int to, Ranks::Message message) {
    const std::lock_guard lock(mutex_);
    boxes_[to].push_back(std::move(message));
  }
  std::optional<Ranks::Message> Take(int rank) {
    const std::lock_guard lock(mutex_);
    std::deque<Ranks::Message>& box = boxes_[rank];
    if (box.empty()) return std::nullopt;
    Ranks::Message message = std::move(box.front());
    box.pop_front();
    return message;
  }

 private:
  std::mutex mutex_;
  std::map<int, std::deque<Ranks::Message>> boxes_;
};

class ThreadRank final : public Ranks {
 public:
  ThreadRank(Post& post, int rank, int size) : post_(post), rank_(rank), size_(size) {}
  int rank() const override { return rank_; }
  int size() const override { return size_; }
  void Send(int to, int tag, const std::string& bytes) override { post_.Put(to, {rank_, tag, bytes}); }
  std::optional<Message> Poll() override { return post_.Take(rank_); }
  [[noreturn]] void EndAll() override { std::abort(); }

 private:
  Post& post_;
  int rank_, size_;
};

using Units = std::map<UnitId, std::string>;

// The units of TwoSeas(), computed on `size` ranks.
Units ComputedOn(int size) {
  Post post;
  std::vector<std::thread> others;
  for (int rank = 1; rank < size; ++rank) {
    others.emplace_back([&post, rank, size] {
      ThreadRank ranks(post, rank, size);
      EXPECT_TRUE(FollowRankZero(ranks).ok());
    });
  }
  ThreadRank ranks(post, 0, size);
  Units units;
  const absl::Status status = ComputeUnits(TwoSeas(), UnitsOf(TwoSeas()), ranks,
                                           [&](UnitId unit, const std::string& bytes, const std::string&) {
                                             EXPECT_TRUE(units.emplace(unit, bytes).second) << Name(unit);
                                             return absl::OkStatus();
                                           });
  EXPECT_TRUE(status.ok()) << status;
  Dismiss(ranks);
  for (std::thread& other : others) other.join();
  return units;
}

TEST(UnitWork, ComputesEachUnitOnceAndTheSameOnAnyNumberOfRanks) {
  const Units alone = ComputedOn(1);
  EXPECT_EQ(alone.size(), UnitsOf(TwoSeas()).size());
  EXPECT_EQ(ComputedOn(3), alone);
}

TEST(UnitWork, EndsAtTheFirstFailureOfTheSink) {
  int calls = 0;
  const absl::Status status =
      ComputeUnits(TwoSeas(), UnitsOf(TwoSeas()), *OneRank(), [&](UnitId, const std::string&, const std::string&) {
        ++calls;
        return absl::ResourceExhaustedError("full");
      });
  EXPECT_EQ(status.message(), "full");
  EXPECT_EQ(calls, 1);
}

TEST(UnitWork, SucceedsWithoutUnits) {
  const auto never = [](UnitId, const std::string&, const std::string&) { return absl::InternalError("called"); };
  EXPECT_TRUE(ComputeUnits(TwoSeas(), {}, *OneRank(), never).ok());
}

namespace fs = std::filesystem;
using ::albtpu::testing::TemporaryFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr UnitId kThird = {UnitKind::kSeaCase, 2}, kSixth = {UnitKind::kSeaCase, 5};

WorkFolder Open(const fs::path& folder) {
  const absl::StatusOr<WorkFolder> work = WorkFolder::Open(folder, TwoSeas());
  return *work;
}

TEST(WorkFolder, IsCreatedWithItsCampaign) {
  const TemporaryFolder folder;
  Open(folder / "work");
  const absl::StatusOr<WorkFolder> again = WorkFolder::OpenExisting(folder / "work");
  const absl::StatusOr<Campaign> campaign = again->ReadCampaign();
  EXPECT_EQ(campaign->text, TwoSeas().text);
}

TEST(WorkFolder, HoldsOneCampaign) {
  const TemporaryFolder folder;
  Open(folder.path());
  Open(folder.path());
  Campaign other = TwoSeas();
  other.text += "# changed\n";
  const absl::Status status = WorkFolder::Open(folder.path(), other).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_THAT(std::string(status.message()), HasSubstr("campaign.toml: is another campaign"));
}

TEST(WorkFolder, CannotBeAFile) {
  const TemporaryFolder folder;
  folder.Write("file", "precious");
  const absl::Status status = WorkFolder::Open(folder / "file", TwoSeas()).status();
  EXPECT_THAT(std::string(status.message()), HasSubstr("file'"));
}

TEST(WorkFolder, MustExistToBeOpenedAsExisting) {
  const TemporaryFolder folder;
  EXPECT_EQ(WorkFolder::OpenExisting(folder.path()).status().code(), absl::StatusCode::kNotFound);
  EXPECT_EQ(WorkFolder::OpenExisting(folder / "absent").status().code(), absl::StatusCode::kNotFound);
}

TEST(WorkFolder, FindsAndReadsFinishedUnits) {
  const TemporaryFolder folder;
  const WorkFolder work = Open(folder.path());
  EXPECT_THAT(work.Finished(UnitsOf(TwoSeas())).value(), ElementsAre());
  ASSERT_TRUE(work.Store(kSixth, "six").ok());
  ASSERT_TRUE(work.Store(kThird, "three").ok());
  EXPECT_THAT(work.Finished(UnitsOf(TwoSeas())).value(), ElementsAre(kThird, kSixth));
  EXPECT_THAT(work.Finished({kSixth}).value(), ElementsAre(kSixth));
  std::vector<std::string> read;
  const absl::Status status = work.Read({kThird, kSixth}, [&](UnitId, const std::string& bytes) {
    read.push_back(bytes);
    return absl::OkStatus();
  });
  EXPECT_TRUE(status.ok()) << status;
  EXPECT_THAT(read, ElementsAre("three", "six"));
}

TEST(WorkFolder, NamesTheFileThatTheSinkRefuses) {
  const TemporaryFolder folder;
  const WorkFolder work = Open(folder.path());
  ASSERT_TRUE(work.Store(kThird, "three").ok());
  const absl::Status status =
      work.Read({kThird}, [](UnitId, const std::string&) { return absl::DataLossError("is damaged"); });
  EXPECT_EQ(status.code(), absl::StatusCode::kDataLoss);
  EXPECT_EQ(status.message(), work.PathOf(kThird).string() + ": is damaged");
}

TEST(WorkFolder, DoesNotOverwriteAUnit) {
  const TemporaryFolder folder;
  const WorkFolder work = Open(folder.path());
  ASSERT_TRUE(work.Store(kThird, "three").ok());
  EXPECT_TRUE(work.Store(kThird, "three").ok()) << "two processes may compute the same unit";
  EXPECT_EQ(work.Store(kThird, "another three").code(), absl::StatusCode::kAlreadyExists);
  EXPECT_EQ(testing::ReadFile(work.PathOf(kThird)), "three");
}

TEST(WorkFolder, RemovesTemporaryFilesOfKilledWritersAndNothingElse) {
  const TemporaryFolder folder;
  const WorkFolder work = Open(folder.path());
  ASSERT_TRUE(work.Store(kThird, "three").ok());
  folder.Write(".albtpu-4711-3.tmp", "half a");
  folder.Write("notes.txt", "precious");
  ASSERT_TRUE(work.RemoveTemporaries().ok());
  EXPECT_FALSE(fs::exists(folder / ".albtpu-4711-3.tmp"));
  EXPECT_TRUE(fs::exists(folder / "notes.txt"));
  EXPECT_TRUE(fs::exists(work.PathOf(kThird)));
}

}  // namespace
}  // namespace albtpu
