// SPDX-License-Identifier: MIT
// A PartFile belongs to one writer until it has its name, and what keeps it from being written is
// distinguished: a path that cannot be, or a machine that cannot.
#include "output/part_file.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <filesystem>
#include <string>
#include <thread>

#include "polhode/error.hpp"
#include "polhode/output/sink.hpp"
#include "temp_folder.hpp"

namespace polhode {
namespace {

namespace fs = std::filesystem;
using detail::PartFile;

using PartFileTest = test::InTempFolder;

// Neither writer empties or renames what the other has: locks are of open files, so that threads
// stand for processes.
TEST_F(PartFileTest, OfTwoWritersEachLeavesAWholeFile) {
  constexpr int files = 60;
  const std::array<std::string, 2> texts = {std::string(3000, 'a'), std::string(3000, 'b')};
  const std::string name = path("x.csv");
  std::atomic<int> finished = 0, broken = 0;
  const auto write = [&](const std::string& own) {
    while (finished < files && broken == 0) {
      try {
        PartFile file(name);
        file.write(own);
        file.commit();
        ++finished;
        const std::string found = text(name);
        if (found != texts[0] && found != texts[1]) ++broken;
      } catch (const DomainError&) {  // the other has it
        std::this_thread::yield();
      } catch (const OutputError&) {
        ++broken;
      }
    }
  };
  std::thread other(write, texts[1]);
  write(texts[0]);
  other.join();
  EXPECT_EQ(broken, 0);
}

TEST_F(PartFileTest, AWrongPathIsNoFailureOfTheMachine) {
  EXPECT_THROW(PartFile(path("none/x.csv")), DomainError);
  fs::create_directory(path("x.csv.part"));
  EXPECT_THROW(PartFile(path("x.csv")), DomainError);
  EXPECT_THROW(detail::replace_file(path("x.csv"), "text"), OutputError);
  EXPECT_FALSE(fs::exists(path("x.csv")));
}

TEST_F(PartFileTest, NoMoreFilesIsAFailureOfTheMachine) {
  // thrown once while there are files: UBSan opens a pipe to look at the first object of a type
  EXPECT_THROW(detail::fail_to_write(path("x.csv"), EMFILE), OutputError);
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
  const int next = ::open("/", O_RDONLY);  // the number that the next file would get
  ::close(next);
  rlimit none = before;
  none.rlim_cur = static_cast<rlim_t>(next);
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &none), 0);
  EXPECT_THROW(PartFile(path("x.csv")), OutputError);
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &before), 0);
}

TEST_F(PartFileTest, ReplacesAFileAsAWhole) {
  for (const std::string& bytes : {std::string("first"), std::string("second, longer")}) {
    detail::replace_file(path("x"), bytes);
    EXPECT_EQ(text(path("x")), bytes);
    EXPECT_FALSE(fs::exists(path("x.part")));
  }
}

}  // namespace
}  // namespace polhode
