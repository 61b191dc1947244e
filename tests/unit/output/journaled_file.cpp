// SPDX-License-Identifier: MIT
// A JournaledFile goes back to its savepoint, whatever a killed process has left of the commits
// since.
#include "output/detail/journaled_file.hpp"

#include <gmock/gmock.h>

#include <iterator>
#include <random>
#include <string>

#include "output/part_file.hpp"
#include "polhode/error.hpp"
#include "temp_folder.hpp"

namespace polhode {
namespace {

using detail::JournaledFile;
using detail::undo_path;

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

}  // namespace
}  // namespace polhode
