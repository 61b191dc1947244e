// SPDX-License-Identifier: MIT
#include "mpi/messages.hpp"

#include <mpi.h>

#include <algorithm>
#include <cstddef>

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr std::size_t longest_piece = std::size_t{1} << 30;  // MPI counts in ints
constexpr int tag_of_bytes = 100;                            // subjects are tags below it

struct Head {
  std::int64_t index;
  std::int64_t size;
};

template <class Use>
void each_piece(std::size_t size, const Use& use) {
  for (std::size_t begin = 0; begin < size; begin += longest_piece)
    use(begin, static_cast<int>(std::min(longest_piece, size - begin)));
}

}  // namespace

void send(int to, const Message& message) {
  const Head head{message.index, static_cast<std::int64_t>(message.bytes.size())};
  MPI_Send(&head, sizeof head, MPI_BYTE, to, static_cast<int>(message.subject), MPI_COMM_WORLD);
  each_piece(message.bytes.size(), [&](std::size_t begin, int size) {
    MPI_Send(message.bytes.data() + begin, size, MPI_BYTE, to, tag_of_bytes, MPI_COMM_WORLD);
  });
}

// Of any subject: those of one rank come in the order in which it sent them, so that a cell is
// never seen before the stage that it belongs to. What comes first is a head: the bytes that follow
// it are received with it.
std::optional<Message> received() {
  int arrived = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &arrived, &status);
  if (arrived == 0) return std::nullopt;
  Head head{};
  MPI_Recv(&head, sizeof head, MPI_BYTE, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD,
           MPI_STATUS_IGNORE);
  Message message{status.MPI_SOURCE, Subject{status.MPI_TAG}, head.index,
                  std::string(static_cast<std::size_t>(head.size), '\0')};
  each_piece(message.bytes.size(), [&](std::size_t begin, int size) {
    MPI_Recv(message.bytes.data() + begin, size, MPI_BYTE, message.rank, tag_of_bytes,
             MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  });
  return message;
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
}  // namespace v0
}  // namespace polhode
