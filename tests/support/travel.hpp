#pragma once
// Values as bytes and back.

#include <gtest/gtest.h>

#include <string>

#include "libbase/structs/travel.hpp"

namespace whirl::test {

template <class T>
T there_and_back(const T& value) {
  const std::string bytes = packed(value);
  Unpacked from(bytes);
  T back{};
  from(back);
  EXPECT_TRUE(from.is_at_end());
  EXPECT_EQ(packed(back), bytes);
  return back;
}

}  // namespace whirl::test
