// SPDX-License-Identifier: MIT
// Messages between the leader and the other ranks.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace polhode {
inline namespace v0 {
namespace detail {

// What the leader says, and what the others answer.
enum class Subject : int { stage = 1, cell, drop, end, done, failed, dropped };

struct Message {
  int rank = 0;  // where it comes from
  Subject subject = Subject::end;
  std::int64_t index = 0;  // of a cell
  std::string bytes = {};
};

// Bytes of any length, in pieces that MPI can count.
void send(int to, const Message& message);
// The next one that has arrived; none: there is none yet.
std::optional<Message> received();
// The bytes of rank 0 in all ranks.
void broadcast(std::string& bytes);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
