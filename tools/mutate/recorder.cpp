// SPDX-License-Identifier: MIT
// Linked into every test program that tools/mutate builds: at its end it writes the numbers of the
// mutants that it has reached into the file named by POLHODE_REACHED.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

namespace {

class Recorder : public testing::EmptyTestEventListener {
  void OnTestProgramEnd(const testing::UnitTest&) override {
    const char* path = std::getenv("POLHODE_REACHED");
    if (path == nullptr) return;
    std::FILE* file = std::fopen(path, "w");
    if (file == nullptr) return;
    for (int i = 0; i < polhode_mutants::most; ++i)
      if (polhode_mutants::reached[i] != 0) std::fprintf(file, "%d\n", i);
    std::fclose(file);
  }
};

const bool listening = [] {
  testing::UnitTest::GetInstance()->listeners().Append(new Recorder);
  return true;
}();

}  // namespace
