// Runs every test of a fixture on each instruction set that this machine supports and the kernels were compiled for.
#pragma once

#include <gtest/gtest.h>
#include <hwy/highway.h>
#include <hwy/targets.h>

#include <cstdint>
#include <string>

namespace albtpu::testing {

class OnInstructionSet : public ::testing::TestWithParam<std::int64_t> {
 protected:
  OnInstructionSet() { Choose(GetParam()); }
  ~OnInstructionSet() override { Choose(0); }

  // Takes effect immediately; 0 selects the default.
  static void Choose(std::int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
};

#define ALBTPU_ON_EACH_INSTRUCTION_SET(fixture)                                                   \
  INSTANTIATE_TEST_SUITE_P(On, fixture, ::testing::ValuesIn(hwy::SupportedAndGeneratedTargets()), \
                           [](const auto& target) { return std::string(hwy::TargetName(target.param)); })

}  // namespace albtpu::testing
