// SPDX-License-Identifier: MIT
#include "mpi/messages.hpp"

#include <mpi.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace polhode {
inline namespace v0 {
namespace ensemble {
namespace detail {
namespace {

constexpr std::size_t longest_piece = std::size_t{1} << 30;  // MPI counts in ints
enum Tag { tag_of_heads = 1, tag_of_bytes };

struct Head {
  Subject subject;
  std::int64_t index;
  Cell::Fate fate;
  std::int64_t size;  // of the bytes that follow
};

template <class Use>
void each_piece(std::size_t size, const Use& use) {
  for (std::size_t begin = 0; begin < size; begin += longest_piece)
    use(begin, static_cast<int>(std::min(longest_piece, size - begin)));
}

}  // namespace

void send(int to, const Message& message) {
  const std::string& bytes = message.cell.bytes;
  const Head head{message.subject, message.cell.index, message.cell.fate,
                  static_cast<std::int64_t>(bytes.size())};
  MPI_Send(&head, sizeof head, MPI_BYTE, to, tag_of_heads, MPI_COMM_WORLD);
  each_piece(bytes.size(), [&](std::size_t begin, int size) {
    MPI_Send(bytes.data() + begin, size, MPI_BYTE, to, tag_of_bytes, MPI_COMM_WORLD);
  });
}

// All heads have one tag: MPI keeps the order of messages that match the same call.
std::optional<Message> received() {
  int arrived = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, tag_of_heads, MPI_COMM_WORLD, &arrived, &status);
  if (arrived == 0) return std::nullopt;
  const int from = status.MPI_SOURCE;
  Head head{};
  MPI_Recv(&head, sizeof head, MPI_BYTE, from, tag_of_heads, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  std::string bytes(static_cast<std::size_t>(head.size), '\0');
  each_piece(bytes.size(), [&](std::size_t begin, int size) {
    MPI_Recv(bytes.data() + begin, size, MPI_BYTE, from, tag_of_bytes, MPI_COMM_WORLD,
             MPI_STATUS_IGNORE);
  });
  return Message{from, head.subject, {head.index, head.fate, std::move(bytes)}};
}

void broadcast(std::string& bytes) {
  auto size = static_cast<std::int64_t>(bytes.size());
  MPI_Bcast(&size, 1, MPI_INT64_T, 0, MPI_COMM_WORLD);
  bytes.resize(static_cast<std::size_t>(size));
  each_piece(bytes.size(), [&](std::size_t begin, int part) {
    MPI_Bcast(bytes.data() + begin, part, MPI_BYTE, 0, MPI_COMM_WORLD);
  });
}

}  // namespace detail
}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
