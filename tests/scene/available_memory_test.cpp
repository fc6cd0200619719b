// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/available_memory.h"

#include <gtest/gtest.h>

namespace hooke {
namespace {

TEST(AvailableMemory, IsSomethingOnLinux) {
  EXPECT_GT(scene::available_memory(), std::uint64_t{1} << 20U);
  EXPECT_LT(scene::available_memory(), std::uint64_t{1} << 50U);
}

TEST(AvailableMemory, IsSaidInHandyUnits) {
  EXPECT_EQ(scene::in_bytes(260), "260 bytes");
  EXPECT_EQ(scene::in_bytes(1536), "1.5 KiB");
  EXPECT_EQ(scene::in_bytes(3.0 * 1024 * 1024 * 1024), "3.0 GiB");
}

}  // namespace
}  // namespace hooke
