// SPDX-License-Identifier: MIT
// A JournaledFile goes back to its savepoint, whatever a killed process has left of the commits
// since.
#include "output/detail/journaled_file.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <filesystem>
#include <iterator>
#include <random>
#include <string>
#include <thread>

#include "output/part_file.hpp"
#include "polhode/error.hpp"
#include "polhode/output/sink.hpp"
#include "temp_folder.hpp"

namespace polhode {
namespace {

using io::detail::JournaledFile;
using io::detail::undo_path;
namespace fs = std::filesystem;
using io::detail::PartFile;
using PartFileTest = test::InTempFolder;

class JournaledFileTest : public test::InTempFolder {
 protected:
  std::string path(const std::string& name = "a.part") const { return TempFolder::path(name); }
  // Some bytes anywhere, also beyond the end; the file that they make.
  std::string random_write(JournaledFile& file, std::string content) {
    const std::size_t offset = random_() % (content.size() + 6000);
    std::string bytes(1 + random_() % 9000, '\0');
    for (char& c : bytes) c = static_cast<char>(random_());
    EXPECT_TRUE(file.write(offset, bytes));
    if (content.size() < offset + bytes.size()) content.resize(offset + bytes.size(), '\0');
    content.replace(offset, bytes.size(), bytes);
    return content;
  }

  std::mt19937 random_{11};
};

TEST_F(JournaledFileTest, HoldsWhatWasCommitted) {
  JournaledFile file(path());
  std::string content;
  for (int i = 0; i < 100; ++i) {
    const std::string before = content;
    for (int k = 0; k < 3; ++k) content = random_write(file, content);
    EXPECT_EQ(text(path()), before);  // nothing but a commit changes it
    std::string read(content.size(), '\0');
    EXPECT_TRUE(file.read(0, read));
    EXPECT_EQ(read, content);
    file.commit(static_cast<std::int64_t>(content.size()));
    ASSERT_EQ(text(path()), content);
    if (i % 8 != 7) continue;
    content.resize(content.size() / 2);  // what is cut off is zeros when it grows again
    file.commit(static_cast<std::int64_t>(content.size()));
    ASSERT_EQ(text(path()), content);
  }
}

TEST_F(JournaledFileTest, GoesBackToItsMarkAfterAnyCommits) {
  std::string content;
  for (std::int64_t number = 1; number <= 12; ++number) {
    std::string marked;
    {
      JournaledFile file = number == 1
                               ? JournaledFile(path())
                               : JournaledFile(path(), {std::int64_t(content.size()), number - 1});
      EXPECT_EQ(text(path()), content);
      for (int i = 0; i < 3; ++i) {
        content = random_write(file, content);
        file.commit(static_cast<std::int64_t>(content.size()));
      }
      file.savepoint(number);
      marked = content;
      for (int i = 0; i < 4; ++i) {
        content = random_write(file, content);
        file.commit(static_cast<std::int64_t>(content.size()));
      }
    }
    content = marked;
  }
}

// What a commit has in PATH-undo may be anything in the file: the process was killed in it.
TEST_F(JournaledFileTest, GoesBackFromATornCommit) {
  std::string content(50000, 'a');
  {
    JournaledFile file(path());
    ASSERT_TRUE(file.write(0, content));
    file.commit(50000);
    file.savepoint(7);
    ASSERT_TRUE(file.write(4096 * 3 + 17, std::string(100, 'b')));
    ASSERT_TRUE(file.write(4096 * 9, std::string(100, 'b')));
    file.commit(60000);
  }
  const std::string whole = text(path()), undo = text(undo_path(path()));
  for (const std::size_t page : {3U, 9U}) {
    std::string torn = whole;
    torn.replace(4096 * page, 4096, std::string(4096, 'x'));
    write(path(), torn + "tail");
    write(undo_path(path()), undo);
    JournaledFile file(path(), {50000, 7});
    EXPECT_EQ(text(path()), content) << page;
  }
  // killed while PATH-undo was written: the file has not been changed there
  std::string half = whole;
  half.replace(4096 * 9, 4096, std::string(4096, 'a'));
  for (const std::size_t cut : {1U, 100U, 4000U}) {
    write(path(), half);
    write(undo_path(path()), undo.substr(0, undo.size() - cut));
    JournaledFile file(path(), {50000, 7});
    EXPECT_EQ(text(path()), content) << cut;
  }
}

// The process was killed when a checkpoint was there, and PATH-undo still that of the one before.
TEST_F(JournaledFileTest, AnUndoOfAnotherMarkIsNotApplied) {
  std::string content(20000, 'a');
  {
    JournaledFile file(path());
    ASSERT_TRUE(file.write(0, content));
    file.commit(20000);
    file.savepoint(1);
    ASSERT_TRUE(file.write(5000, std::string(10, 'b')));
    content.replace(5000, 10, std::string(10, 'b'));
    file.commit(20000);
  }
  JournaledFile file(path(), {20000, 2});
  EXPECT_EQ(text(path()), content);
}

TEST_F(JournaledFileTest, AFileThatIsNotThatOfTheMark) {
  write(path(), std::string(100, 'a'));
  EXPECT_THROW(JournaledFile(path(), {101, 1}), DomainError);
  EXPECT_THROW(JournaledFile(path("none.part"), {0, 1}), DomainError);
  EXPECT_EQ(text(path()), std::string(100, 'a'));
}

// A PartFile belongs to one writer until it has its name, and what keeps it from being written is
// distinguished: a path that cannot be, or a machine that cannot.

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
      } catch (const io::OutputError&) {
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
  EXPECT_THROW(io::detail::replace_file(path("x.csv"), "text"), io::OutputError);
  EXPECT_FALSE(fs::exists(path("x.csv")));
}

TEST_F(PartFileTest, NoMoreFilesIsAFailureOfTheMachine) {
  // thrown once while there are files: UBSan opens a pipe to look at the first object of a type
  EXPECT_THROW(io::detail::fail_to_write(path("x.csv"), EMFILE), io::OutputError);
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
  const int next = ::open("/", O_RDONLY);  // the number that the next file would get
  ::close(next);
  rlimit none = before;
  none.rlim_cur = static_cast<rlim_t>(next);
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &none), 0);
  EXPECT_THROW(PartFile(path("x.csv")), io::OutputError);
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &before), 0);
}

TEST_F(PartFileTest, ReplacesAFileAsAWhole) {
  for (const std::string& bytes : {std::string("first"), std::string("second, longer")}) {
    io::detail::replace_file(path("x"), bytes);
    EXPECT_EQ(text(path("x")), bytes);
    EXPECT_FALSE(fs::exists(path("x.part")));
  }
}

}  // namespace
}  // namespace polhode
