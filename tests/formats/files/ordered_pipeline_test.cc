#include "formats/files/ordered_pipeline.h"

#include <gtest/gtest.h>

namespace albtpu::formats {
namespace {

struct Number {
  int value = 0;
};

// The numbers written by a pipeline that doubles 0, 1 .. count - 1.
struct Outcome {
  absl::Status status;
  std::vector<int> written;
};

Outcome Double(int count, int bad_read, int bad_work, int bad_write) {
  Outcome outcome;
  int next = 0;
  outcome.status = RunOrderedPipeline([] { return Number(); },
                                      [&](Number& number) -> absl::StatusOr<bool> {
                                        if (next == bad_read) return absl::DataLossError("read");
                                        number.value = next++;
                                        return number.value < count;
                                      },
                                      [&](Number& number) {
                                        if (number.value == bad_work) return absl::UnavailableError("work");
                                        number.value *= 2;
                                        return absl::OkStatus();
                                      },
                                      [&](Number& number) {
                                        if (number.value == 2 * bad_write) return absl::ResourceExhaustedError("write");
                                        outcome.written.push_back(number.value);
                                        return absl::OkStatus();
                                      });
  return outcome;
}

std::vector<int> EvenNumbers(int count) {
  std::vector<int> numbers(count);
  for (int i = 0; i < count; ++i) numbers[i] = 2 * i;
  return numbers;
}

TEST(OrderedPipeline, WritesInTheOrderOfReading) {
  for (const int count : {0, 1, 2, 10000}) {
    const Outcome outcome = Double(count, -1, -1, -1);
    EXPECT_TRUE(outcome.status.ok());
    EXPECT_EQ(outcome.written, EvenNumbers(count));
  }
}

TEST(OrderedPipeline, ReturnsTheFirstFailureInTheFile) {
  EXPECT_EQ(Double(100, 50, -1, -1).status, absl::DataLossError("read"));
  EXPECT_EQ(Double(100, 51, 50, -1).status, absl::UnavailableError("work"));
  EXPECT_EQ(Double(100, -1, 51, 50).status, absl::ResourceExhaustedError("write"));
  for (int i = 0; i < 100; ++i) EXPECT_EQ(Double(20, 11, 10, 12).written, EvenNumbers(10));
}

TEST(OrderedPipeline, KeepsOnlyAFewChunksInMemory) {
  std::atomic<int> read = 0, written = 0, most = 0;
  const absl::Status status =
      RunOrderedPipeline([] { return Number(); }, [&](Number&) -> absl::StatusOr<bool> { return ++read <= 1000; },
                         [&](Number&) {
                           most = std::max(most.load(), read.load() - written.load());
                           return absl::OkStatus();
                         },
                         [&](Number&) {
                           ++written;
                           return absl::OkStatus();
                         });
  EXPECT_TRUE(status.ok());
  EXPECT_EQ(written, 1000);
  EXPECT_LE(most, kMaxWorkers + 3);
}

}  // namespace
}  // namespace albtpu::formats
