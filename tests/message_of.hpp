// SPDX-License-Identifier: MIT
// Rejected input and its message.
#pragma once

#include <gmock/gmock.h>

#include <span>
#include <string>

#include "polhode/error.hpp"

namespace polhode::test {

// The message of the Error that f throws; empty if it throws none.
template <class Error = DomainError, class F>
std::string message_of(const F& f) {
  try {
    f();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

// A rejected input and what its message has in it, or begins with where that is a place in f.toml.
struct Rejected {
  std::string input, message;
};

void expect_rejected(const auto& error_of, std::span<const Rejected> rows) {
  for (const auto& [input, message] : rows) {
    SCOPED_TRACE(input);
    if (message.starts_with("f.toml:")) {
      EXPECT_THAT(error_of(input), testing::StartsWith(message));
    } else {
      EXPECT_THAT(error_of(input), testing::HasSubstr(message));
    }
  }
}

}  // namespace polhode::test

// The expression throws a DomainError with this message, or with this text in its message.
#define EXPECT_MESSAGE(expression, message) \
  EXPECT_EQ(::polhode::test::message_of([&] { static_cast<void>(expression); }), message)
#define EXPECT_REJECTED(expression, text)                                          \
  EXPECT_THAT(::polhode::test::message_of([&] { static_cast<void>(expression); }), \
              ::testing::HasSubstr(text))
