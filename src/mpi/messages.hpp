// SPDX-License-Identifier: MIT
// Messages between the leader and the other ranks.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace polhode {
inline namespace v0 {
namespace ensemble {
namespace detail {

// A cell of a stage, and what has become of it.
struct Cell {
  enum class Fate : std::int64_t { done, failed, dropped };
  std::int64_t index = 0;
  Fate fate = Fate::dropped;
  std::string bytes = {};  // of the result, or why there is none
};

enum class Subject : std::int64_t {
  stage,   // the leader's: its bytes follow by broadcast()
  cell,    // compute this one
  drop,    // none of those that are left is needed
  end,     // there is nothing more
  answer,  // what has become of a cell
};

struct Message {
  int rank = 0;  // where it comes from
  Subject subject = Subject::end;
  Cell cell = {};
};

// Bytes of any length, in pieces that MPI can count.
void send(int to, const Message& message);
// The next one that has arrived, none where there is none yet. Those of one rank come in the order
// in which it sent them, whatever their subject: a cell never before the stage that it belongs to.
std::optional<Message> received();
// The bytes of rank 0, in all ranks.
void broadcast(std::string& bytes);

}  // namespace detail
}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
